#include <suture/search/LawProjection.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

namespace {

constexpr double kNormal = 0.2;  // fraction of the normal stiffness in R
constexpr double kLawAcross =
    200.0;  // largest stiffness across the direction of slip, relative to R; affects only the path of the iteration
constexpr double kLawPushed = 1e150;  // slip, as a force, beyond any finite bound
constexpr int kDirections = 16;       // directions in which the bound of a law is evaluated

/// The state with its bound computed from a given normal force. `first` and `second` are the tangential trial force.
ContactState frozen(ContactState state, double normal, double first, double second) {
  if (!state.closed()) return state;
  state.bound = state.largest(normal);
  state.friction = 0.0;
  const double size = std::hypot(first, second);
  state.status = size < state.bound || size == 0.0 ? PairStatus::Stick : PairStatus::Slip;
  state.direction = {0, 0, 0};
  if (state.status == PairStatus::Slip) state.direction = {0.0, first / size, second / size};
  return state;
}

}  // namespace

LawProjection::LawProjection(const RigidBodyModel& rigid, const ContactLaws& laws, const std::vector<FrictionSite>& sites, Vector normal)
    : rigid_(rigid), laws_(laws), sites_(sites), normal_(std::move(normal)) {
  for (std::size_t i = 0; i < rigid.data().line.size(); ++i)
    frictionless_ = frictionless_ && !(rigid.data().canChange[i] && restrictsSliding(i));
}

ContactTrial LawProjection::trialOf(std::size_t pair) const {
  ContactTrial trial;
  trial.place = sites_[pair].place;
  trial.size = sites_[pair].size;
  trial.slipped = sites_[pair].slipped;
  return trial;
}

Point LawProjection::stiff(std::size_t pair, const Matrix& jump) const {
  const auto at = static_cast<Eigen::Index>(pair);
  const double tangential = tangential_ * sites_[pair].tangential;
  return {kNormal * rigid_.data().stiffness(at) * jump(at, 0), tangential * jump(at, 1), tangential * jump(at, 2)};
}

ContactState LawProjection::state(std::size_t pair, const ContactState& now, const Point& force, const Point& jump) const {
  ContactTrial trial = trialOf(pair);
  trial.force = force;
  trial.jump = jump;
  ContactState next = laws_.of(rigid_.data().line[pair]).project(trial, now);
  const double first = force[1] + jump[1], second = force[2] + jump[2];
  if (restrictsSliding(pair) && isFrozen()) next = frozen(next, normal_(static_cast<Eigen::Index>(pair)), first, second);
  if (next.status == PairStatus::Slip && rigid_.data().tangents.size() == 2 && next.direction != Point{0, 0, 0}) {
    const double bound = next.largest(force[0] + jump[0]), beyond = std::hypot(first, second) - bound;
    next.transverseStiffness = tangential_ * sites_[pair].tangential * (beyond * kLawAcross > bound ? bound / beyond : kLawAcross);
  }
  return next;
}

PairStates LawProjection::refrozen(PairStates states) const {
  for (std::size_t i = 0; i < states.size(); ++i) {
    ContactState& own = states[i];
    if (!own.closed() || !restrictsSliding(i)) continue;
    const double normal = normal_(static_cast<Eigen::Index>(i));
    Point pushed{0, 0, 0};
    for (int k = 1; k <= 2; ++k) pushed[k] = kLawPushed * own.direction[k];
    const ContactState bounds = state(i, own, {normal, 0.0, 0.0}, pushed);
    own.bound = bounds.bound;
    own.friction = bounds.friction;
  }
  return states;
}

PairStates LawProjection::states(const PairStates& now, const Matrix& force, const Matrix& jump) const {
  PairStates next = now;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (rigid_.data().canChange[i]) next[i] = state(i, now[i], {force(at, 0), force(at, 1), force(at, 2)}, stiff(i, jump));
  }
  return next;
}

PairStates LawProjection::atSolution(const PairStates& now, const ContactAnswer& answer) const {
  PairStates all = now;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (!rigid_.data().canChange[i]) continue;
    const auto at = static_cast<Eigen::Index>(i);
    const double tolerance = answer.forceTolerance(at);
    Point force{0, 0, 0}, jump = stiff(i, answer.jump);
    // The tolerance favours the current state of the pair.
    jump[0] = 0.0;
    if (now[i].closed())
      force[0] = answer.force(at, 0) + tolerance;
    else
      jump[0] = (answer.jump(at, 0) - answer.jumpTolerance(at)) * rigid_.data().stiffness(at);
    for (int k = 1; k <= 2; ++k) force[k] = answer.force(at, k);
    if (now[i].status == PairStatus::Stick) {
      const double size = std::hypot(force[1], force[2]), less = size > 0.0 ? std::max(0.0, 1.0 - tolerance / size) : 0.0;
      for (int k = 1; k <= 2; ++k) force[k] *= less, jump[k] = 0.0;
    } else if (now[i].status == PairStatus::Slip) {
      for (int k = 1; k <= 2; ++k) force[k] += (1.0 + now[i].friction) * tolerance * now[i].direction[k];  // beyond the bound at force[0]
    }
    // A pair that sticks or has no tangential stiffness moves only by prescribed displacements, whatever its force: it slides along them.
    const double slip = std::hypot(answer.jump(at, 1), answer.jump(at, 2));
    if ((now[i].status == PairStatus::Stick || !(sites_[i].tangential > 0.0)) && slip > answer.jumpTolerance(at))
      for (int k = 1; k <= 2; ++k) jump[k] = kLawPushed * answer.jump(at, k) / slip;
    ContactState next = state(i, now[i], force, jump);
    // Slip reverses through stick: pairs that skip stick cycle if little except friction holds a body.
    if (now[i].status == PairStatus::Slip && next.status == PairStatus::Slip &&
        now[i].direction[1] * next.direction[1] + now[i].direction[2] * next.direction[2] < 0.0) {
      next.status = PairStatus::Stick;
      next.direction = {0, 0, 0};
      next.transverseStiffness = 0.0;
    }
    all[i] = next;
  }
  return all;
}

double LawProjection::distance(const PairStates& now, const Matrix& force, const Matrix& jump) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (!rigid_.data().canChange[i]) continue;
    const auto at = static_cast<Eigen::Index>(i);
    const Point own{force(at, 0), force(at, 1), force(at, 2)}, more = stiff(i, jump);
    const ContactState next = state(i, now[i], own, more);
    const double normal = own[0] + more[0];
    Point allowed{0, 0, 0};
    if (next.closed()) allowed[0] = normal;
    for (int k = 1; k <= 2; ++k)
      if (next.status == PairStatus::Stick)
        allowed[k] = own[k] + more[k];
      else if (next.status == PairStatus::Slip)
        allowed[k] = next.largest(normal) * next.direction[k];
    sum += (own[0] - allowed[0]) * (own[0] - allowed[0]) / rigid_.data().stiffness(at);
    if (!(sites_[i].tangential > 0.0)) continue;
    for (int k = 1; k <= 2; ++k) sum += (own[k] - allowed[k]) * (own[k] - allowed[k]) / sites_[i].tangential;
  }
  return sum;
}

double LawProjection::turn(std::size_t pair, const ContactState& next, const ContactAnswer& answer) const {
  const auto at = static_cast<Eigen::Index>(pair);
  if (next.status != PairStatus::Slip || !(answer.forceTolerance(at) > 0.0)) return 0.0;
  const double bound = next.largest(answer.force(at, 0));
  return std::hypot(answer.force(at, 1) - bound * next.direction[1], answer.force(at, 2) - bound * next.direction[2]) /
         answer.forceTolerance(at);
}

FrictionCone LawProjection::cone(std::size_t pair) const {
  FrictionCone cone;
  if (!rigid_.data().canChange[pair] || !restrictsSliding(pair) || rigid_.data().tangents.empty()) return cone;
  const int directions = rigid_.data().tangents.size() == 2 ? kDirections : 2;
  for (int k = 0; k < directions; ++k) {
    const double angle = 2.0 * M_PI * k / directions;
    ContactTrial trial = trialOf(pair);
    trial.force[0] = 1.0;
    trial.jump = {0.0, kLawPushed * std::cos(angle), directions > 2 ? kLawPushed * std::sin(angle) : 0.0};
    const ContactState state = laws_.of(rigid_.data().line[pair]).project(trial, PairStatus::Slip);
    if (state.status != PairStatus::Slip) {
      cone.bound = std::numeric_limits<double>::infinity();  // it may hold any force
      return cone;
    }
    const double bound = isFrozen() ? state.largest(normal_(static_cast<Eigen::Index>(pair))) : state.bound;
    cone.bound = std::max(cone.bound, bound);
    if (!isFrozen()) cone.friction = std::max(cone.friction, state.friction);
  }
  return cone;
}

}  // namespace suture
