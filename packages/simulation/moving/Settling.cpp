#include <suture/simulation/moving/Settling.hpp>

#include <algorithm>

namespace suture {

namespace {

constexpr double kRoundOff = 1e-13;  // change relative to the extent of the scene, for bodies without strain
// Tolerance of a round as a part of the change that it is expected to make, and the largest one, with which pair states are still found.
// Not critical: with parts of 1e-3, 1e-4 and 1e-5 a block that slides, a roller, a hinge and two gears need 3,773, 3,507 and 3,767
// iterations of conjugate gradients, and 3,507 with a largest tolerance of 1e-2; 4,515 if all rounds are solved to the end.
constexpr double kPartOfChange = 1e-4;
constexpr double kLoosestRound = 1e-3;

}  // namespace

double Settling::scale(double beside) const { return beside + kRoundOff / kSettled * extent_; }

void Settling::add(double change, double beside, bool sameStates) {
  // Rounds contract at least linearly: what the next one would change follows from the last two.
  const double ratio = last_ > 0.0 ? std::min(1.0, change / last_) : 1.0;
  isSettled_ = sameStates && change * ratio <= kSettled * scale(beside);
  if (++rounds_ == 2) contraction_ = ratio;
  next_ = change * (rounds_ == 1 ? contraction_ : ratio) / scale(beside);
  last_ = change;
}

double Settling::tolerance() const {
  const bool isLast = rounds_ > 0 && next_ * contraction_ <= kSettled;
  return isLast ? 0.0 : std::min(kLoosestRound, kPartOfChange * next_);
}

}  // namespace suture
