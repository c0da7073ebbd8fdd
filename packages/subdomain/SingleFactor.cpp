#include <suture/base/Errors.hpp>
#include <suture/subdomain/SingleFactor.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace suture {

namespace {

using Singles = Eigen::VectorXf;
using Panel = Eigen::Map<const Eigen::MatrixXf, 0, Eigen::OuterStride<>>;

constexpr double kAccuracy = 1e-15;  // of the recursion; what rounding leaves in the true residual is that of a direct solve
constexpr int kMost = 200;

}  // namespace

SingleFactor::SingleFactor(std::vector<Supernode> supernodes, std::vector<int> unknownOf)
    : supernodes_(std::move(supernodes)), unknownOf_(std::move(unknownOf)) {
  for (const Supernode& s : supernodes_) {
    mostBelow_ = std::max(mostBelow_, static_cast<int>(s.below.size()));
    bytes_ += static_cast<double>(sizeof(float) * s.values.size() + sizeof(int) * s.below.size());
  }
}

void SingleFactor::precondition(const Vector& r, Vector& z) const {
  Singles y(unknownOf_.size()), rest(mostBelow_);
  // Single precision has a narrow range: residuals are brought to the size of one.
  double largest = 0.0;
  for (const int unknown : unknownOf_) largest = std::max(largest, std::abs(r(unknown)));
  z.setZero();
  if (largest == 0.0) return;
  for (std::size_t j = 0; j < unknownOf_.size(); ++j) y(static_cast<int>(j)) = static_cast<float>(r(unknownOf_[j]) / largest);
  for (const Supernode& s : supernodes_) {
    const int m = static_cast<int>(s.below.size()), stride = s.columns + m;
    auto own = y.segment(s.first, s.columns);
    Panel(s.values.data(), s.columns, s.columns, Eigen::OuterStride<>(stride)).triangularView<Eigen::Lower>().solveInPlace(own);
    if (m == 0) continue;
    auto below = rest.head(m);
    below.noalias() = Panel(s.values.data() + s.columns, m, s.columns, Eigen::OuterStride<>(stride)) * own;
    for (int k = 0; k < m; ++k) y(s.below[k]) -= below(k);
  }
  for (auto s = supernodes_.rbegin(); s != supernodes_.rend(); ++s) {
    const int m = static_cast<int>(s->below.size()), stride = s->columns + m;
    auto own = y.segment(s->first, s->columns);
    if (m > 0) {
      auto below = rest.head(m);
      for (int k = 0; k < m; ++k) below(k) = y(s->below[k]);
      own.noalias() -= Panel(s->values.data() + s->columns, m, s->columns, Eigen::OuterStride<>(stride)).transpose() * below;
    }
    Panel(s->values.data(), s->columns, s->columns, Eigen::OuterStride<>(stride))
        .transpose()
        .triangularView<Eigen::Upper>()
        .solveInPlace(own);
  }
  for (std::size_t j = 0; j < unknownOf_.size(); ++j) z(unknownOf_[j]) = largest * static_cast<double>(y(static_cast<int>(j)));
}

void SingleFactor::solve(const SparseMatrix& matrix, Vector& x) const {
  Vector r = Vector::Zero(x.size()), z(x.size()), p, q(x.size());
  for (const int unknown : unknownOf_) r(unknown) = x(unknown);
  x.setZero();
  double rz = 0.0, target = 0.0;
  for (int step = 0; step <= kMost; ++step) {
    precondition(r, z);
    const double now = r.dot(z);
    if (!std::isfinite(now)) break;
    if (step == 0) target = kAccuracy * kAccuracy * now;
    if (now <= target) return;
    p = step == 0 ? z : Vector(z + (now / rz) * p);
    rz = now;
    q.noalias() = matrix * p;
    const double length = rz / p.dot(q);
    x += length * p;
    for (const int unknown : unknownOf_) r(unknown) -= length * q(unknown);
  }
  throw NumericalError("interior unknowns: " + std::to_string(kMost) + " steps with a factor in single precision did not suffice");
}

}  // namespace suture
