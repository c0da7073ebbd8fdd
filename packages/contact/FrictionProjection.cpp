// FrictionSearch: states that the laws give for forces and jumps.
#include <suture/contact/FrictionSearch.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kConstant =
    0.05;  // constant relative to the stiffness of a pair's nodes: a tenth of the local stiffness, which is half of theirs
constexpr double kAcross =
    200.0;  // largest stiffness across the direction of slip, relative to that constant; affects only the path of the iteration

/// The state with its bound computed from a given normal force, as in a Tresca problem. `first` and `second` are the tangential trial
/// force.
ContactState frozen(ContactState state, double normal, double scale, double first, double second) {
  if (!state.closed()) return state;
  state.bound = scale * state.largest(normal);
  state.friction = 0.0;
  const double size = std::hypot(first, second);
  state.status = size < state.bound || size == 0.0 ? PairStatus::Stick : PairStatus::Slip;
  state.direction = {0, 0, 0};
  if (state.status == PairStatus::Slip) state.direction = {0.0, first / size, second / size};
  return state;
}

/// The state with the friction of its law scaled.
ContactState scaled(ContactState state, double scale, double normal, double first, double second) {
  state.bound *= scale;
  state.friction *= scale;
  const double size = std::hypot(first, second);
  state.status = size <= state.largest(normal) ? PairStatus::Stick : PairStatus::Slip;
  state.direction = {0, 0, 0};
  if (state.status == PairStatus::Slip) state.direction = {0.0, first / size, second / size};
  return state;
}

}  // namespace

ContactState FrictionSearch::project(std::size_t pair, const ContactState& now, const FrictionAnswer& at) const {
  const auto i = static_cast<Eigen::Index>(pair);
  const FrictionSite& site = sites_[pair];
  const double constant = kConstant * site.tangential, tolerance = at.forceTolerance(i);
  ContactTrial trial;
  trial.place = site.place;
  trial.size = site.size;
  trial.slipped = site.slipped;
  // The tolerance favours the current state of the pair.
  if (now.closed())
    trial.force[0] = at.force(i, 0) + tolerance;
  else
    trial.jump[0] = (at.jump(i, 0) - at.jumpTolerance(i)) * rigid_.data().stiffness(i);
  for (int k = 1; k <= 2; ++k) {
    trial.force[k] = at.force(i, k);
    if (now.status != PairStatus::Stick) trial.jump[k] = constant * at.jump(i, k);
  }
  if (now.status == PairStatus::Stick) {
    const double size = std::hypot(at.force(i, 1), at.force(i, 2)), less = size > 0.0 ? std::max(0.0, 1.0 - tolerance / size) : 0.0;
    for (int k = 1; k <= 2; ++k) trial.force[k] *= less;
  } else if (now.status == PairStatus::Slip) {
    for (int k = 1; k <= 2; ++k) trial.force[k] += tolerance * now.direction[k];
  }
  const ContactState next = onto(pair, now, trial);
  // Slip reverses through stick: pairs that skip stick cycle if little except friction holds a body.
  if (now.status == PairStatus::Slip && next.status == PairStatus::Slip &&
      now.direction[1] * next.direction[1] + now.direction[2] * next.direction[2] < 0.0) {
    ContactState between = next;
    between.status = PairStatus::Stick;
    between.direction = {0, 0, 0};
    between.across = 0.0;
    return between;
  }
  return next;
}

/// State of a trial, with the transverse stiffness of slip.
ContactState FrictionSearch::onto(std::size_t pair, const ContactState& now, const ContactTrial& trial) const {
  ContactState next = laws_.of(rigid_.data().line[pair]).project(trial, now);
  const double first = trial.force[1] + trial.jump[1], second = trial.force[2] + trial.jump[2];
  const bool rubs = laws_.of(rigid_.data().line[pair]).rows(2) > 1;
  if (rubs && normal_.size() > 0)
    next = frozen(next, normal_(static_cast<Eigen::Index>(pair)), scale_, first, second);
  else if (rubs && scale_ != 1.0 && next.closed())
    next = scaled(next, scale_, trial.force[0] + trial.jump[0], first, second);
  if (next.status == PairStatus::Slip && rigid_.data().tangents.size() == 2 && next.direction != Point{0, 0, 0}) {
    const double constant = kConstant * sites_[pair].tangential, bound = next.largest(trial.force[0] + trial.jump[0]),
                 beyond = std::hypot(first, second) - bound;
    next.across = constant * (beyond * kAcross > bound ? bound / beyond : kAcross);
  }
  return next;
}

/// Squared distance of forces from their projections by the laws, for jumps in equilibrium with these forces.
/// \param states  receives the states of the projection, or null
double FrictionSearch::violation(const Matrix& force, const Matrix& jump, PairStates* states) const {
  double sum = 0.0;
  if (states) *states = states_;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    if (!rigid_.data().able[i]) continue;
    const auto at = static_cast<Eigen::Index>(i);
    ContactTrial trial;
    trial.place = sites_[i].place;
    trial.size = sites_[i].size;
    trial.slipped = sites_[i].slipped;
    for (int k = 0; k <= 2; ++k) {
      trial.force[k] = force(at, k);
      trial.jump[k] = (k == 0 ? normalConstant_ * rigid_.data().stiffness(at) : kConstant * sites_[i].tangential) * jump(at, k);
    }
    const ContactState next = onto(i, states_[i], trial);
    const double normal = trial.force[0] + trial.jump[0];
    Point allowed{0, 0, 0};
    if (next.closed()) allowed[0] = normal;
    for (int k = 1; k <= 2; ++k)
      if (next.status == PairStatus::Stick)
        allowed[k] = trial.force[k] + trial.jump[k];
      else if (next.status == PairStatus::Slip)
        allowed[k] = next.largest(normal) * next.direction[k];
    for (int k = 0; k <= 2; ++k) sum += (trial.force[k] - allowed[k]) * (trial.force[k] - allowed[k]);
    if (states) (*states)[i] = next;
  }
  return sum;
}

PairStates FrictionSearch::projected(const PairStates& now, const FrictionAnswer& at) const {
  PairStates next = now;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (rigid_.data().able[i]) next[i] = project(i, now[i], at);
  return next;
}

/// Difference between a slipping pair's tangential force and its bound in the direction of slip, relative to the force tolerance.
double FrictionSearch::turn(std::size_t pair, const ContactState& next) const {
  const auto at = static_cast<Eigen::Index>(pair);
  if (next.status != PairStatus::Slip || !(answer_.forceTolerance(at) > 0.0)) return 0.0;
  const double bound = next.largest(answer_.force(at, 0));
  return std::hypot(answer_.force(at, 1) - bound * next.direction[1], answer_.force(at, 2) - bound * next.direction[2]) /
         answer_.forceTolerance(at);
}

}  // namespace suture
