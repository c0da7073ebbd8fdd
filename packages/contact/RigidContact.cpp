#include <suture/base/Dense.hpp>
#include <suture/base/DisjointSets.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/NonnegativeLeastSquares.hpp>
#include <suture/contact/RigidContact.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

namespace {

constexpr double kDependent = 1e-9;     // singular value of rows of the order of one below which they leave a motion free
constexpr double kTouching = 1e-12;     // penetration, relative to the gaps' own size, at which a pair touches
constexpr double kEquilibrium = 1e-12;  // imbalance of pad forces that is rounding
constexpr double kNoEquilibrium = 1e-8;
constexpr double kNoWork = 1e-11;  // of loads in a motion, relative to the sum of its parts
constexpr double kFlat = 1e-12;    // of the first slope of a line search, below which one is rounding
constexpr int kMostSteps = 300;
constexpr int kSoonSteps = 60;      // of the plain method, before soft pads show the way
constexpr int kSoftSteps = 12;      // at one softness
constexpr double kSofter = 0.25;    // from one softness to the next
constexpr double kSoftly = 1e-3;    // imbalance at which a softness is done with
constexpr double kNotSoft = 1e-16;  // of the first softness
constexpr int kPatchRounds = 4;     // fixed point of compliance and patch lengths

std::vector<int> members(const ClosedSet& set, char value) {
  std::vector<int> all;
  for (std::size_t i = 0; i < set.size(); ++i)
    if ((set[i] != 0) == (value != 0)) all.push_back(static_cast<int>(i));
  return all;
}

/// min over x of sum (t + rows x)_+^2 / 2c - e.x
struct PadProblem {
  const Matrix& rows;
  const Vector& t;
  const Vector& stiffness;  // 1 / c
  const Vector& e;
  double forceScale;

  double slope(const Vector& y, const Vector& v, double work, double a) const {
    double sum = -work;
    for (Eigen::Index i = 0; i < y.size(); ++i) sum += v(i) * stiffness(i) * std::max(y(i) + a * v(i), 0.0);
    return sum;
  }

  /// Step length along a direction: exact, over the breakpoints where pads open and close. Negative: nothing stops the motion.
  double lineSearch(const Vector& y, const Vector& v, double work) const {
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
      const double own = v(i) * v(i) * stiffness(i);
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

  Vector gradient(const Vector& y) const { return rows.transpose() * y.cwiseMax(0.0).cwiseProduct(stiffness) - e; }

  /// Scales of the motions: roots of the diagonal of the Hessian; of a typical pad for those that no pad stops yet.
  Vector scales(const Matrix& hessian) const {
    Vector scale = hessian.diagonal().cwiseMax(0.0).cwiseSqrt();
    const double big = scale.size() > 0 && scale.maxCoeff() > 0.0 ? scale.maxCoeff() : 0.0;
    std::vector<double> sorted(stiffness.data(), stiffness.data() + stiffness.size());
    double typical = 1.0;
    if (!sorted.empty()) {
      std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
      typical = std::sqrt(std::max(sorted[sorted.size() / 2], 1e-300));
    }
    for (Eigen::Index k = 0; k < scale.size(); ++k)
      if (!(scale(k) > kDependent * big)) scale(k) = big > 0.0 ? std::max(typical, kDependent * big) : typical;
    return scale;
  }

  enum class End { Found, Unbounded, Exhausted };

  /// Newton on the motions that closed pads stop, then down the gradient of the others until pads stop them: one line search for both would
  /// hold back the long ways of the loose bodies by the short ones of the others.
  /// \param y  penetrations t + rows x. They are moved with x, never computed from it: what rounding leaves of long ways is a change of the
  /// gaps by as little, and forces keep their digits.
  End newton(Vector& x, Vector& y, int steps) const {
    const Eigen::Index n = rows.cols();
    const auto move = [&](const Vector& direction, double length) {
      x += length * direction;
      y += length * (rows * direction);
    };
    for (int step = 0; step < steps; ++step) {
      const double enough = kEquilibrium * (y.cwiseMax(0.0).dot(stiffness) + forceScale);
      if (gradient(y).norm() <= enough) return End::Found;

      Matrix hessian = Matrix::Zero(n, n);
      for (Eigen::Index i = 0; i < y.size(); ++i)
        if (y(i) > 0.0) hessian.noalias() += stiffness(i) * rows.row(i).transpose() * rows.row(i);
      const Vector inverse = scales(hessian).cwiseInverse();
      const Eigenpairs eigen = symmetricEigenpairs(inverse.asDiagonal() * hessian * inverse.asDiagonal());
      const double least = kDependent * std::max(eigen.values.maxCoeff(), 1e-3);
      const auto toward = [&](bool stopped) {
        Vector parts = eigen.vectors.transpose() * inverse.cwiseProduct(gradient(y));
        for (Eigen::Index k = 0; k < n; ++k)
          parts(k) = (eigen.values(k) > least) != stopped ? 0.0 : stopped ? parts(k) / eigen.values(k) : parts(k);
        return Vector(-inverse.cwiseProduct(eigen.vectors * parts));
      };
      const Vector before = y;
      const Vector newton = toward(true);
      if (const double length = lineSearch(y, rows * newton, e.dot(newton)); length > 0.0) move(newton, length);
      const Vector loose = toward(false);
      if (-loose.dot(gradient(y)) > enough * loose.norm()) {
        const double length = lineSearch(y, rows * loose, e.dot(loose));
        if (length < 0.0) return End::Unbounded;
        move(loose, length);
      }
      if (y == before) break;
    }
    return gradient(y).norm() <= kNoEquilibrium * (y.cwiseMax(0.0).dot(stiffness) + forceScale) ? End::Found : End::Exhausted;
  }

  /// Newton's steps with pads that press a little before they are touched: forces k s log(1 + exp(y / s)). Bodies that would bounce between
  /// two walls on a long way see both.
  void soften(Vector& x, Vector& y, double softness) const {
    Vector force(y.size()), tangent(y.size());
    const auto press = [&](const Vector& at) {
      for (Eigen::Index i = 0; i < at.size(); ++i) {
        const double ratio = at(i) / softness, small = std::exp(-std::abs(ratio));
        force(i) = stiffness(i) * (std::max(at(i), 0.0) + softness * std::log1p(small));
        tangent(i) = stiffness(i) * (ratio > 0.0 ? 1.0 : small) / (1.0 + small);
      }
      return Vector(rows.transpose() * force - e);
    };
    for (int step = 0; step < kSoftSteps; ++step) {
      const Vector g = press(y);
      if (g.norm() <= kSoftly * (force.sum() + forceScale)) return;
      const Matrix hessian = rows.transpose() * tangent.asDiagonal() * rows;
      const Vector inverse = scales(hessian).cwiseInverse();
      const Eigenpairs eigen = symmetricEigenpairs(inverse.asDiagonal() * hessian * inverse.asDiagonal());
      const Vector values = eigen.values.cwiseMax(kDependent * std::max(eigen.values.maxCoeff(), 1e-3));
      const Vector parts = (eigen.vectors.transpose() * inverse.cwiseProduct(g)).cwiseQuotient(values);
      const Vector direction = -inverse.cwiseProduct(eigen.vectors * parts), along = rows * direction;
      const double first = g.dot(direction);
      double length = 1.0;
      for (int halving = 0; halving < 60 && press(y + length * along).dot(direction) > 0.5 * std::abs(first); ++halving) length *= 0.5;
      x += length * direction;
      y += length * along;
    }
  }

  bool solve(Vector& x, Vector& y) const {
    const Vector from = x, open = y;
    End end = newton(x, y, kSoonSteps);
    if (end != End::Exhausted) return end == End::Found;
    x = from;
    y = open;
    const double size = y.cwiseAbs().maxCoeff();
    for (double softness = size; softness > kNotSoft * size; softness *= kSofter) {
      soften(x, y, softness);
      Vector place = x, penetration = y;
      if (newton(place, penetration, kSoftSteps) == End::Found) {
        x = place;
        y = penetration;
        return true;
      }
    }
    return newton(x, y, kMostSteps) == End::Found;
  }
};

}  // namespace

RigidContact::RigidContact(Pairs pairs) : pairs_(std::move(pairs)), norm_(pairs_.work.norm()) {
  if (pairs_.rows.rows() != this->pairs() || pairs_.penetration.size() != this->pairs() || pairs_.stiffness.size() != this->pairs())
    throw InternalError("rigid contact: data of different numbers of pairs");
  compliance_ = 2.0 * pairs_.stiffness.cwiseInverse();
  for (int i = 0; i < this->pairs(); ++i)
    if (!pairs_.able[i]) compliance_(i) = 1.0;
  rank_ = motions() - static_cast<int>(loose(ClosedSet(this->pairs(), 1)).cols());
  findComponents();
}

void RigidContact::findComponents() {
  DisjointSets sets(motions());
  std::vector<int> any(pairs(), -1);  // a motion that the pair feels
  for (int i = 0; i < pairs(); ++i) {
    if (!pairs_.able[i]) continue;
    for (int k = 0; k < motions(); ++k)
      if (pairs_.rows(i, k) != 0.0) {
        if (any[i] < 0) any[i] = k;
        sets.join(k, any[i]);
      }
  }
  std::vector<int> number(motions(), -1);
  for (int k = 0; k < motions(); ++k) {
    int& own = number[sets.lowest(k)];
    if (own < 0) {
      own = static_cast<int>(components_.size());
      components_.emplace_back();
    }
    components_[own].motions.push_back(k);
  }
  for (int i = 0; i < pairs(); ++i)
    if (any[i] >= 0) components_[number[sets.lowest(any[i])]].pairs.push_back(i);
}

/// Bodies that pads couple together at a time: those that carry little are no rounding of those that carry much.
RigidContact::Equilibrium RigidContact::project(const Vector& t) const {
  Equilibrium result;
  result.motion = Vector::Zero(motions());
  // Pairs that can't change take no part.
  Vector stiffness = compliance_.cwiseInverse();
  for (int i = 0; i < pairs(); ++i)
    if (!pairs_.able[i]) stiffness(i) = 0.0;
  Vector penetration = t;
  for (const Component& component : components_) {
    const Matrix rows = pairs_.rows(component.pairs, component.motions);
    const Vector work = pairs_.work(component.motions), own = t(component.pairs), k = stiffness(component.pairs);
    const PadProblem problem{rows, own, k, work, work.norm()};
    Vector x = Vector::Zero(work.size()), y = own;
    result.found = problem.solve(x, y) && result.found;
    result.motion(component.motions) = x;
    penetration(component.pairs) = y;
  }
  result.force = penetration.cwiseMax(0.0).cwiseProduct(stiffness);
  return result;
}

Vector RigidContact::leastMotion(const ClosedSet& carrying, const Vector& motion, const Vector& penetration) const {
  const Matrix free = loose(carrying);
  if (free.cols() == 0) return motion;
  std::vector<int> open;
  for (const int i : members(carrying, 0))
    if (pairs_.able[i]) open.push_back(i);
  const Matrix rows = pairs_.rows(open, Eigen::all) * free;
  const Vector room = -Vector(penetration(open)).cwiseMin(0.0), along = free.transpose() * motion;
  return motion + free * (leastDistance(-rows, -room - rows * along) - along);
}

ClosedSet RigidContact::start() {
  ClosedSet set(pairs(), 0), last;
  compliance_ = 6.0 * pairs_.stiffness.cwiseInverse();
  for (int i = 0; i < pairs(); ++i)
    if (!pairs_.able[i]) compliance_(i) = 1.0;
  Equilibrium pads;
  for (int round = 0; round < kPatchRounds; ++round) {
    pads = project(pairs_.penetration);
    for (int i = 0; i < pairs(); ++i) set[i] = pads.force(i) > 0.0;
    if (set == last) break;
    last = set;
    // A patch of n closed pairs gives n times as much under a force on each of them; open pairs are taken for those of the longest patch.
    std::vector<int> run(pairs(), 0), longest;
    for (int i = 0; i < pairs();) {
      if (!set[i]) {
        ++i;
        continue;
      }
      int end = i + 1;
      while (end < pairs() && set[end] && pairs_.line[end] == pairs_.line[i]) ++end;
      longest.resize(std::max<std::size_t>(longest.size(), pairs_.line[i] + 1), 0);
      longest[pairs_.line[i]] = std::max(longest[pairs_.line[i]], end - i);
      for (int k = i; k < end; ++k) run[k] = end - i;
      i = end;
    }
    for (int i = 0; i < pairs(); ++i) {
      if (!pairs_.able[i]) continue;
      const int line = pairs_.line[i];
      const int length = run[i] > 0 ? run[i] : line < static_cast<int>(longest.size()) ? longest[line] : 0;
      compliance_(i) = std::max(2.0, static_cast<double>(length)) / pairs_.stiffness(i);
    }
  }
  if (!pads.found) throw NumericalError("contact: the loads push a body away from all contacts that could hold it");
  double size = 0.0;
  for (int i = 0; i < pairs(); ++i) size = std::max(size, std::abs(pairs_.penetration(i)));
  for (int i = 0; i < pairs(); ++i)
    if (pairs_.able[i] && pairs_.rows.row(i).norm() < kDependent && pairs_.penetration(i) >= -kTouching * size) set[i] = 1;
  return set;
}

Matrix RigidContact::loose(const ClosedSet& closed) const {
  if (motions() == 0) return Matrix(0, 0);
  const std::vector<int> at = members(closed, 1);
  if (at.empty()) return Matrix::Identity(motions(), motions());
  return nullSpace(pairs_.rows(at, Eigen::all), kDependent);
}

bool RigidContact::loosens(const ClosedSet& closed) const { return motions() - static_cast<int>(loose(closed).cols()) < rank_; }

std::vector<int> RigidContact::holders(const ClosedSet& closed, const Matrix& loose) const {
  std::vector<int> open;
  for (const int i : members(closed, 0))
    if (pairs_.able[i]) open.push_back(i);
  std::vector<int> chosen;
  if (loose.cols() == 0 || open.empty()) return chosen;
  // Pivoted Gram-Schmidt on the rows: each next one stops most of what is still loose.
  Matrix rest = pairs_.rows(open, Eigen::all) * loose;
  for (Eigen::Index k = 0; k < loose.cols(); ++k) {
    Eigen::Index best = 0;
    const double most = rest.rowwise().norm().maxCoeff(&best);
    if (!(most > kDependent)) break;
    chosen.push_back(open[best]);
    const Vector direction = rest.row(best).transpose() / most;
    rest -= (rest * direction) * direction.transpose();
  }
  return chosen;
}

Vector RigidContact::holderForces(const std::vector<int>& holders, const Matrix& loose) const {
  Vector work = loose.transpose() * pairs_.work;
  const Vector size = loose.cwiseAbs().transpose() * pairs_.work.cwiseAbs();
  for (Eigen::Index k = 0; k < work.size(); ++k)
    if (std::abs(work(k)) <= kNoWork * size(k)) work(k) = 0.0;
  if (holders.empty() || work.isZero(0.0)) return Vector::Zero(static_cast<Eigen::Index>(holders.size()));
  const Matrix rows = pairs_.rows(holders, Eigen::all) * loose;
  Vector force = leastSquares(rows.transpose(), work);
  const double least = kNoWork * force.cwiseAbs().maxCoeff();
  for (double& each : force)
    if (std::abs(each) <= least) each = 0.0;
  return force;
}

Vector RigidContact::settle(const ClosedSet& closed, const Vector& penetration, const Matrix& loose) const {
  Vector z = Vector::Zero(loose.cols());
  std::vector<int> open;
  for (const int i : members(closed, 0))
    if (pairs_.able[i]) open.push_back(i);
  if (loose.cols() == 0 || open.empty()) return z;
  const Vector w = penetration(open);
  if (!(w.maxCoeff() > 0.0)) return z;
  const Matrix rows = pairs_.rows(open, Eigen::all) * loose;
  const Vector stiffness = Vector(compliance_(open)).cwiseInverse(), none = Vector::Zero(loose.cols());
  const PadProblem problem{rows, w, stiffness, none, 1e-12 * w.cwiseMax(0.0).dot(stiffness)};
  Vector moved = w;
  problem.solve(z, moved);
  return z;
}

// The cone {z : G z <= 0} is a point if and only if its polar cone, spanned by the rows of G, is the whole space.
Matrix RigidContact::neutral(const ClosedSet& carrying, const ClosedSet& touching) const {
  const Matrix free = loose(carrying);
  if (free.cols() == 0) return Matrix(motions(), 0);
  const std::vector<int> at = members(touching, 1);
  const Matrix rows = pairs_.rows(at, Eigen::all) * free;
  Matrix found(free.cols(), 0);
  for (Eigen::Index k = 0; k < free.cols(); ++k)
    for (const double sign : {1.0, -1.0}) {
      Vector rest = sign * Vector::Unit(free.cols(), k);
      if (!at.empty()) rest -= rows.transpose() * nonnegativeLeastSquares(rows.transpose(), rest);
      if (rest.norm() <= kNoEquilibrium) continue;
      found.conservativeResize(Eigen::NoChange, found.cols() + 1);
      found.rightCols(1) = rest.normalized();
    }
  return found.cols() > 0 ? Matrix(free * orthonormalBasis(found, 1e-9)) : Matrix(motions(), 0);
}

Vector RigidContact::clusterScale(const ClosedSet& closed, const Vector& values) const {
  Vector scale = Vector::Zero(pairs());
  if (pairs_.bodies.empty()) {
    if (values.size() > 0) scale.setConstant(values.cwiseAbs().maxCoeff());
    return scale;
  }
  int bodies = 0;
  for (const auto& own : pairs_.bodies)
    for (const int body : own) bodies = std::max(bodies, body + 1);
  DisjointSets clusters(bodies);
  for (int i = 0; i < pairs(); ++i)
    if (closed[i])
      for (const int body : pairs_.bodies[i]) clusters.join(body, pairs_.bodies[i].front());
  std::vector<double> most(bodies, 0.0);
  for (int i = 0; i < pairs(); ++i)
    if (closed[i])
      for (const int body : pairs_.bodies[i]) most[clusters.lowest(body)] = std::max(most[clusters.lowest(body)], std::abs(values(i)));
  for (int i = 0; i < pairs(); ++i)
    for (const int body : pairs_.bodies[i]) scale(i) = std::max(scale(i), most[clusters.lowest(body)]);
  return scale;
}

Vector RigidContact::staticForces() const {
  if (norm_ == 0.0) return Vector::Zero(pairs());
  const Vector force = nonnegativeLeastSquares(pairs_.rows.transpose(), pairs_.work / norm_);
  if ((pairs_.rows.transpose() * force - pairs_.work / norm_).norm() > kNoEquilibrium) return {};
  return norm_ * force;
}

}  // namespace suture
