#include <suture/search/DualAscent.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kRises = 1e-14;     // least relative increase of the energy
constexpr double kSameTime = 1e-12;  // relative difference of step lengths at which pairs open together

bool any(const ClosedSet& set) {
  return std::any_of(set.begin(), set.end(), [](char c) { return c != 0; });
}

ClosedSet joined(ClosedSet a, const ClosedSet& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = a[i] || b[i];
  return a;
}

}  // namespace

ClosedSet DualAscent::penetrating(const State& at) const {
  ClosedSet set(at.closed.size(), 0);
  for (std::size_t i = 0; i < set.size(); ++i) {
    const auto pair = static_cast<Eigen::Index>(i);
    set[i] = !at.closed[i] && rigid_.data().canChange[i] && at.penetration(pair) > at.tolerance(pair);
  }
  return set;
}

/// Penetrating pair on which most dual energy can be gained alone; -1: none.
int DualAscent::worst(const State& at) const {
  const ClosedSet set = penetrating(at);
  int worst = -1;
  double most = 0.0;
  for (int i = 0; i < rigid_.pairs(); ++i) {
    if (!set[static_cast<std::size_t>(i)]) continue;
    const double gain = at.penetration(i) * at.penetration(i) / rigid_.compliance()(i);
    if (gain > most) most = gain, worst = i;
  }
  return worst;
}

/// From forces >= 0 on `support` to the solution of a set within support and entering pairs.
DualAscent::End DualAscent::climb(ClosedSet support, ClosedSet entering, Vector force, State& to) {
  const auto n = static_cast<Eigen::Index>(force.size());
  for (bool moved = false;;) {
    const ClosedSet all = joined(support, entering);
    const ContactAnswer* answer = solve_(all);
    if (!answer) return End::Stopped;
    const Vector found = answer->force.col(0);
    ClosedSet blocking(all.size(), 0), idle = blocking;
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto pair = static_cast<std::size_t>(i);
      blocking[pair] = all[pair] && rigid_.data().canChange[pair] && found(i) < -answer->forceTolerance(i);
      idle[pair] = blocking[pair] && !(force(i) > 0.0);
    }
    if (!any(blocking)) {
      to.force = found.cwiseMax(0.0);
      to.penetration = answer->jump.col(0);
      to.tolerance = answer->jumpTolerance;
      to.closed = all;
      to.energy = answer->energy;
      return End::Risen;
    }
    if (any(idle)) {
      for (std::size_t i = 0; i < all.size(); ++i)
        if (idle[i]) entering[i] = support[i] = 0;
      if (!moved && !any(entering)) return End::Idle;
      continue;
    }
    double length = 1.0;
    for (Eigen::Index i = 0; i < n; ++i)
      if (blocking[static_cast<std::size_t>(i)]) length = std::min(length, force(i) / (force(i) - found(i)));
    support = all;
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto pair = static_cast<std::size_t>(i);
      const bool opens = blocking[pair] && force(i) / (force(i) - found(i)) <= length * (1.0 + kSameTime);
      force(i) = opens ? 0.0 : std::max(force(i) + length * (found(i) - force(i)), 0.0);
      if (opens) support[pair] = 0;
    }
    entering.assign(all.size(), 0);
    moved = true;
  }
}

bool DualAscent::run(const Vector& force) {
  ClosedSet support(static_cast<std::size_t>(force.size()), 0);
  for (std::size_t i = 0; i < support.size(); ++i) support[i] = force(static_cast<Eigen::Index>(i)) > 0.0;
  State at;
  if (climb(support, ClosedSet(support.size(), 0), force, at) != End::Risen) return false;
  while (true) {
    const ClosedSet entering = penetrating(at);
    if (!any(entering)) return true;
    for (std::size_t i = 0; i < support.size(); ++i) support[i] = at.closed[i] && at.force(static_cast<Eigen::Index>(i)) > 0.0;
    State next;
    End end = climb(support, entering, at.force, next);
    if (end == End::Idle) {
      ClosedSet one(support.size(), 0);
      one[static_cast<std::size_t>(worst(at))] = 1;
      end = climb(support, one, at.force, next);
    }
    if (end == End::Stopped) return false;
    // The energy cannot increase any more: the state is the solution to numerical accuracy, subject to verification.
    if (end == End::Idle || !(next.energy > at.energy + kRises * std::abs(at.energy))) return solve_(at.closed) != nullptr;
    at = std::move(next);
  }
}

}  // namespace suture
