#include <suture/base/Errors.hpp>
#include <suture/contact/ContactSearch.hpp>
#include <suture/contact/HalfPlaneModel.hpp>
#include <suture/contact/LearntModel.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr int kPlainSolves = 12;     // solves at one accuracy before other sets than plain flips are tried
constexpr int kModelSolves = 3;      // solves whose next set comes from half-planes; later sets differ by single pairs, as do plain flips
constexpr int kPatience = 25;        // solves without a better state before a safe step
constexpr double kIdle = 1e-10;      // relative to the largest force on the less loaded body: pairs with smaller forces only touch
constexpr double kProgress = 1e-13;  // relative difference of energies that counts as zero
constexpr std::size_t kMemory = 30;  // solves used by the learnt model
constexpr double kFarther = 2.0;     // ratio of the distance from the laws to that of the closest state above which a line search is tried
constexpr int kSetHalvings = 12;     // halvings of a step on that line

}  // namespace

ClosedSet ContactSearch::joined(ClosedSet a, const ClosedSet& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = a[i] || b[i];
  return a;
}

void ContactSearch::remember(const Vector& force, const Vector& penetration) {
  history_.emplace_back(force, penetration);
  if (history_.size() > kMemory) history_.erase(history_.begin());
}

ContactSearch::ContactSearch(const RigidContact& rigid, ContactOracle& oracle, int most) : rigid_(rigid), oracle_(oracle), left_(most) {}

/// Solves for a set and its holders. Holders on which the loads press become part of the set. Motions that remain free are then chosen for
/// the least penetration of open pairs.
bool ContactSearch::solve(const ClosedSet& closed) {
  if (left_-- <= 0 || !oracle_.goesOn()) {
    stopped_ = true;
    return false;
  }
  ++solves_;
  ++plain_;
  set_ = closed;
  holding_.assign(closed.size(), 0);
  Matrix loose = rigid_.loose(set_);
  for (bool supported = true; supported;) {
    supported = false;
    const std::vector<int> holders = rigid_.holders(set_, loose);
    const Vector force = rigid_.holderForces(holders, loose);
    driven_ = force.size() > 0 && force.minCoeff() < 0.0;
    for (std::size_t k = 0; k < holders.size(); ++k) {
      supported = supported || force(static_cast<Eigen::Index>(k)) > 0.0;
      (force(static_cast<Eigen::Index>(k)) > 0.0 ? set_ : holding_)[holders[k]] = 1;
    }
    if (!supported) break;
    holding_.assign(closed.size(), 0);
    loose = rigid_.loose(set_);
  }
  answer_ = oracle_.solve(joined(set_, holding_), level_);
  if (!answer_.solved) {
    failed_ = true;
    return false;
  }
  for (std::size_t i = 0; i < closed.size(); ++i)
    if (holding_[i]) answer_.force(static_cast<Eigen::Index>(i)) = 0.0;
  if (loose.cols() > 0) {
    const Vector motion = loose * rigid_.settle(set_, answer_.penetration, loose);
    if (!motion.isZero(0.0)) {
      const Vector moved = rigid_.data().rows * motion;
      for (std::size_t i = 0; i < set_.size(); ++i)
        if (!set_[i]) answer_.penetration(static_cast<Eigen::Index>(i)) += moved(static_cast<Eigen::Index>(i));
      oracle_.move(motion);
    }
  }
  return true;
}

bool ContactSearch::pulls() const {
  for (std::size_t i = 0; i < set_.size(); ++i)
    if (set_[i] && answer_.force(static_cast<Eigen::Index>(i)) < -answer_.forceTolerance(static_cast<Eigen::Index>(i))) return true;
  return false;
}

bool ContactSearch::penetrates(const Vector& penetration, const Vector& tolerance, const ClosedSet& closed) const {
  for (std::size_t i = 0; i < closed.size(); ++i)
    if (!closed[i] && rigid_.data().canChange[i] && penetration(static_cast<Eigen::Index>(i)) > tolerance(static_cast<Eigen::Index>(i)))
      return true;
  return false;
}

ClosedSet ContactSearch::flipped() const {
  ClosedSet next = set_;
  for (std::size_t i = 0; i < next.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (!rigid_.data().canChange[i]) continue;
    if (set_[i] ? answer_.force(at) < -answer_.forceTolerance(at) : answer_.penetration(at) > answer_.penetrationTolerance(at))
      next[i] = !set_[i];
  }
  return next;
}

/// Pad penetrations for given forces.
Vector ContactSearch::padPenetration(const Vector& force, const Vector& penetration) const {
  return rigid_.compliance().cwiseProduct(force) + penetration;
}

ClosedSet ContactSearch::guarded(ClosedSet set) const { return guarded(std::move(set), answer_.force, answer_.penetration); }

/// Replaces a set that would leave a body unconstrained by that of the equilibrium on pads.
ClosedSet ContactSearch::guarded(ClosedSet set, const Vector& force, const Vector& penetration) const {
  if (rigid_.motions() == 0 || !rigid_.loosens(set)) return set;
  const RigidContact::Equilibrium pads = rigid_.project(padPenetration(force, penetration));
  if (!pads.found) return joined(set, set_);
  for (std::size_t i = 0; i < set.size(); ++i) set[i] = pads.force(static_cast<Eigen::Index>(i)) > 0.0;
  return set;
}

bool ContactSearch::proposed(const ClosedSet& set) const { return std::find(seen_.begin(), seen_.end(), set) != seen_.end(); }

/// Removes pairs without force from the closed set, because they would fix the bodies' positions incorrectly.
void ContactSearch::dropIdle() {
  answer_.force = answer_.force.cwiseMax(0.0);
  const Vector scale = rigid_.bodyScale(set_, answer_.force);
  ClosedSet carrying = set_;
  for (std::size_t i = 0; i < set_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    carrying[i] = set_[i] && answer_.force(at) > kIdle * scale(at) && answer_.force(at) > answer_.forceTolerance(at);
    if (!carrying[i]) answer_.force(at) = 0.0;
  }
  if (carrying == set_ || rigid_.motions() == 0) return;
  const Matrix loose = rigid_.loose(carrying);
  set_ = carrying;
  if (loose.cols() == 0) return;
  const Vector motion = loose * rigid_.settle(set_, answer_.penetration, loose);
  if (motion.isZero(0.0)) return;
  const Vector moved = rigid_.data().rows * motion;
  for (std::size_t i = 0; i < set_.size(); ++i)
    if (!set_[i]) answer_.penetration(static_cast<Eigen::Index>(i)) += moved(static_cast<Eigen::Index>(i));
  oracle_.move(motion);
}

/// After a solve at the final accuracy: true at the solution. Stores the state if it is the best so far.
bool ContactSearch::done() {
  remember(answer_.force, answer_.penetration);
  if (driven_ || pulls()) {
    ++sinceBest_;
    return false;
  }
  if (!penetrates(answer_.penetration, answer_.penetrationTolerance, set_)) return true;
  dropIdle();
  history_.back() = {answer_.force, answer_.penetration};
  if (!penetrates(answer_.penetration, answer_.penetrationTolerance, set_)) return true;
  if (!haveBest_ || answer_.energy > best_.energy + kProgress * std::abs(best_.energy)) {
    best_ = {answer_.force, answer_.penetration, answer_.penetrationTolerance, set_, answer_.energy};
    haveBest_ = true;
    sinceBest_ = 0;
  } else {
    ++sinceBest_;
  }
  return false;
}

/// Distance of forces and penetrations from the laws: sum c (l - (l + w / c)_+)^2.
double ContactSearch::distance(const Vector& force, const Vector& penetration) const {
  const Vector& c = rigid_.compliance();
  double sum = 0.0;
  for (Eigen::Index i = 0; i < force.size(); ++i) {
    if (!rigid_.data().canChange[static_cast<std::size_t>(i)]) continue;
    const double apart = force(i) - std::max(force(i) + penetration(i) / c(i), 0.0);
    sum += c(i) * apart * apart;
  }
  return sum;
}

/// If the solution is much farther from the laws than the closest state: the set of the best combination of the two, if it is new.
bool ContactSearch::searchLine(ClosedSet& next) {
  if (!learns_ || driven_) return false;
  const double own = distance(answer_.force, answer_.penetration);
  if (level_ == oracle_.levels() - 1 && own < nearestAnswer_.distance) nearestAnswer_ = {answer_.force, answer_.penetration, own};
  if (own < nearest_.distance) {
    nearest_ = {answer_.force, answer_.penetration, own};
    return false;
  }
  if (own < kFarther * nearest_.distance) return false;
  const Vector force = answer_.force - nearest_.force, penetration = answer_.penetration - nearest_.penetration;
  double part = 1.0;
  Balance best = nearest_;
  for (int halving = 0; halving < kSetHalvings; ++halving) {
    part *= 0.5;
    Balance at{nearest_.force + part * force, nearest_.penetration + part * penetration};
    at.distance = distance(at.force, at.penetration);
    if (at.distance < best.distance) best = std::move(at);
  }
  if (!(best.distance < nearest_.distance)) return false;
  nearest_ = std::move(best);
  const Vector t = padPenetration(nearest_.force, nearest_.penetration);
  next = set_;
  for (std::size_t i = 0; i < next.size(); ++i)
    if (rigid_.data().canChange[i]) next[i] = t(static_cast<Eigen::Index>(i)) > 0.0;
  next = guarded(next, nearest_.force, nearest_.penetration);
  return !proposed(next);
}

/// A new set that needs no safe step; false if there is none.
bool ContactSearch::propose(ClosedSet& next) {
  if (searchLine(next)) return true;
  if (plain_ <= kPlainSolves) {
    if (const ClosedSet own = oracle_.proposal(); !own.empty()) {
      next = guarded(own);
      if (!proposed(next)) return true;
    }
    const ClosedSet plain = flipped();
    if (learns_ && solves_ <= kModelSolves) {
      next = guarded(HalfPlaneModel(rigid_).closedSet(set_, plain, answer_.force, answer_.penetration));
      if (!proposed(next)) return true;
    }
    next = guarded(plain);
    if (!proposed(next)) return true;
  }
  if (sinceBest_ >= kPatience || level_ < oracle_.levels() - 1) return false;
  if (learns_ && solves_ % 2 == 0 && LearntModel::fits(rigid_.pairs()) && !history_.empty()) {
    next = LearntModel(rigid_, history_).closedSet();
    if (!next.empty() && !proposed(next)) return true;
  }
  next = guarded(flipped());
  return !proposed(next);
}

/// Holders have moved bodies until their gaps close. Moves the bodies back, along motions that change no force, to the least motion.
void ContactSearch::moveLeast(const ClosedSet& carrying) {
  const Vector motion = oracle_.motion();
  if (motion.size() != rigid_.motions() || motion.size() == 0) return;
  const Vector further = rigid_.leastMotion(carrying, motion, answer_.penetration) - motion;
  if (further.isZero(0.0)) return;
  const Vector moved = rigid_.data().rows * further;
  for (std::size_t i = 0; i < carrying.size(); ++i)
    if (!carrying[i]) answer_.penetration(static_cast<Eigen::Index>(i)) += moved(static_cast<Eigen::Index>(i));
  oracle_.move(further);
}

ContactSearch::Result ContactSearch::finish(bool converged, std::string failure) {
  Result result;
  result.converged = converged;
  result.failure = std::move(failure);
  result.closed = set_;
  result.force = answer_.force.size() == rigid_.pairs() ? Vector(answer_.force.cwiseMax(0.0)) : Vector::Zero(rigid_.pairs());
  result.solves = solves_;
  if (converged) {
    ClosedSet carrying = set_;
    const Vector scale = rigid_.bodyScale(set_, result.force);
    ClosedSet touching(set_.size(), 0);
    for (std::size_t i = 0; i < set_.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      carrying[i] = set_[i] && result.force(at) > kIdle * scale(at) && result.force(at) > answer_.forceTolerance(at);
    }
    moveLeast(carrying);
    for (std::size_t i = 0; i < set_.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      touching[i] = rigid_.data().canChange[i] && !carrying[i] && (set_[i] || answer_.penetration(at) >= -answer_.penetrationTolerance(at));
    }
    result.neutral = rigid_.neutral(carrying, touching);
  } else if (seen_.size() > 1) {
    for (int i = 0; i < rigid_.pairs(); ++i)
      if (seen_[seen_.size() - 1][i] != seen_[seen_.size() - 2][i]) result.alternating.push_back(i);
  }
  return result;
}

ContactSearch::Result ContactSearch::run(ClosedSet start) {
  ClosedSet next = std::move(start);
  set_ = next;
  const int last = oracle_.levels() - 1;
  while (true) {
    if (!solve(next)) return finish(false, stopped_ ? "" : "a linear solve failed");
    if (level_ < last) {
      if (!pulls() && !penetrates(answer_.penetration, answer_.penetrationTolerance, set_)) {
        ++level_;  // the same set, more accurately
        ++left_;
        next = set_;
        continue;
      }
      seen_.push_back(set_);
      if (propose(next)) continue;
      level_ = last;  // sets recur: only accurate forces can decide
      seen_.clear();
      plain_ = 0;
      next = set_;
      continue;
    }
    if (done()) return finish(true, "");
    seen_.push_back(set_);
    if (propose(next)) {
      // If a final solve changes the set by a pair or two, more such changes may follow, for which a looser accuracy is sufficient. Done
      // once, so that the search terminates.
      if (last > 0 && !loosened_ && solves_ <= kPlainSolves) {
        loosened_ = true;
        level_ = last - 1;
        seen_.clear();
      }
      continue;
    }
    if (!safeStep(next)) {
      if (stopped_ || failed_) return finish(false, stopped_ ? "" : "a linear solve failed");
      // The energy cannot rise any more: the best state is the solution to numerical accuracy, subject to verification.
      if (haveBest_ && solve(best_.closed)) return finish(true, "");
      return finish(false, "found no set of closed pairs that balances the loads without tensile forces");
    }
  }
}

}  // namespace suture
