#include <suture/solver/AutomaticTolerance.hpp>

#include <Tpetra_MultiVector.hpp>

namespace suture {

namespace {
constexpr double kFirstEstimate = 0.02;  // where the first is made: algebraic error relative to that of the start
constexpr double kClean = 0.3;           // algebraic error, relative to the estimate, that does not spoil it
}  // namespace

void AutomaticTolerance::estimate(const InterfaceState& state) {
  last_ = estimate_(problem_.interiors(state));
  ++estimates_;
}

EnergyCriterion AutomaticTolerance::criterion(const InterfaceState& from, double lowest, bool last) {
  if (!on()) return {nullptr, lowest};
  const auto estimateAt = [this, from](const MultiVector& x) {
    InterfaceState state = from;
    state.trace = Teuchos::rcp(new MultiVector(*from.trace, Teuchos::Copy));
    problem_.update(state, x, 1.0);
    estimate(state);
  };
  const auto enough = [this, estimateAt, last, first = -1.0, clean = false](double error, const MultiVector& x) mutable {
    if (first < 0.0) first = error;
    if (!known()) {
      if (error > kFirstEstimate * first) return false;
      estimateAt(x);
      clean = error <= kClean * last_->energyNorm;
    }
    if (met(error) && last && !clean) {
      estimateAt(x);
      clean = error <= kClean * last_->energyNorm;
    }
    return met(error);
  };
  return {enough, lowest};
}

}  // namespace suture
