#include <suture/solver/ActiveSet.hpp>
#include <suture/solver/FrictionMethod.hpp>
#include <suture/solver/SemismoothNewton.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>

namespace suture {

Schema SemismoothNewton::schema() {
  Schema schema("Newton's method on the condensed contact problem.");
  schema.real(
      "Inner Tolerance", 1e-2,
      "Tolerance of linear solves until the set of closed pairs no longer changes, relative to the energy norm of the solution; for "
      "the auxiliary problem, relative to its right-hand side.",
      {0.0, 1.0, true, true, {}});
  return schema;
}

SemismoothNewton::SemismoothNewton(const Parameters& own) : innerTolerance_(own.get<double>("Inner Tolerance")) {}

double SemismoothNewton::auxiliaryTolerance(const OuterSettings& settings) const { return std::max(innerTolerance_, settings.tolerance); }

void SemismoothNewton::doSolve(Run& run) const {
  if (run.problem.friction())
    searchFriction(run, innerTolerance_);
  else
    ActiveSet::search(run, innerTolerance_);
}

}  // namespace suture
