#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/contact/PairResponse.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kTold = 0.05;  // normal force of a pair, relative to the largest force, above which opening the pair is accurate enough
constexpr double kImmovable = 1e-5;  // compliance of a direction in which both sides are held, relative to the largest one
constexpr double kHeld = 1e-6;       // compliance assigned to such a direction, likewise relative; has no effect on the result

}  // namespace

Vector PairResponse::gather(const Matrix& values) const {
  Vector all(static_cast<Eigen::Index>(rows_.size()));
  for (Eigen::Index r = 0; r < all.size(); ++r) all(r) = values(static_cast<Eigen::Index>(rows_[r].pair), rows_[r].component);
  return all;
}

Matrix PairResponse::spread(const Vector& values, Eigen::Index pairs) const {
  Matrix all = Matrix::Zero(pairs, 3);
  for (Eigen::Index r = 0; r < values.size(); ++r) all(static_cast<Eigen::Index>(rows_[r].pair), rows_[r].component) = values(r);
  return all;
}

bool PairResponse::solve(FrictionOracle& oracle, const PairStates& states, Vector& force, Vector& jump) {
  ++solves_;
  const FrictionAnswer answer = oracle.solve(states, oracle.tightest());
  if (!answer.solved) return false;
  force = gather(answer.force);
  jump = gather(answer.jump);
  scale_ = std::max(scale_, answer.force.rowwise().norm().maxCoeff());
  return oracle.goesOn();
}

/// State of a pair that slides along a row's tangent under a force opposite to its sticking force.
ContactState PairResponse::sliding(Eigen::Index row, double force) const {
  ContactState state(PairStatus::Slip);
  state.direction[rows_[row].component] = force_(row) > 0.0 ? -1.0 : 1.0;
  state.bound = force;
  return state;
}

/// Columns of tangents. A pair may slide along all of its tangents, along one of them, or along none if both sides are held.
bool PairResponse::slide(const RigidContact& rigid, FrictionOracle& oracle, const PairStates& stuck) {
  const auto n = static_cast<Eigen::Index>(rows_.size());
  const double force = scale_;
  Matrix jumps = Matrix::Zero(n, n);
  for (Eigen::Index row = 0; row < n; ++row) {
    if (rows_[row].component == 0) continue;
    PairStates states = stuck;
    states[rows_[row].pair] = sliding(row, force);
    Vector felt, jump;
    if (rigid.loose(states).cols() > 0 || !solve(oracle, states, felt, jump)) return false;
    jumps.col(row) = jump;
    changes_.col(row) = force_ - felt;
  }
  softest_ = jumps.cwiseAbs().maxCoeff() / force;
  for (Eigen::Index first = 0, count = 0; first < n; first += 1 + count) {
    count = 0;
    while (first + 1 + count < n && rows_[first + 1 + count].component > 0) ++count;
    if (count == 0) continue;
    const SingularValues own = singularValues(jumps.block(first + 1, first + 1, count, count));
    for (Eigen::Index k = 0; k < count; ++k) {
      Vector column = Vector::Zero(n);
      if (own.values(k) > kImmovable * softest_ * force)
        column = changes_.middleCols(first + 1, count) * own.v.col(k) / own.values(k);
      else
        column.segment(first + 1, count) = own.u.col(k) / (kHeld * softest_);
      stiffness_.middleCols(first + 1, count) += column * own.u.col(k).transpose();
    }
  }
  return true;
}

/// The row that, when its pair slides, changes the force of a normal row most and leaves no body unconstrained when that row is open; -1:
/// none.
Eigen::Index PairResponse::press(const RigidContact& rigid, Eigen::Index row, const PairStates& stuck) const {
  Eigen::Index by = -1;
  double most = 0.0;
  for (Eigen::Index r = 0; r < changes_.cols(); ++r) {
    const double size = std::abs(changes_(row, r));
    if (rows_[r].pair == rows_[row].pair || !(size > most)) continue;
    PairStates states = stuck;
    states[rows_[row].pair] = PairStatus::Open;
    states[rows_[r].pair] = sliding(r, scale_);
    if (rigid.loose(states).cols() > 0) continue;
    most = size;
    by = r;
  }
  return by;
}

/// Columns of normals. A pair that opens also slides. A pair with little force hardly opens unless another pair presses on it.
bool PairResponse::open(const RigidContact& rigid, FrictionOracle& oracle, const PairStates& stuck) {
  const double scale = scale_;
  for (Eigen::Index row = 0; row < force_.size(); ++row) {
    if (rows_[row].component > 0) continue;
    PairStates states = stuck;
    states[rows_[row].pair] = PairStatus::Open;
    if (rigid.loose(states).cols() > 0) return false;
    if (std::abs(force_(row)) < kTold * scale)
      if (const Eigen::Index by = press(rigid, row, stuck); by >= 0)
        states[rows_[by].pair] = sliding(by, scale * std::max(1.0, std::abs(changes_(by, by) / changes_(row, by))));
    Vector felt, jump;
    if (!solve(oracle, states, felt, jump)) return false;
    softest_ = std::max(softest_, std::abs(jump(row)) / scale_);
    if (std::abs(jump(row)) <= kImmovable * softest_ * scale) {
      stiffness_(row, row) = 1.0 / (kHeld * softest_);
      continue;
    }
    Vector change = force_ - felt;
    for (Eigen::Index r = 0; r < force_.size(); ++r)
      if (rows_[r].component > 0) change -= stiffness_.col(r) * jump(r);
    stiffness_.col(row) = change / jump(row);
  }
  return true;
}

bool PairResponse::measure(const RigidContact& rigid, FrictionOracle& oracle, const PairStates& stuck, std::size_t most) {
  const auto tangents = static_cast<int>(rigid.data().tangents.size());
  for (std::size_t i = 0; i < stuck.size(); ++i)
    for (int k = 0; rigid.data().able[i] && k <= (stuck[i].status == PairStatus::Stick ? tangents : 0); ++k) rows_.push_back({i, k});
  if (rows_.empty() || rows_.size() > most || rigid.loose(stuck).cols() > 0) return false;
  const auto n = static_cast<Eigen::Index>(rows_.size());
  Vector none;
  if (!solve(oracle, stuck, force_, none) || !(scale_ > 0.0)) return false;
  stiffness_ = changes_ = Matrix::Zero(n, n);
  if (!slide(rigid, oracle, stuck) || !open(rigid, oracle, stuck)) return false;
  stiffness_ = (0.5 * (stiffness_ + stiffness_.transpose())).eval();
  return stiffness_.allFinite();
}

}  // namespace suture
