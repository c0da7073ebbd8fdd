#include <suture/simulation/moving/Relaxation.hpp>

#include <algorithm>

namespace suture {

namespace {

// Quick: to a tenth in a step. After a single slow step, as where loads change besides, the next one is often quick again: steps are
// shorter only from the second slow one on. Not critical: .3 instead of .1, and a shortest step of .4 instead of .2, change the iterations
// of 14 scenes by less than .3 %; to begin with the first slow step takes 2 % more.
constexpr double kQuick = 0.1;
constexpr int kSlow = 2;
constexpr double kShortest = 0.2;

}  // namespace

double Relaxation::factorAfter(const Vector& change) {
  const bool isSlow = last_.size() == change.size() && change.norm() > kQuick * last_.norm();
  slow_ = isSlow ? slow_ + 1 : 0;
  if (slow_ < kSlow) {
    factor_ = 1.0;
  } else {
    const Vector turn = change - last_;
    const double square = turn.squaredNorm();
    factor_ = square > 0.0 ? std::clamp(-factor_ * last_.dot(turn) / square, kShortest, 1.0) : 1.0;
  }
  last_ = change;
  return factor_;
}

}  // namespace suture
