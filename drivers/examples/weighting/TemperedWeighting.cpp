// A user-defined weighting, as an example of a plugin. It interpolates between two weightings of Suture: exponent 0 is Multiplicity, 1 is
// Stiffness Diagonal.
#include <Teuchos_ParameterList.hpp>
#include <suture/precond/Weighting.hpp>

namespace {

using namespace suture;

/// rho_i = (diagonal of K_i)^exponent at each unknown of the interface.
class TemperedWeighting : public DiagonalWeighting {
 public:
  // The schema is used by the reader to check scenes, and printed by suture_schema --plugin.
  static Schema schema() {
    return Schema("Power of the stiffness diagonal: between Multiplicity (0) and Stiffness Diagonal (1).")
        .real("Exponent", 0.5, "Power of the stiffness.", Range{0.0, 1.0, false, false, {}});
  }

  explicit TemperedWeighting(double exponent) : exponent_(exponent) {}

 protected:
  Vector density(const LocalProblem& local) const override { return local.stiffnessDiagonal().array().pow(exponent_); }

 private:
  double exponent_;
};

// Registers the name when the library is loaded.
const Registration<Weighting> registration("Tempered Stiffness", TemperedWeighting::schema(), [](const Parameters& own) {
  return std::make_unique<TemperedWeighting>(own.get<double>("Exponent"));
});

}  // namespace
