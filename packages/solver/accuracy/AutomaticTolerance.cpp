#include <suture/solver/accuracy/AutomaticTolerance.hpp>

#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {
constexpr double kClean = 0.5;  // algebraic error, relative to the estimate, up to which the estimate is reliable
}

double AutomaticTolerance::target() const {
  if (last_) return share_ * last_->energyNorm;
  return share_ * (estimate_.predicted > 0.0 ? estimate_.predicted : estimate_.expected * scale_);
}

double AutomaticTolerance::tolerance() const {
  const double relative = scale_ > 0.0 ? target() / scale_ : share_ * estimate_.expected;
  return std::clamp(std::sqrt(std::min(lowest_, 1.0)) * relative, kTightest, kLoosest);
}

void AutomaticTolerance::estimate(const InterfaceState& state, double error) {
  recovered_ = std::make_shared<const InterfaceProblem::Recovered>(problem_.recover(state));
  last_ = estimate_.of(recovered_->freeValues);
  sure_ = error <= kClean * last_->energyNorm;
  ++estimates_;
}

EnergyCriterion AutomaticTolerance::criterion(const InterfaceState& from, double lowest, bool first, bool last) {
  if (!on()) return {nullptr, lowest};
  recovered_.reset();
  const auto enough = [this, from, first, last](double start, double error, const MultiVector& x) {
    if (first) startsFrom(start);
    recovered_.reset();
    if (!last || !within(error) || sure_) return within(error);
    InterfaceState state = from;
    state.trace = Teuchos::rcp(new MultiVector(*from.trace, Teuchos::Copy));
    problem_.update(state, x, 1.0);
    estimate(state, error);
    return met(error);
  };
  return {enough, lowest};
}

}  // namespace suture
