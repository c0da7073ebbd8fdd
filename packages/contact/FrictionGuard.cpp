// FrictionSearch: pairs that keep bodies from being unconstrained.
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/algebra/dense/NonnegativeLeastSquares.hpp>
#include <suture/contact/Collapse.hpp>
#include <suture/contact/FrictionSearch.hpp>
#include <suture/contact/PadProblem.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

namespace {

constexpr std::size_t kMeetings = 20;  // number of states to which driven bodies are moved
constexpr double kLeastWay = 1e-2;     // first displacement tried, relative to the shortest one after which something may change
constexpr double kMostWay = 1e3;       // last displacement tried, relative to the longest such one
constexpr int kEdges = 16;             // planes of the pyramid around a friction cone
constexpr double kOutdone = 1e-7;      // least unbalanced fraction of the loads
constexpr double kCollapsed = 1.02;    // friction multiple at a limit equilibrium above which no other states are tried
constexpr int kCollapseSolves = 10;    // solves for this multiple

}  // namespace

/// If the next states would leave a body unconstrained, re-activates pairs that previously held it: one per free motion, chosen for the
/// best conditioning.
PairStates FrictionSearch::guarded(PairStates next, const PairStates& before) {
  holders_.assign(next.size(), 0);
  Matrix free = rigid_.loose(next);
  const RigidContact::Pairs& data = rigid_.data();
  while (free.cols() > 0) {
    std::size_t best = next.size();
    bool sticks = false;
    for (int round = 0; round < 3 && best == next.size(); ++round) {  // 1: pairs that held without success; 2: open pairs
      double most = kDependentRows;
      for (std::size_t i = 0; i < next.size(); ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        if (!data.able[i] || (before[i].closed() ? spent_[i] != 0 : 2) != round) continue;
        if (!next[i].closed())
          if (const double size = (data.rows.row(at) * free).norm(); size > most) most = size, best = i, sticks = false;
        if (next[i].status != PairStatus::Stick)
          for (const Matrix& tangent : data.tangents)
            if (const double size = (tangent.row(at) * free).norm(); size > most) most = size, best = i, sticks = true;
      }
    }
    if (best == next.size()) break;
    if (sticks || before[best].status == PairStatus::Stick || !before[best].closed()) {
      next[best].status = laws_.of(data.line[best]).rows(2) > 1 ? PairStatus::Stick : PairStatus::Slip;
      next[best].direction = {0, 0, 0};
      next[best].across = 0.0;
    } else {
      next[best] = before[best];
    }
    holders_[best] = 1;
    const Matrix now = rigid_.loose(next);
    if (now.cols() >= free.cols()) break;
    free = now;
  }
  return next;
}

/// Motion along which the loads drive bodies, among those that the states leave free: it follows from the forces by which pairs exceeded
/// their laws before they got these states. Zero if nothing drives the bodies. \param changed  these pairs
Vector FrictionSearch::drivenMotion(const PairStates& next, const std::vector<std::size_t>& changed) const {
  const RigidContact::Pairs& data = rigid_.data();
  const Matrix free = rigid_.loose(next);
  Vector work = Vector::Zero(free.cols());
  for (const std::size_t i : changed) {
    const auto at = static_cast<Eigen::Index>(i);
    work += answer_.force(at, 0) * (next[i].closed() ? 0.0 : 1.0) * (data.rows.row(at) * free).transpose();
    for (std::size_t k = 0; k < data.tangents.size(); ++k) {
      const auto component = static_cast<Eigen::Index>(k + 1);
      const double allowed = next[i].closed() ? next[i].largest(answer_.force(at, 0)) * next[i].direction[k + 1] : 0.0;
      work += (answer_.force(at, component) - allowed) * (data.tangents[k].row(at) * free).transpose();
    }
  }
  const Vector motion = free * work;
  const double length = motion.norm();
  return length > 0.0 ? Vector(motion / length) : Vector::Zero(rigid_.motions());
}

/// Moves bodies that the next states leave unconstrained along the loads to the states that they reach. False if no body is unconstrained,
/// or no new state is reached.
bool FrictionSearch::follow(PairStates& next) {
  const auto loose = static_cast<int>(rigid_.loose(next).cols());
  if (loose == 0) return false;
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < next.size(); ++i)
    if (rigid_.data().able[i] && next[i].status != states_[i].status) changed.push_back(i);
  const Vector motion = drivenMotion(next, changed);
  return motion.squaredNorm() > 0.0 && drag(motion, loose, next);
}

/// Releases pairs that hold a body beyond their law: other pairs hold it, or those that it reaches when the loads drive it. False if there
/// are none; slides_ is then the driven motion.
bool FrictionSearch::relieve(const PairStates& next) {
  const std::vector<char> holders = holders_;
  std::vector<std::size_t> driven;
  for (std::size_t i = 0; i < next.size(); ++i)
    if (holders[i] && next[i].status != states_[i].status) driven.push_back(i);
  for (const std::size_t i : driven) spent_[i] = 1;
  slides_ = drivenMotion(next, driven);
  if (outdone_.size() > 0) return false;
  const auto loose = static_cast<int>(rigid_.loose(next).cols());
  PairStates other = guarded(next, states_);
  bool inVain = false;
  for (std::size_t i = 0; i < next.size(); ++i) inVain = inVain || (spent_[i] && holders_[i]);
  if (inVain || rigid_.loose(other).cols() > 0) {
    if (!(slides_.squaredNorm() > 0.0) || !drag(slides_, loose, other)) {
      holders_ = holders;
      return false;
    }
  }
  states_ = std::move(other);
  return true;
}

/// Moves bodies rigidly until the laws give states that hold them better; forces stay in equilibrium. False if there are none, or only
/// states reached before.
/// \param loose  number of motions that are free now;  \param found  receives the states
bool FrictionSearch::drag(const Vector& motion, int loose, PairStates& found) {
  const RigidContact::Pairs& data = rigid_.data();
  Matrix way = Matrix::Zero(answer_.jump.rows(), 3);
  way.col(0) = data.rows * motion;
  for (std::size_t k = 0; k < data.tangents.size(); ++k) way.col(static_cast<Eigen::Index>(k + 1)) = data.tangents[k] * motion;
  double least = std::numeric_limits<double>::infinity(), most = 0.0;  // displacements after which something may change
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (!data.able[i] || !(way.row(at).norm() > kDependentRows)) continue;
    const double length = states_[i].closed() ? answer_.force.row(at).norm() / data.stiffness(at) : std::abs(answer_.jump(at, 0));
    if (length > 0.0) least = std::min(least, length);
    most = std::max(most, length);
  }
  for (double length = kLeastWay * least; length <= kMostWay * most; length *= 2.0) {
    violation(answer_.force, answer_.jump + length * way, &found);
    if (rigid_.loose(found).cols() >= loose) continue;
    const PairStates before = found;
    found = guarded(before, before);
    if (std::find(met_.begin(), met_.end(), found) != met_.end()) continue;
    met_.push_back(found);
    return met_.size() <= kMeetings;
  }
  return false;
}

/// Rigid motion in which the loads do more work than all pairs, including open ones, can resist by their laws (limit analysis, static
/// theorem): no equilibrium exists at any position of the bodies with these pairs. Empty: pair forces can balance the loads, or the result
/// is unknown.
Vector FrictionSearch::outdone() const {
  constexpr double kBeyond = 1e150;  // slip, as a force, beyond any finite bound
  const RigidContact::Pairs& data = rigid_.data();
  const int motions = rigid_.motions();
  const double size = data.work.norm();
  if (size == 0.0) return {};
  std::vector<std::vector<std::pair<int, double>>> columns;  // entries in motions and bounds, per possible force of a pair
  std::vector<double> bounds;
  const auto column = [&](const Vector& ofMotions) {
    columns.emplace_back();
    for (int k = 0; k < motions; ++k)
      if (ofMotions(k) != 0.0) columns.back().emplace_back(k, ofMotions(k));
  };
  const int edges = data.tangents.size() == 2 ? kEdges : 2;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    if (!data.able[i]) continue;
    const auto at = static_cast<Eigen::Index>(i);
    const Vector normal = data.rows.row(at).transpose();
    column(normal);
    if (data.tangents.empty() || laws_.of(data.line[i]).rows(2) < 2) continue;
    int bound = -1;
    for (int edge = 0; edge < edges; ++edge) {
      const double angle = 2.0 * M_PI * edge / edges;
      ContactTrial trial;
      trial.place = sites_[i].place;
      trial.size = sites_[i].size;
      trial.slipped = sites_[i].slipped;
      trial.force[0] = 1.0;
      trial.jump = {0.0, kBeyond * std::cos(angle), data.tangents.size() == 2 ? kBeyond * std::sin(angle) : 0.0};
      const ContactState state = laws_.of(data.line[i]).project(trial, PairStatus::Slip);
      if (state.status != PairStatus::Slip) return {};  // it may hold any force
      Vector along = std::cos(angle) * data.tangents[0].row(at).transpose();
      if (data.tangents.size() == 2) along += std::sin(angle) * data.tangents[1].row(at).transpose();
      along /= std::cos(M_PI / (edges == 2 ? 1e300 : edges));  // planes around the cone
      if (state.friction > 0.0) column(normal + state.friction * along);
      if (!(state.bound > 0.0)) continue;
      if (bound < 0) {
        bound = motions + static_cast<int>(bounds.size());
        bounds.push_back(state.bound);
        columns.push_back({{bound, 1.0}});  // the unused part of the bound
      }
      column(along);
      columns.back().emplace_back(bound, 1.0);
    }
  }
  Matrix all = Matrix::Zero(motions + static_cast<Eigen::Index>(bounds.size()), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k)
    for (const auto& [row, value] : columns[k]) all(row, static_cast<Eigen::Index>(k)) += value;
  Vector right(all.rows());
  right.head(motions) = data.work / size;
  for (std::size_t k = 0; k < bounds.size(); ++k) right(motions + static_cast<Eigen::Index>(k)) = bounds[k] / size;
  const Vector rest = right - all * nonnegativeLeastSquares(all, right);
  return rest.head(motions).norm() > kOutdone ? Vector(rest.head(motions).normalized()) : Vector();
}

/// Applies Collapse to the last states. True if bodies slide beyond doubt: other states would need very different normal forces.
bool FrictionSearch::collapses() {
  if (answer_.force.size() == 0) return false;
  // Runs even if no solves are left for the search, because the reason of failure is worth them.
  const Collapse::Result found = Collapse(rigid_, laws_, sites_, oracle_).find(states_, normalForces(), kCollapseSolves);
  solves_ += found.solves;
  left_ = std::max(0, left_ - found.solves);
  mechanism_ = found.motion;
  multiple_ = found.multiple;
  return multiple_ > kCollapsed;
}

}  // namespace suture
