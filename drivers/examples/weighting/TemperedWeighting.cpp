// A weighting of one's own: the example of a plugin. It lies between two that Suture has: exponent 0 is Multiplicity, 1 is Stiffness
// Diagonal.
#include <Teuchos_ParameterList.hpp>
#include <suture/precond/Weighting.hpp>

namespace {

using namespace suture;

/// rho_i = (diagonal of K_i)^exponent at each unknown of the interface.
class TemperedWeighting : public DiagonalWeighting {
 public:
  // One description: the reader checks scenes against it, suture_schema --plugin prints it.
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

// This line makes the name known, when the library is loaded.
const Registration<Weighting> registration("Tempered Stiffness", TemperedWeighting::schema(), [](const Parameters& own) {
  return std::make_unique<TemperedWeighting>(own.get<double>("Exponent"));
});

}  // namespace
