#include <suture/simulation/moving/Settling.hpp>

#include <algorithm>

namespace suture {

namespace {

constexpr double kRoundOff = 1e-13;  // change relative to the extent of the scene, for bodies without strain
// Part of the expected change of a round that its solution may miss, and the largest tolerance, with which pair states are still found.
constexpr double kMissedPart = 0.01;
constexpr double kLoosestRound = 1e-3;
// Expected ratio of the changes of two rounds, as for small strains. Shapes that nearly conform contract less; the tolerance is then smaller
// than necessary.
constexpr double kContraction = 0.01;

}  // namespace

double Settling::scale(double beside) const { return beside + kRoundOff / kSettled * extent_; }

void Settling::add(double change, double beside, bool sameStates) {
  // Rounds contract at least linearly: what the next one would change follows from the last two.
  const double next = last_ > 0.0 ? change * std::min(1.0, change / last_) : change;
  last_ = change;
  isSettled_ = sameStates && next <= kSettled * scale(beside);
  next_ = std::min(next, kContraction * change) / scale(beside);
}

double Settling::tolerance() const { return std::min(kLoosestRound, kMissedPart * next_); }

}  // namespace suture
