#include <suture/algebra/DisjointSets.hpp>
#include <suture/algebra/SparseNullSpace.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/algebra/dense/NonnegativeLeastSquares.hpp>
#include <suture/base/Errors.hpp>
#include <suture/search/PadModel.hpp>
#include <suture/search/RigidBodyModel.hpp>
#include <suture/search/SoftBodies.hpp>
#include <suture/search/UnilateralFoundation.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace suture {

namespace {

constexpr double kTouching = 1e-12;    // penetration, relative to the size of the gaps, at which a pair touches
constexpr double kNoWork = 1e-11;      // work of loads in a motion that counts as zero, relative to the sum of its parts
constexpr double kWeakSprings = 1e-2;  // singular value of springs along tangents below which they hold no motion
constexpr double kStopped = 1e-8;      // part of a unit motion that rows do not resist, up to which they stop it
constexpr int kPatchRounds = 4;        // rounds of the fixed point of compliance and patch lengths
// Centre of a disc with a force on each of n nodes at distance h: displacement 3.5 sqrt(n) / (pi E* h) (Boussinesq, sum of 1 / r). For two
// bodies of trilinear cubes a node has k = 0.45 E h, E* = 0.55 E.
constexpr double kSurface = 0.9;

std::vector<int> members(const ClosedSet& set, char value) {
  std::vector<int> all;
  for (std::size_t i = 0; i < set.size(); ++i)
    if ((set[i] != 0) == (value != 0)) all.push_back(static_cast<int>(i));
  return all;
}

}  // namespace

RigidBodyModel::RigidBodyModel(Pairs pairs) : pairs_(std::move(pairs)) {
  if (pairs_.rows.rows() != this->pairs() || pairs_.penetration.size() != this->pairs() || pairs_.stiffness.size() != this->pairs())
    throw InternalError("rigid contact: the arrays differ in their number of pairs");
  compliance_ = 2.0 * pairs_.stiffness.cwiseInverse();
  rounding_ = Vector::Zero(this->pairs());
  for (int i = 0; i < this->pairs(); ++i)
    if (!pairs_.canChange[i]) compliance_(i) = 1.0;
  rank_ = motions() - static_cast<int>(loose(ClosedSet(this->pairs(), 1)).cols());
  findComponents();
}

void RigidBodyModel::findComponents() {
  DisjointSets sets(motions());
  std::vector<int> any(pairs(), -1);  // a motion that moves the pair
  for (int i = 0; i < pairs(); ++i) {
    if (!pairs_.canChange[i]) continue;
    for (SparseRows::InnerIterator entry(pairs_.rows, i); entry; ++entry) {
      if (any[i] < 0) any[i] = static_cast<int>(entry.col());
      sets.join(static_cast<int>(entry.col()), any[i]);
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

/// Bodies coupled by pads are solved separately, so that lightly loaded ones are not lost in the round-off of heavily loaded ones.
RigidBodyModel::Equilibrium RigidBodyModel::project(const Vector& t) const {
  Equilibrium result;
  result.motion = Vector::Zero(motions());
  // Pairs that cannot change are left out.
  Vector stiffness = compliance_.cwiseInverse();
  for (int i = 0; i < pairs(); ++i)
    if (!pairs_.canChange[i]) stiffness(i) = 0.0;
  Vector penetration = t;
  for (const Component& component : components_) {
    const SparseRows rows = columnsAt(rowsAt(pairs_.rows, component.pairs), component.motions);
    const Vector work = pairs_.work(component.motions), own = t(component.pairs), k = stiffness(component.pairs);
    if (work.size() > kMostDense) {
      const PadModel::Equilibrium pads = PadModel::unilateral(rows, work, own, k.cwiseInverse());
      result.found = pads.found && result.found;
      result.motion(component.motions) = pads.motion;
      penetration(component.pairs) = pads.trial.col(0).cwiseQuotient(k);
      continue;
    }
    const Matrix dense = rows;
    const UnilateralFoundation problem(dense, k, work, work.norm());
    Vector x = Vector::Zero(work.size()), y = own;
    result.found = problem.solve(x, y) && result.found;
    result.motion(component.motions) = x;
    penetration(component.pairs) = y;
  }
  result.force = penetration.cwiseMax(0.0).cwiseProduct(stiffness);
  return result;
}

Vector RigidBodyModel::leastMotion(const ClosedSet& carrying, const Vector& motion, const Vector& penetration) const {
  const Matrix free = loose(carrying);
  if (free.cols() == 0) return motion;
  std::vector<int> open;
  for (const int i : members(carrying, 0))
    if (pairs_.canChange[i]) open.push_back(i);
  const Matrix rows = rowsAt(pairs_.rows, open) * free;
  const Vector room = -Vector(penetration(open)).cwiseMin(0.0), along = free.transpose() * motion;
  return motion + free * (leastDistance(-rows, -room - rows * along) - along);
}

/// Under a force on each pair, a patch of n closed pairs on a line is n times as compliant as one pair, on a surface sqrt(n) times. Open
/// pairs use the longest patch of their line.
Vector RigidBodyModel::patchLengths(const ClosedSet& set) const {
  Vector length = Vector::Zero(pairs());
  std::map<int, double> longest;
  if (pairs_.surfaces) {
    for (int i = 0; i < pairs(); ++i)
      if (set[i]) longest[pairs_.line[i]] += 1.0;
    for (auto& [line, count] : longest) count = kSurface * std::sqrt(count);
  }
  for (int i = 0; !pairs_.surfaces && i < pairs();) {
    int end = i;
    while (end < pairs() && set[end] && pairs_.line[end] == pairs_.line[i]) ++end;
    if (end > i) length.segment(i, end - i).setConstant(end - i);
    longest[pairs_.line[i]] = std::max(longest[pairs_.line[i]], static_cast<double>(end - i));
    i = std::max(end, i + 1);
  }
  for (int i = 0; i < pairs(); ++i)
    if (length(i) == 0.0) length(i) = longest[pairs_.line[i]];
  return length;
}

ClosedSet RigidBodyModel::start() {
  ClosedSet set(pairs(), 0), last;
  compliance_ = 6.0 * pairs_.stiffness.cwiseInverse();
  for (int i = 0; i < pairs(); ++i)
    if (!pairs_.canChange[i]) compliance_(i) = 1.0;
  Equilibrium pads;
  for (int round = 0; round < kPatchRounds; ++round) {
    Vector reached;
    pads = soft_ ? soft_->project(pairs_.penetration, compliance_, reached) : project(pairs_.penetration);
    for (int i = 0; i < pairs(); ++i) set[i] = pads.force(i) > 0.0;
    if (set == last) break;
    last = set;
    const Vector length = patchLengths(set);
    for (int i = 0; i < pairs(); ++i)
      if (pairs_.canChange[i]) compliance_(i) = std::max(2.0, length(i)) / pairs_.stiffness(i);
  }
  if (!pads.found) throw NumericalError("contact: the loads push a body away from all contacts that could hold it");
  double size = 0.0;
  for (int i = 0; i < pairs(); ++i) size = std::max(size, std::abs(pairs_.penetration(i)));
  const SparseRows& rows = soft_ ? soft_->data().rows : pairs_.rows;
  for (int i = 0; i < pairs(); ++i)
    if (pairs_.canChange[i] && rows.row(i).norm() < kDependentRows && pairs_.penetration(i) >= -kTouching * size) set[i] = 1;
  return set;
}

Matrix RigidBodyModel::nullSpaceOf(const std::vector<Row>& rows) const {
  if (rows.empty()) return Matrix::Identity(motions(), motions());
  std::vector<Eigen::Triplet<double, int>> entries;
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (SparseRows::InnerIterator entry(rowsOf(rows[r].component), rows[r].pair); entry; ++entry)
      entries.emplace_back(static_cast<int>(r), static_cast<int>(entry.col()), entry.value());
  SparseMatrix sparse(static_cast<Eigen::Index>(rows.size()), motions());
  sparse.setFromTriplets(entries.begin(), entries.end());
  return motions() <= kMostDense ? nullSpace(Matrix(sparse), kDependentRows) : sparseNullSpace(sparse, kDependentRows);
}

Matrix RigidBodyModel::loose(const ClosedSet& closed) const {
  if (motions() == 0) return Matrix(0, 0);
  std::vector<Row> rows;
  for (const int i : members(closed, 1)) rows.push_back({0, i});
  return nullSpaceOf(rows);
}

Matrix RigidBodyModel::loose(const PairStates& states) const {
  if (motions() == 0) return Matrix(0, 0);
  std::vector<Row> rows;
  std::vector<int> springs;  // pairs
  for (std::size_t i = 0; i < states.size(); ++i) {
    const int pair = static_cast<int>(i);
    if (states[i].closed()) rows.push_back({0, pair});
    if (states[i].status == PairStatus::Stick)
      for (std::size_t c = 1; c <= pairs_.tangents.size(); ++c) rows.push_back({c, pair});
    else if (states[i].transverseStiffness > 0.0 && !pairs_.tangents.empty())
      springs.push_back(pair);
  }
  const Matrix free = nullSpaceOf(rows);
  if (springs.empty() || free.cols() == 0) return free;
  Matrix held = Matrix::Zero(static_cast<Eigen::Index>(springs.size()), free.cols());
  for (std::size_t r = 0; r < springs.size(); ++r) {
    const Point along = acrossSlip(states[static_cast<std::size_t>(springs[r])]);
    for (std::size_t c = 1; c <= pairs_.tangents.size(); ++c)
      for (SparseRows::InnerIterator entry(pairs_.tangents[c - 1], springs[r]); entry; ++entry)
        held.row(static_cast<Eigen::Index>(r)) += along[c] * entry.value() * free.row(entry.col());
  }
  return free * nullSpace(held, kWeakSprings);
}

bool RigidBodyModel::loosens(const PairStates& states) const { return motions() - static_cast<int>(loose(states).cols()) < rank_; }

bool RigidBodyModel::loosens(const ClosedSet& closed) const { return motions() - static_cast<int>(loose(closed).cols()) < rank_; }

std::vector<int> RigidBodyModel::stabilisingPairs(const ClosedSet& closed, const Matrix& loose) const {
  std::vector<int> open;
  for (const int i : members(closed, 0))
    if (pairs_.canChange[i]) open.push_back(i);
  std::vector<int> chosen;
  if (loose.cols() == 0 || open.empty()) return chosen;
  // Pivoted Gram-Schmidt on the rows: each next row stops most of the remaining motion.
  Matrix rest = rowsAt(pairs_.rows, open) * loose;
  for (Eigen::Index k = 0; k < loose.cols(); ++k) {
    Eigen::Index best = 0;
    const double most = rest.rowwise().norm().maxCoeff(&best);
    if (!(most > kDependentRows)) break;
    chosen.push_back(open[best]);
    const Vector direction = rest.row(best).transpose() / most;
    rest -= (rest * direction) * direction.transpose();
  }
  return chosen;
}

Vector RigidBodyModel::stabilisingForces(const std::vector<int>& stabilisingPairs, const Matrix& loose) const {
  Vector work = loose.transpose() * pairs_.work;
  const Vector size = loose.cwiseAbs().transpose() * pairs_.work.cwiseAbs();
  for (Eigen::Index k = 0; k < work.size(); ++k)
    if (std::abs(work(k)) <= kNoWork * size(k)) work(k) = 0.0;
  if (stabilisingPairs.empty() || work.isZero(0.0)) return Vector::Zero(static_cast<Eigen::Index>(stabilisingPairs.size()));
  const Matrix rows = rowsAt(pairs_.rows, stabilisingPairs) * loose;
  Vector force = leastSquares(rows.transpose(), work);
  const double least = kNoWork * force.cwiseAbs().maxCoeff();
  for (double& each : force)
    if (std::abs(each) <= least) each = 0.0;
  return force;
}

Vector RigidBodyModel::settle(const ClosedSet& closed, const Vector& penetration, const Matrix& loose) const {
  Vector z = Vector::Zero(loose.cols());
  std::vector<int> open;
  for (const int i : members(closed, 0))
    if (pairs_.canChange[i]) open.push_back(i);
  if (loose.cols() == 0 || open.empty()) return z;
  const Vector w = penetration(open);
  if (!(w.maxCoeff() > 0.0)) return z;
  const Matrix rows = rowsAt(pairs_.rows, open) * loose;
  const Vector stiffness = Vector(compliance_(open)).cwiseInverse(), none = Vector::Zero(loose.cols());
  const UnilateralFoundation problem(rows, stiffness, none, 1e-12 * w.cwiseMax(0.0).dot(stiffness));
  Vector moved = w;
  problem.solve(z, moved);
  return z;
}

// The cone {z : G z <= 0} is a point if and only if its polar cone, spanned by the rows of G, is the whole space.
Matrix RigidBodyModel::neutral(const ClosedSet& carrying, const ClosedSet& touching) const {
  const Matrix free = loose(carrying);
  if (free.cols() == 0) return Matrix(motions(), 0);
  const std::vector<int> at = members(touching, 1);
  const Matrix rows = rowsAt(pairs_.rows, at) * free;
  Matrix found(free.cols(), 0);
  for (Eigen::Index k = 0; k < free.cols(); ++k)
    for (const double sign : {1.0, -1.0}) {
      Vector rest = sign * Vector::Unit(free.cols(), k);
      if (!at.empty()) rest -= rows.transpose() * nonnegativeLeastSquares(rows.transpose(), rest);
      if (rest.norm() <= kStopped) continue;
      found.conservativeResize(Eigen::NoChange, found.cols() + 1);
      found.rightCols(1) = rest.normalized();
    }
  return found.cols() > 0 ? Matrix(free * orthonormalBasis(found, 1e-9)) : Matrix(motions(), 0);
}

int RigidBodyModel::bodies() const {
  int bodies = 0;
  for (const auto& own : pairs_.bodies)
    for (const int body : own) bodies = std::max(bodies, body + 1);
  return bodies;
}

Vector RigidBodyModel::clusterScale(const ClosedSet& closed, const Vector& values) const {
  DisjointSets clusters(bodies());
  for (int i = 0; i < pairs(); ++i)
    if (closed[i] && !pairs_.bodies.empty())
      for (const int body : pairs_.bodies[i]) clusters.join(body, pairs_.bodies[i].front());
  return scaleOf(clusters, closed, values, false);
}

Vector RigidBodyModel::bodyScale(const ClosedSet& closed, const Vector& values) const {
  return scaleOf(DisjointSets(bodies()), closed, values, true);
}

/// Largest magnitude among the closed pairs of the sets that a pair's bodies belong to: minimum or maximum over these sets.
Vector RigidBodyModel::scaleOf(DisjointSets sets, const ClosedSet& closed, const Vector& values, bool least) const {
  Vector scale = Vector::Zero(pairs());
  if (pairs_.bodies.empty()) {
    if (values.size() > 0) scale.setConstant(values.cwiseAbs().maxCoeff());
    return scale;
  }
  std::vector<double> most(bodies(), 0.0);
  for (int i = 0; i < pairs(); ++i)
    if (closed[i])
      for (const int body : pairs_.bodies[i]) most[sets.lowest(body)] = std::max(most[sets.lowest(body)], std::abs(values(i)));
  for (int i = 0; i < pairs(); ++i) {
    if (pairs_.bodies[i].empty()) continue;
    double& own = scale(i) = most[sets.lowest(pairs_.bodies[i].front())];
    for (const int body : pairs_.bodies[i]) {
      const double other = most[sets.lowest(body)];
      own = least ? std::min(own, other) : std::max(own, other);
    }
  }
  return scale;
}

}  // namespace suture
