// ContactSearch: fallback if plain flips and models do not converge, by steps along which the dual energy increases strictly.
#include <suture/contact/ContactSearch.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kNoForce = 1e-13;  // static forces at the level of round-off

bool any(const ClosedSet& set) {
  return std::any_of(set.begin(), set.end(), [](char c) { return c != 0; });
}

}  // namespace

/// Starts from forces that hold the bodies by statics alone: always a state with l >= 0.
bool ContactSearch::staticStart() {
  const Vector force = rigid_.staticForces();
  if (force.size() != rigid_.pairs()) return false;
  ClosedSet carrying(rigid_.pairs(), 0);
  const Vector scale = rigid_.clusterScale(ClosedSet(carrying.size(), 1), force);
  for (std::size_t i = 0; i < carrying.size(); ++i)
    carrying[i] = force(static_cast<Eigen::Index>(i)) > kNoForce * scale(static_cast<Eigen::Index>(i));
  if (!solve(carrying)) return false;
  dropIdle();
  best_ = {answer_.force, answer_.penetration, answer_.penetrationTolerance, set_, answer_.energy};
  return haveBest_ = true;
}

/// Starts from the equilibrium on pads near the closest accurate solution: admissible forces that keep the progress of the search.
bool ContactSearch::nearestStart() {
  if (nearestAnswer_.force.size() != rigid_.pairs()) return false;
  const RigidContact::Equilibrium pads = rigid_.project(padPenetration(nearestAnswer_.force, nearestAnswer_.penetration));
  if (!pads.found) return false;
  State from;
  from.force = pads.force;
  from.penetration = from.penetrationTolerance = Vector::Zero(rigid_.pairs());
  from.closed.assign(rigid_.pairs(), 0);
  for (int i = 0; i < rigid_.pairs(); ++i) from.closed[i] = pads.force(i) > 0.0;
  return haveBest_ = descend(from, false, best_);
}

/// From a face minimiser with l >= 0 to a better one. One solve per loop.
/// \param pushFirst  starts with forces w / c on the penetrating pairs instead of closing them
bool ContactSearch::descend(const State& from, bool pushFirst, State& to) {
  const int n = rigid_.pairs();
  ClosedSet penetrating(n, 0), support(n, 0);
  for (int i = 0; i < n; ++i) {
    penetrating[i] = !from.closed[i] && rigid_.data().canChange[i] && from.penetration(i) > from.penetrationTolerance(i);
    support[i] = from.closed[i] && from.force(i) > 0.0;
  }
  ClosedSet entering = penetrating;
  Vector force = from.force;
  bool moved = false;
  while (true) {
    const ClosedSet all = joined(support, entering);
    if (!(pushFirst && !moved)) {
      if (!solve(all)) return false;
      const Vector found = answer_.force;
      ClosedSet blocking(n, 0), idle(n, 0);
      for (int i = 0; i < n; ++i) {
        blocking[i] = all[i] && found(i) < -answer_.forceTolerance(i);
        idle[i] = blocking[i] && force(i) <= 0.0;
      }
      if (!any(blocking)) {
        dropIdle();
        to = {answer_.force, answer_.penetration, answer_.penetrationTolerance, set_, answer_.energy};
        return true;
      }
      if (!any(idle)) {  // stop at the first pair in tension and open it
        double length = 1.0;
        for (int i = 0; i < n; ++i)
          if (blocking[i]) length = std::min(length, force(i) / (force(i) - found(i)));
        support = all;
        for (int i = 0; i < n; ++i) {
          const bool stops = blocking[i] && force(i) / (force(i) - found(i)) <= length * (1.0 + 1e-12);
          force(i) = stops ? 0.0 : std::max(force(i) + length * (found(i) - force(i)), 0.0);
          if (stops) support[i] = 0;
        }
        entering.assign(n, 0);
        moved = true;
        continue;
      }
      if (moved) {
        for (int i = 0; i < n; ++i) support[i] = all[i] && !idle[i];
        entering.assign(n, 0);
        continue;
      }
      ClosedSet rest = entering;
      for (int i = 0; i < n; ++i) rest[i] = entering[i] && !idle[i];
      if (any(rest) && rest != entering) {
        for (int i = 0; i < n; ++i)
          if (idle[i] && !entering[i]) support[i] = 0;
        entering = rest;
        continue;
      }
    }
    if (moved) return false;
    Vector push = Vector::Zero(n);
    for (int i = 0; i < n; ++i)
      if (penetrating[i]) push(i) = from.penetration(i) / rigid_.compliance()(i);
    if (left_-- <= 0 || !oracle_.goesOn()) return false;
    ++solves_;
    ClosedSet held = support;
    for (const int i : rigid_.holders(support, rigid_.loose(support))) held[i] = 1;
    const ContactOracle::Change step = oracle_.redistribute(held, push);
    const Vector& change = step.force;
    if (change.size() != n) return false;
    // Dual energy l.C l / 2 - d.l along the step: slope -w.change, curvature change.C change, the loss of the penetrations.
    const double curvature = -change.dot(step.penetration);
    double length = curvature > 0.0 ? from.penetration.dot(change) / curvature : 1.0;
    for (int i = 0; i < n; ++i)
      if (change(i) < 0.0) length = std::min(length, force(i) / -change(i));
    if (!(length > 0.0) || !std::isfinite(length)) return false;
    force = (force + length * change).cwiseMax(0.0);
    for (int i = 0; i < n; ++i) support[i] = force(i) > 0.0;
    entering.assign(n, 0);
    moved = true;
  }
}

bool ContactSearch::safeStep(ClosedSet& next) {
  level_ = oracle_.levels() - 1;
  if (!haveBest_ && nearestStart()) return takeBest(next);
  if (failed_ || stopped_ || (!haveBest_ && !staticStart())) return false;
  State better;
  const State from = best_;
  const auto rises = [&] { return better.energy > from.energy + 1e-14 * std::abs(from.energy); };
  if (!(descend(from, false, better) && rises()) && (failed_ || stopped_ || !(descend(from, true, better) && rises()))) return false;
  best_ = better;
  return takeBest(next);
}

/// The set that follows the best state.
bool ContactSearch::takeBest(ClosedSet& next) {
  sinceBest_ = 0;
  seen_.assign(1, best_.closed);
  remember(best_.force, best_.penetration);
  if (!penetrates(best_.penetration, best_.penetrationTolerance, best_.closed)) {
    next = best_.closed;
    return true;
  }
  next = guarded(flipped());
  if (proposed(next)) next = joined(best_.closed, next);
  return true;
}

}  // namespace suture
