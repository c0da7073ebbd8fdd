#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/search/Collapse.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

namespace {

constexpr double kBeyond = 1e150;  // slip, as a force, beyond any finite bound
constexpr double kSame = 1e-3;     // relative change of the multiple at convergence
constexpr double kRound = 1e-6;    // slip, relative to the largest, below which resistance is linear in slip
constexpr int kReweighted = 60;    // maximum number of least squares problems for the steepest motion
constexpr double kSettled = 1e-9;  // relative change of this motion at convergence
constexpr double kStart = 0.7;     // least multiple for which a mechanism is examined while normal forces belong to other states

}  // namespace

Vector Collapse::slipOf(std::size_t pair, const Vector& motion) const {
  const std::vector<SparseRows>& tangents = rigid_.data().tangents;
  Vector slip = Vector::Zero(2);
  for (std::size_t k = 0; k < tangents.size(); ++k)
    slip(static_cast<Eigen::Index>(k)) = tangents[k].row(static_cast<Eigen::Index>(pair)).dot(motion);
  return slip;
}

/// State of a closed pair that slides along a direction; sticks if its law admits any force.
ContactState Collapse::slipping(std::size_t pair, const Vector& slip, double normal, double multiple) const {
  ContactTrial trial;
  trial.place = sites_[pair].place;
  trial.size = sites_[pair].size;
  trial.slipped = true;
  trial.force[0] = normal;
  const double size = slip.norm();
  for (int k = 0; k < 2; ++k) trial.jump[static_cast<std::size_t>(k) + 1] = kBeyond * (size > 0.0 ? slip(k) / size : k == 0 ? 1.0 : 0.0);
  ContactState state = laws_.of(rigid_.data().line[pair]).project(trial, PairStatus::Slip);
  if (state.status != PairStatus::Slip) return PairStatus::Stick;
  state.bound *= multiple;
  state.friction *= multiple;
  if (!solver_.couplesToNormal()) {
    state.bound = state.largest(normal);
    state.friction = 0.0;
  }
  return state;
}

double Collapse::bound(std::size_t pair, const Vector& slip, double normal) const {
  const ContactState state = slipping(pair, slip, normal, 1.0);
  return state.status == PairStatus::Stick ? std::numeric_limits<double>::infinity() : state.largest(normal);
}

/// Motions that keep the normal gaps of closed pairs and do not slide pairs whose law admits any force.
Matrix Collapse::mechanisms(const ClosedSet& closed) const {
  PairStates states(closed.size());
  for (std::size_t i = 0; i < closed.size(); ++i) {
    if (!closed[i]) continue;
    const bool restricts = laws_.of(rigid_.data().line[i]).rows(2) > 1;
    states[i] = restricts ? slipping(i, Vector::Zero(2), 1.0, 1.0) : ContactState(PairStatus::Slip);
    states[i].transverseStiffness = 0.0;
  }
  return rigid_.loose(states);
}

double Collapse::resistance(const ClosedSet& closed, const Vector& normal, const Vector& motion) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < closed.size(); ++i) {
    if (!closed[i] || laws_.of(rigid_.data().line[i]).rows(2) < 2) continue;
    const Vector slip = slipOf(i, motion);
    if (slip.norm() > kDependentRows) sum += bound(i, slip, normal(static_cast<Eigen::Index>(i))) * slip.norm();
  }
  return sum;
}

/// The mechanism along which the loads exceed the resistance most, of unit length: the minimiser of the convex function resistance(m) - e.m
/// + |e| |m|^2 / 2, by iteratively reweighted least squares.
Vector Collapse::steepest(const ClosedSet& closed, const Vector& normal, const Matrix& mechanisms) const {
  const Vector load = mechanisms.transpose() * rigid_.data().work;
  const double size = load.norm();
  if (!(size > 0.0)) return Vector::Zero(rigid_.motions());
  Vector z = load / size;
  for (int round = 0; round < kReweighted; ++round) {
    Matrix a = size * Matrix::Identity(z.size(), z.size());
    const Vector motion = mechanisms * z;
    double largest = 0.0;
    std::vector<Vector> slips(closed.size());
    for (std::size_t i = 0; i < closed.size(); ++i)
      if (closed[i] && laws_.of(rigid_.data().line[i]).rows(2) > 1) {
        slips[i] = slipOf(i, motion);
        largest = std::max(largest, slips[i].norm());
      }
    for (std::size_t i = 0; i < closed.size(); ++i) {
      if (slips[i].size() == 0 || !(largest > 0.0)) continue;
      const auto at = static_cast<Eigen::Index>(i);
      const double weight = bound(i, slips[i], normal(at)) / std::hypot(slips[i].norm(), kRound * largest);
      if (!std::isfinite(weight)) continue;
      for (const SparseRows& tangent : rigid_.data().tangents) {
        const Vector row = (tangent.row(at) * mechanisms).transpose();
        a += weight * row * row.transpose();
      }
    }
    const Vector next = leastSquares(a, load);
    const bool settled = (next - z).norm() <= kSettled * next.norm();
    z = next;
    if (settled) break;
  }
  const double length = z.norm();
  return length > 0.0 && std::isfinite(length) ? Vector(mechanisms * z / length) : Vector::Zero(rigid_.motions());
}

/// True if open pairs may close along the motion.
bool Collapse::meetsOthers(const ClosedSet& closed, const Vector& motion) const {
  for (std::size_t i = 0; i < closed.size(); ++i)
    if (!closed[i] && rigid_.data().canChange[i] && rigid_.data().rows.row(static_cast<Eigen::Index>(i)).dot(motion) > kDependentRows)
      return true;
  return false;
}

/// Closed pairs slide along the motion where it moves them. Each motion that is still free is held by the pair with the largest normal
/// force.
PairStates Collapse::sliding(const ClosedSet& closed, const Vector& normal, const Vector& motion, double multiple,
                             const PairStates& now) const {
  PairStates states(closed.size());
  for (std::size_t i = 0; i < closed.size(); ++i) {
    if (!closed[i]) {
      if (!rigid_.data().canChange[i]) states[i] = now[i];
      continue;
    }
    const Vector slip = slipOf(i, motion);
    if (laws_.of(rigid_.data().line[i]).rows(2) < 2)
      states[i] = PairStatus::Slip;
    else if (slip.norm() > kDependentRows)
      states[i] = slipping(i, slip, normal(static_cast<Eigen::Index>(i)), multiple);
    else
      states[i] = now[i].closed() ? now[i] : ContactState(PairStatus::Stick);
    states[i].transverseStiffness = 0.0;
  }
  for (Matrix loose = rigid_.loose(states); loose.cols() > 0;) {
    std::size_t best = states.size();
    double most = 0.0;
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (!closed[i] || states[i].status == PairStatus::Stick || laws_.of(rigid_.data().line[i]).rows(2) < 2) continue;
      double moved = 0.0;
      for (const SparseRows& tangent : rigid_.data().tangents)
        moved = std::max(moved, (tangent.row(static_cast<Eigen::Index>(i)) * loose).norm());
      if (moved <= kDependentRows) continue;
      if (const double held = moved * std::max(normal(static_cast<Eigen::Index>(i)), 0.0); best == states.size() || held > most)
        best = i, most = held;
    }
    if (best == states.size()) break;
    states[best] = PairStatus::Stick;
    const Matrix rest = rigid_.loose(states);
    if (rest.cols() >= loose.cols()) break;
    loose = rest;
  }
  return states;
}

Collapse::Result Collapse::find(const PairStates& states, Vector normal, int most) const {
  const RigidBodyModel::Pairs& data = rigid_.data();
  Result result;
  if (data.tangents.empty() || rigid_.motions() == 0 || normal.size() != rigid_.pairs()) return result;
  ClosedSet closed(states.size(), 0);
  for (std::size_t i = 0; i < closed.size(); ++i) closed[i] = data.canChange[i] && states[i].closed();
  double last = 0.0;
  const double tolerance = std::sqrt(solver_.loosest() * solver_.tightest());
  while (true) {
    normal = normal.cwiseMax(0.0);
    const Matrix free = mechanisms(closed);
    if (free.cols() == 0) return result;
    const Vector motion = steepest(closed, normal, free);
    const double work = data.work.dot(motion), held = resistance(closed, normal, motion);
    const double multiple = held > 0.0 ? work / held : 0.0;
    if (!(multiple > (last > 0.0 ? 1.0 : kStart)) || !std::isfinite(multiple) || meetsOthers(closed, motion)) return result;
    if (last > 0.0 && std::abs(multiple - last) <= kSame * last) {
      result.motion = motion;
      result.multiple = multiple;
      return result;
    }
    if (result.solves >= most || !solver_.goesOn()) return result;
    last = multiple;
    ++result.solves;
    const ContactAnswer answer = solver_.solve(sliding(closed, normal, motion, multiple, states), tolerance);
    if (!answer.solved) return result;
    bool changed = false;
    for (std::size_t i = 0; i < closed.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      if (!data.canChange[i]) continue;
      const bool wrong = closed[i] ? answer.force(at, 0) < -answer.forceTolerance(at) && laws_.of(data.line[i]).separates()
                                   : answer.jump(at, 0) > answer.jumpTolerance(at);
      if (wrong) closed[i] = !closed[i];
      changed = changed || wrong;
      normal(at) = closed[i] ? answer.force(at, 0) : 0.0;
    }
    if (changed) last = 0.0;
  }
}

}  // namespace suture
