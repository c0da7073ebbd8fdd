// Tolerance = Automatic against the solution of the same mesh to ten digits.
#include <suture/solver/SolveInterface.hpp>
#include <suture/solver/accuracy/RequestedAccuracy.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <interface/ContactScenes.hpp>
#include <solver/ContactMethods.hpp>
#include <suture/condensed/CondensedProblem.hpp>

namespace suture {
namespace {

using namespace blocks;

double sumOver(double mine) {
  double all = 0.0;
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

// Energy norm of the difference of two states, over all unknowns.
double energyDistance(const Blocks& all, const InterfaceProblem& problem, const InterfaceState& a, const InterfaceState& b) {
  const std::vector<Vector> u = problem.recover(a).freeValues, v = problem.recover(b).freeValues;
  double square = 0.0;
  for (std::size_t s = 0; s < u.size(); ++s) square += (u[s] - v[s]).dot(all.subdomains[s]->stiffness() * (u[s] - v[s]));
  return std::sqrt(sumOver(square));
}

struct Rows : Monitor {
  void outer(const OuterRow& row) override { rows.push_back(row); }
  void note(const std::string& text) override { notes.push_back(text); }
  std::vector<OuterRow> rows;
  std::vector<std::string> notes;
};

struct Runs {
  OuterResult full, automatic;
  Rows rows;
  int estimates = 0;
};

Runs solveBoth(const std::string& method, const Blocks& all, const InterfaceProblem& problem, const std::string& preconditionerName) {
  Runs runs;
  OuterSettings settings;
  settings.preconditioner = preconditioner(preconditionerName);
  settings.maximumIterations = 200;
  const auto solver = [&] {
    Parameters own;
    own.set("Inner Tolerance", method == "Active Set" ? 1e-3 : 1e-2);
    if (method == "Chord") own.set("Anderson Depth", 5);
    if (method == "Successive Approximation") own.set("Relaxation", "Automatic");
    return Registry<OuterSolver>::instance().make(method, own);
  };
  Monitor silent;
  runs.full = solver()->solve(problem, settings, silent);
  const auto estimate = discretisationErrorOf(*world(), all.meshes, all.model, all.subdomains);
  settings.discretisationError = {[&](const std::vector<Vector>& values) {
                                    ++runs.estimates;
                                    return estimate.of(values);
                                  },
                                  estimate.expected};
  runs.automatic = solver()->solve(problem, settings, runs.rows);
  return runs;
}

int pcgOf(const OuterResult& result) { return result.pcgTotal + result.auxiliary.pcg; }

void endsInTime(const std::string& name, const std::string& method, const Blocks& all, const InterfaceProblem& problem,
                const std::string& preconditionerName, bool& success, Teuchos::FancyOStream& out) {
  const Runs runs = solveBoth(method, all, problem, preconditionerName);
  TEST_ASSERT(runs.full.converged && runs.automatic.converged);
  if (!success) {
    out << name << ", " << method << ": " << runs.full.failure << runs.automatic.failure << "\n";
    return;
  }
  const double truth = energyDistance(all, problem, runs.automatic.state, runs.full.state);
  const DiscretisationError error =
      discretisationErrorOf(*world(), all.meshes, all.model, all.subdomains).of(problem.interiors(runs.full.state));
  out << name << ", " << method << ", " << preconditionerName << ": " << pcgOf(runs.automatic) << " of " << pcgOf(runs.full)
      << " PCG, estimated discretisation error " << error.energyNorm << " (" << 100 * error.relative() << " %), algebraic " << truth
      << ", estimated " << runs.automatic.energyError << ", " << runs.estimates << " estimates\n";
  // Errors add in squares: 0.2 of the discretisation error increases the total by 2 %.
  TEST_COMPARE(truth, <, 0.2 * error.energyNorm);
  // All applications of the operator: one of them confirms the residual, as with a given tolerance.
  TEST_COMPARE(pcgOf(runs.automatic), <=, 0.75 * pcgOf(runs.full));
  TEST_COMPARE(runs.automatic.energyError, >=, 0.0);
  TEST_COMPARE(runs.automatic.energyError, <=, 0.1 * error.energyNorm * 1.05);
  TEST_COMPARE(runs.estimates, <=, 3);
  TEST_EQUALITY(runs.rows.notes.empty(), false);
}

TEUCHOS_UNIT_TEST(AutomaticTolerance, EndsALinearSolveAtATenthOfTheDiscretisationError) {
  Scene scene = clampedSquare(4, 8);
  scene.model.loads.push_back({Load::Kind::BodyForce, "", {0.3, -1.0, 0}});
  const OnInterface one(scene, world());
  for (const char* name : {"BDDC", "Neumann-Neumann"}) endsInTime("square", "Active Set", one.all, one.problem, name, success, out);
}

TEUCHOS_UNIT_TEST(AutomaticTolerance, EndsContactOnTheInterface) {
  for (const int refinement : {2, 4}) {
    const OnInterface one(pressedBlocks(refinement), world());
    for (const char* name : {"BDDC", "Neumann-Neumann"}) endsInTime("waves", "Active Set", one.all, one.problem, name, success, out);
  }
}

TEUCHOS_UNIT_TEST(AutomaticTolerance, EndsCondensedGroups) {
  // Groups in the middle, other subdomains above and below.
  const Scene scene = pressed(wavyBlocks(twoBoxes(12, 12, 2, 3)));
  const Blocks all(scene, world());
  const CondensedProblem problem(world(), all.partition, all.subdomains, localSolver(), schurOf());
  for (const char* method : {"Semismooth Newton", "Chord"}) endsInTime("waves", method, all, problem, "Neumann-Neumann", success, out);
}

// A mesh that contains the exact solution has no discretisation error: no iteration may stop before the minimum tolerance is reached.
TEUCHOS_UNIT_TEST(AutomaticTolerance, GoesOnWhereTheMeshIsExact) {
  Scene scene = square(4, 4);
  for (const char* side : {"body_left", "body_right", "body_bottom", "body_top"})
    for (const int node : scene.nodesOf(side)) {
      const Point p = scene.mesh.point(node);
      scene.holdNode(node, 0, 1e-3 * p[0] + 2e-3 * p[1]);
      scene.holdNode(node, 1, -3e-3 * p[1]);
    }
  const OnInterface one(scene, world());
  const Runs runs = solveBoth("Active Set", one.all, one.problem, "BDDC");
  TEST_ASSERT(runs.automatic.converged);
  TEST_COMPARE(runs.automatic.residual, <=, 1e-8);
}

// The algebraic error against the distance to the solution, including contact. (With 1e-2 pairs may violate their conditions by a tenth of
// the largest force, and the error of a wrong status is not that of its linear problem.)
TEUCHOS_UNIT_TEST(AutomaticTolerance, RowsKnowTheirAlgebraicError) {
  const OnInterface one(pressedBlocks(2), world());
  const OuterResult full = solveWith("Active Set", one.problem, 1e-12);
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    const OuterResult loose = solveWith("Active Set", one.problem, tolerance);
    const double truth = energyDistance(one.all, one.problem, loose.state, full.state);
    out << tolerance << ": " << loose.energyError << " for " << truth << "\n";
    TEST_COMPARE(loose.energyError, >, 0.7 * truth);
    TEST_COMPARE(loose.energyError, <, 2.0 * truth);
  }
}

}  // namespace
}  // namespace suture
