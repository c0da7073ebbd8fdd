#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/search/RigidBodyModel.hpp>
#include <suture/search/UnilateralFoundation.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace suture {

namespace {

constexpr double kEquilibrium = 1e-12;  // relative imbalance of pad forces at the level of round-off
constexpr double kFlat = 1e-12;         // slope of a line search at the level of round-off, relative to the first
constexpr double kNoPadForce = 1e-14;   // pad force at the level of round-off, relative to the initial ones
constexpr int kMostSteps = 300;
constexpr int kSoonSteps = 60;              // steps of the plain method before soft pads are used
constexpr int kSoftSteps = 12;              // steps at one softness
constexpr double kSofter = 0.25;            // ratio of successive softnesses
constexpr double kSoftly = 1e-3;            // imbalance at which a softness is finished
constexpr double kNoPadEquilibrium = 1e-8;  // relative imbalance of pad forces above which there is no equilibrium
constexpr double kNotSoft = 1e-16;          // softness that counts as zero, relative to the first

}  // namespace

double UnilateralFoundation::slope(const Vector& y, const Vector& v, double work, double a) const {
  double sum = -work;
  for (Eigen::Index i = 0; i < y.size(); ++i) sum += v(i) * stiffness_(i) * std::max(y(i) + a * v(i), 0.0);
  return sum;
}

/// Step length along a direction: exact, over the breakpoints where pads open and close. Negative: nothing stops the motion.
double UnilateralFoundation::lineSearch(const Vector& y, const Vector& v, double work) const {
  std::vector<double> breaks;
  for (Eigen::Index i = 0; i < y.size(); ++i)
    if (v(i) != 0.0)
      if (const double at = -y(i) / v(i); at > 0.0 && std::isfinite(at)) breaks.push_back(at);
  std::sort(breaks.begin(), breaks.end());
  const double first = std::abs(slope(y, v, work, 0.0)), flat = -kFlat * first;
  std::size_t low = 0, high = breaks.size();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (slope(y, v, work, breaks[middle]) < flat)
      low = middle + 1;
    else
      high = middle;
  }
  const double before = low > 0 ? breaks[low - 1] : 0.0;
  const bool bounded = low < breaks.size();
  const double inside = bounded ? 0.5 * (before + breaks[low]) : before + 1.0;
  const double rest = slope(y, v, work, before);
  double curvature = 0.0, most = 0.0;
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const double own = v(i) * v(i) * stiffness_(i);
    most += own;
    const double at = bounded ? y(i) + inside * v(i) : (v(i) > 0.0 ? 1.0 : v(i) < 0.0 ? -1.0 : y(i));
    if (at > 0.0) curvature += own;
  }
  if (curvature <= 0.0 || (!bounded && rest < 0.0 && curvature < 1e-14 * most)) {
    if (before == 0.0 || std::abs(rest) > 1e-9 * first) return -1.0;
    return before;
  }
  return bounded ? std::min(before - rest / curvature, breaks[low]) : before - rest / curvature;
}

Vector UnilateralFoundation::gradient(const Vector& y) const {
  return rows_.transpose() * y.cwiseMax(0.0).cwiseProduct(stiffness_) - work_;
}

/// Scales of the motions: square roots of the diagonal of the Hessian, or of a typical pad for motions that no pad stops yet.
Vector UnilateralFoundation::scales(const Matrix& hessian) const {
  Vector scale = hessian.diagonal().cwiseMax(0.0).cwiseSqrt();
  const double big = scale.size() > 0 && scale.maxCoeff() > 0.0 ? scale.maxCoeff() : 0.0;
  std::vector<double> sorted(stiffness_.data(), stiffness_.data() + stiffness_.size());
  double typical = 1.0;
  if (!sorted.empty()) {
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
    typical = std::sqrt(std::max(sorted[sorted.size() / 2], 1e-300));
  }
  for (Eigen::Index k = 0; k < scale.size(); ++k)
    if (!(scale(k) > kDependentRows * big)) scale(k) = big > 0.0 ? std::max(typical, kDependentRows * big) : typical;
  return scale;
}

/// Newton on the motions that closed pads stop, then along the gradient of the others until pads stop them. A common line search would
/// limit the large motions of unconstrained bodies by the small ones of the others.
UnilateralFoundation::End UnilateralFoundation::newton(Vector& x, Vector& y, int steps, double nothing) const {
  const Eigen::Index n = rows_.cols();
  const auto move = [&](const Vector& direction, double length) {
    x += length * direction;
    y += length * (rows_ * direction);
  };
  for (int step = 0; step < steps; ++step) {
    const double enough = kEquilibrium * (y.cwiseMax(0.0).dot(stiffness_) + forceScale_) + nothing;
    if (gradient(y).norm() <= enough) return End::Found;

    Matrix hessian = Matrix::Zero(n, n);
    for (Eigen::Index i = 0; i < y.size(); ++i)
      if (y(i) > 0.0) hessian.noalias() += stiffness_(i) * rows_.row(i).transpose() * rows_.row(i);
    const Vector inverse = scales(hessian).cwiseInverse();
    const Eigenpairs eigen = symmetricEigenpairs(inverse.asDiagonal() * hessian * inverse.asDiagonal());
    const double least = kDependentRows * std::max(eigen.values.maxCoeff(), 1e-3);
    const auto toward = [&](bool stopped) {
      Vector parts = eigen.vectors.transpose() * inverse.cwiseProduct(gradient(y));
      for (Eigen::Index k = 0; k < n; ++k)
        parts(k) = (eigen.values(k) > least) != stopped ? 0.0 : stopped ? parts(k) / eigen.values(k) : parts(k);
      return Vector(-inverse.cwiseProduct(eigen.vectors * parts));
    };
    const Vector before = y;
    const Vector newton = toward(true);
    if (const double length = lineSearch(y, rows_ * newton, work_.dot(newton)); length > 0.0) move(newton, length);
    const Vector loose = toward(false);
    if (-loose.dot(gradient(y)) > enough * loose.norm()) {
      const double length = lineSearch(y, rows_ * loose, work_.dot(loose));
      if (length < 0.0) return End::Unbounded;
      move(loose, length);
    }
    if (y == before) break;
  }
  return gradient(y).norm() <= kNoPadEquilibrium * (y.cwiseMax(0.0).dot(stiffness_) + forceScale_) + nothing ? End::Found : End::Exhausted;
}

/// Newton steps with pads that press slightly before they are touched: forces k s log(1 + exp(y / s)). Bodies that would bounce between two
/// distant walls then see both.
void UnilateralFoundation::soften(Vector& x, Vector& y, double softness) const {
  Vector force(y.size()), tangent(y.size());
  const auto press = [&](const Vector& at) {
    for (Eigen::Index i = 0; i < at.size(); ++i) {
      const double ratio = at(i) / softness, small = std::exp(-std::abs(ratio));
      force(i) = stiffness_(i) * (std::max(at(i), 0.0) + softness * std::log1p(small));
      tangent(i) = stiffness_(i) * (ratio > 0.0 ? 1.0 : small) / (1.0 + small);
    }
    return Vector(rows_.transpose() * force - work_);
  };
  for (int step = 0; step < kSoftSteps; ++step) {
    const Vector g = press(y);
    if (g.norm() <= kSoftly * (force.sum() + forceScale_)) return;
    const Matrix hessian = rows_.transpose() * tangent.asDiagonal() * rows_;
    const Vector inverse = scales(hessian).cwiseInverse();
    const Eigenpairs eigen = symmetricEigenpairs(inverse.asDiagonal() * hessian * inverse.asDiagonal());
    const Vector values = eigen.values.cwiseMax(kDependentRows * std::max(eigen.values.maxCoeff(), 1e-3));
    const Vector parts = (eigen.vectors.transpose() * inverse.cwiseProduct(g)).cwiseQuotient(values);
    const Vector direction = -inverse.cwiseProduct(eigen.vectors * parts), along = rows_ * direction;
    const double first = g.dot(direction);
    double length = 1.0;
    for (int halving = 0; halving < 60 && press(y + length * along).dot(direction) > 0.5 * std::abs(first); ++halving) length *= 0.5;
    x += length * direction;
    y += length * along;
  }
}

bool UnilateralFoundation::solve(Vector& x, Vector& y) const {
  const Vector from = x, open = y;
  // Bodies without loads move apart until no pad presses: the scale of their pad forces is that of the initial ones.
  const double nothing = kNoPadForce * y.cwiseMax(0.0).dot(stiffness_);
  End end = newton(x, y, kSoonSteps, nothing);
  if (end != End::Exhausted) return end == End::Found;
  x = from;
  y = open;
  const double size = y.cwiseAbs().maxCoeff();
  for (double softness = size; softness > kNotSoft * size; softness *= kSofter) {
    soften(x, y, softness);
    Vector place = x, penetration = y;
    if (newton(place, penetration, kSoftSteps, nothing) == End::Found) {
      x = place;
      y = penetration;
      return true;
    }
  }
  return newton(x, y, kMostSteps, nothing) == End::Found;
}

}  // namespace suture
