// Tolerance = Automatic: the solver ends at a tenth of the discretisation error, and the bound of the error is that of the converged
// solution, with the same contact. The converged solution of the same mesh, to ten digits, is the reference.
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/report/SceneSchema.hpp>
#include <suture/simulation/Simulation.hpp>
#include <suture/solver/nested/NestedStart.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace suture {
namespace {

using Settings = std::vector<std::string>;

/// Pressure with small strains in both blocks.
double pressOn(double stiffer) { return 1e-2 * std::min(1.0, stiffer); }

/// A block on a larger one, pressed down and pulled to the side so that a part of the contact opens.
Scene blockOnBlock(Cell cell, int cells, double stiffer, Settings settings) {
  ElasticModel model;
  model.dimension = 2;
  model.addBody("upper", std::make_shared<IsotropicLaw>(IsotropicModuli{200.0 * stiffer, 0.3}));
  model.addBody("lower", std::make_shared<IsotropicLaw>(IsotropicModuli{50.0, 0.25}));
  const double press = pressOn(stiffer);
  model.loads = {Load::traction("upper_top", {0.2 * press, -press, 0.0})};
  const auto mesh = [cell, cells] {
    return boxes({Box{"upper", 0, 1, 0, 1, cells, cells, cell}, Box{"lower", 0, 2, -1, 0, 2 * cells, cells, cell}});
  };
  settings.push_back("Output/Error Bound=true");
  return makeScene(model, mesh, {Condition::displacement("upper_right", {0}, {0}), Condition::displacement("lower_bottom", {0, 0}, {0, 1})},
                   {Contact::between("upper_bottom", "lower_top")}, settings);
}

JudgedScene judged(const Scene& scene, const JudgedScene* coarse = nullptr) {
  PreparedScene prepared = prepare(check(cut(read(RunContext(blocks::world()), scene))));
  if (coarse) prepared.startFrom(nestedStart(*blocks::world(), CoarseAnswer{coarse->meshes(), coarse->solution()}, prepared.meshes()));
  return judge(solve(std::move(prepared)));
}

/// Iterations of conjugate gradients, without other applications of the operator.
int steps(const Solution& solution) { return solution.pcgTotal - solution.otherApplications + solution.auxiliary.pcg; }

double totalForce(const Solution& solution) {
  double sum = 0.0;
  for (const PairResult& pair : solution.pairs) sum += pair.force;
  return sum;
}

struct Case {
  Cell cell;
  int cells;
  bool isNested;
  std::string subdomains;
  double gain;           // least ratio of iterations
  double stiffer = 1.0;  // factor on the modulus of the upper block
  Settings others{};
};

void endsEarly(const Case& one, bool& success, Teuchos::FancyOStream& out) {
  const auto settings = [&](const std::string& tolerance) {
    Settings all = one.others;
    all.push_back("Partition/METIS/Subdomains=" + one.subdomains);
    all.push_back("Outer Solver/Tolerance=" + tolerance);
    return all;
  };
  Settings coarseSettings = settings("Automatic");
  const JudgedScene coarse = judged(blockOnBlock(one.cell, one.cells / 2, one.stiffer, coarseSettings));
  const auto solutionOf = [&](const std::string& tolerance) {
    return judged(blockOnBlock(one.cell, one.cells, one.stiffer, settings(tolerance)), one.isNested ? &coarse : nullptr).solution();
  };
  const Solution early = solutionOf("Automatic"), full = solutionOf("1e-8"), exact = solutionOf("1e-11");
  TEST_ASSERT(early.isValid() && full.isValid() && exact.isValid());
  TEST_ASSERT(early.bound && full.bound);
  if (!success) {
    out << early.failure << full.failure << exact.failure << "\n";
    return;
  }
  const ErrorBound &ours = *early.bound, &theirs = *full.bound;
  const double tolerance = 0.1 * early.discretisation->relative();
  const double algebraic = std::sqrt(std::max(0.0, 2 * (early.energy - exact.energy)));
  int other = 0;
  for (std::size_t p = 0; p < full.pairs.size(); ++p) other += early.pairs[p].state.closed() != full.pairs[p].state.closed();
  out << cellInfo(one.cell).name << " " << one.cells << (one.isNested ? " nested" : "") << ", " << one.subdomains
      << " subdomains: " << steps(early) << " of " << steps(full) << " iterations, " << early.iterations << " of " << full.iterations
      << " outer, bound " << ours.total << " of " << theirs.total << ", algebraic " << ours.algebraic << " (true " << algebraic
      << "), tolerance " << tolerance << ", pairs with other states " << other << "\n";
  TEST_COMPARE(steps(early) * one.gain, <=, steps(full));
  TEST_COMPARE(early.iterations, <=, full.iterations);
  TEST_ASSERT(ours.strict && theirs.strict);
  TEST_COMPARE(ours.total, <=, 1.01 * theirs.total);
  TEST_COMPARE(ours.algebraic, <=, 0.11 * ours.total);
  TEST_COMPARE(ours.algebraic, >=, algebraic * (1 - 1e-6));  // the discrete solution has the least energy of its mesh
  TEST_COMPARE(ours.total * ours.total, >=, 2 * (early.energy - theirs.energyUpper));
  TEST_EQUALITY(other, 0);
  // The force on the lower block is the load on a side of length 1.
  if (blocks::world()->getRank() == 0) TEST_FLOATING_EQUALITY(totalForce(early), pressOn(one.stiffer), 10 * tolerance);
}

TEUCHOS_UNIT_TEST(StoppingByTheBound, SavesIterationsFromANestedStart) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6}) endsEarly({cell, 16, true, "20", 3.0}, success, out);
}

TEUCHOS_UNIT_TEST(StoppingByTheBound, SavesIterationsFromZero) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6}) endsEarly({cell, 16, false, "20", 1.7}, success, out);
}

TEUCHOS_UNIT_TEST(StoppingByTheBound, DecidesContactOfStiffBlocks) {
  for (const double stiffer : {1e3, 1e-3}) endsEarly({Cell::Triangle6, 8, true, "12", 1.5, stiffer}, success, out);
}

TEUCHOS_UNIT_TEST(StoppingByTheBound, SavesIterationsWithOtherPreconditionersAndFormulations) {
  endsEarly({Cell::Triangle6, 8, true, "12", 2.0, 1.0, {"Preconditioner/Type=Neumann-Neumann"}}, success, out);
  endsEarly({Cell::Triangle6, 8, true, "12", 1.5, 1.0, {"Formulation=Condensed Groups"}}, success, out);
}

// Two subdomains on up to four ranks: some ranks have none.
TEUCHOS_UNIT_TEST(StoppingByTheBound, WorksWithMoreRanksThanSubdomains) { endsEarly({Cell::Triangle6, 8, true, "2", 1.0}, success, out); }

Scene fromFile(const std::string& path, const Settings& settings) {
  return sceneOf(*blocks::world(), readScene(*blocks::world(), std::string(SUTURE_SOURCE_DIR) + "/" + path, sceneSchema(), settings));
}

std::string toleranceOf(const Settings& settings) {
  return fromFile("test/drivers/punch_of_boxes.xml", settings).settings().sublist("Outer Solver").get<std::string>("Tolerance");
}

TEUCHOS_UNIT_TEST(StoppingByTheBound, IsTheDefaultWithARequestedAccuracy) {
  TEST_EQUALITY(toleranceOf({}), "1e-8");
  TEST_EQUALITY(toleranceOf({"Output/Error Bound=true"}), "1e-8");
  TEST_EQUALITY(toleranceOf({"Accuracy/Error=0.05"}), "Automatic");
  TEST_EQUALITY(toleranceOf({"Accuracy/Error=0.05", "Outer Solver/Tolerance=1e-6"}), "1e-6");
  TEST_EQUALITY(toleranceOf({"Accuracy/Error=0.05", "Outer Solver/Type=Monolithic"}), "1e-8");  // direct
}

// The sum over all meshes, each from the solution on the previous one. The meshes differ a little: several bisections for each solution
// amplify small differences of the errors by which elements are marked.
TEUCHOS_UNIT_TEST(StoppingByTheBound, SavesIterationsOnAdaptiveMeshes) {
  const auto run = [](const std::string& tolerance) {
    return refine(judged(fromFile("test/drivers/punch_of_boxes.xml",
                                  {"Accuracy/Error=0.01", "Partition/METIS/Subdomains=16", "Outer Solver/Tolerance=" + tolerance})));
  };
  const auto iterations = [](const AccuracyReached& reached) {
    int sum = 0;
    for (const AccuracyLevel& level : reached.levels) sum += level.iterations;
    return sum;
  };
  const JudgedScene early = run("Automatic"), full = run("1e-8");
  TEST_ASSERT(early.accuracy() && full.accuracy());
  const AccuracyReached &ours = *early.accuracy(), &theirs = *full.accuracy();
  out << iterations(ours) << " of " << iterations(theirs) << " iterations, " << ours.levels.size() << " and " << theirs.levels.size()
      << " meshes, errors " << ours.reached << " and " << theirs.reached << "\n";
  TEST_ASSERT(ours.isMet() && theirs.isMet() && early.solution().isValid());
  TEST_ASSERT(ours.strict);
  TEST_COMPARE(ours.reached, <=, 0.01);
  TEST_EQUALITY(ours.levels.size(), theirs.levels.size());
  TEST_COMPARE(iterations(ours) * 2.2, <=, iterations(theirs));
  TEST_COMPARE(early.solution().bound->algebraic, <=, 0.11 * early.solution().bound->total);
  for (std::size_t k = 0; k < std::min(ours.levels.size(), theirs.levels.size()); ++k)
    TEST_FLOATING_EQUALITY(ours.levels[k].error, theirs.levels[k].error, 0.1);
}

}  // namespace
}  // namespace suture
