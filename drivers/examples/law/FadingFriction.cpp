// A user-defined contact law: a coefficient of friction that decreases with pressure. The search for states, the linear solves, the
// monolithic reference, the verdict and the plots use it.
#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <suture/base/Point.hpp>
#include <suture/pairs/ContactLaw.hpp>

namespace {

using namespace suture;

/// Tangential stress at most mu0 p / (1 + p / p0): Coulomb's law for low pressures, mu0 p0 for high ones.
class FadingFriction : public ContactLaw {
 public:
  static Schema schema() {
    return Schema("Coulomb's law with a coefficient that decreases with pressure: mu0 / (1 + p / p0).")
        .real("Coefficient", 0.3, "mu0, coefficient of friction at zero pressure.", Range::atLeast(0.0))
        .real("Pressure", std::nullopt, "p0, pressure at which the coefficient is halved. [stress]", Range::positive());
  }

  explicit FadingFriction(const Parameters& own) : mu_(own.get<double>("Coefficient")), half_(own.get<double>("Pressure")) {}

 protected:
  bool doRestrictsSliding() const override { return true; }

  /// Projects the trial force z = force + jump.
  ContactState doProject(const ContactTrial& trial, const ContactState& now) const override {
    const Point z = plus(trial.force, trial.jump);
    if (z[0] < 0.0 || (z[0] == 0.0 && !now.closed())) return PairStatus::Open;
    if (trial.normalOnly) return PairStatus::Stick;
    // Replace the bound t(f) = mu0 f / (1 + f / f0) by its tangent at the normal force z: t(z) + t'(z) (f - z), t' = mu0 / (1 + z / f0)^2.
    const double full = half_ * trial.size, more = 1.0 + z[0] / full;
    ContactState state(PairStatus::Stick);
    state.friction = mu_ / (more * more);
    state.bound = mu_ * z[0] / more - state.friction * z[0];
    const double size = std::hypot(z[1], z[2]);
    if (size < state.largest(z[0]) || size == 0.0) return state;
    state.status = PairStatus::Slip;
    state.direction = {0.0, z[1] / size, z[2] / size};
    return state;
  }

 private:
  double mu_, half_;
};

const Registration<ContactLaw> registration("Fading Friction", FadingFriction::schema(),
                                            [](const Constants&, const Parameters& own) { return std::make_unique<FadingFriction>(own); });

}  // namespace
