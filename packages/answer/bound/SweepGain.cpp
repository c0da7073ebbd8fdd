#include <suture/answer/bound/SweepGain.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

namespace suture {

namespace {

// Relative decrease of the squared bound by a sweep that is worth another one: 3 % of the bound. Between 2 and 10 % the bounds of the test
// scenes differ by a few per cent.
constexpr double kWorth = 0.06;
constexpr int kMostSweeps = 30;

}  // namespace

SweepGain::SweepGain(const Comm& comm, double mine, int least) : square_(0.0), least_(least) {
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(square_));
}

bool SweepGain::worthAnotherSweep() const { return sweeps_ < least_ || (sweeps_ < kMostSweeps && last_ > kWorth * square_); }

void SweepGain::add(double decrease) {
  last_ = decrease;
  square_ -= decrease;
  ++sweeps_;
}

}  // namespace suture
