// Methods that solve a partitioned scene.
#include <Teuchos_UnitTestHarness.hpp>
#include <pairs/RoughLaw.hpp>
#include <solver/SceneChoices.hpp>
#include <support/CheckSays.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/pairs/FrictionLaws.hpp>
#include <suture/solver/Method.hpp>

namespace suture {
namespace {

using namespace blocks;

/// The input of a method: the scene whole on rank 0, and partitioned.
struct Given {
  Parameters settings;
  Scene scene = pressedBlocks(2);
  Blocks all;
  Mesh mesh;
  Constraints constraints;

  explicit Given(const std::vector<std::string>& changes)
      : settings(solverParameters(changes)), all(scene, world(), std::vector<double>(), formulationOf(settings)->keepsGroupsWhole()) {
    if (world()->getRank() != 0) return;
    mesh = scene.mesh;
    constraints = scene.constraints;
  }
  CutScene cut() const { return {world(), mesh, constraints, all.partition, all.meshes, all.model, settings}; }
};

Solution solved(const Given& given, Monitor& monitor, const Start* start = nullptr, const Method::Keep& keep = {}) {
  Timers timers;
  const auto method = makeMethod(given.settings, true);
  method->prepare(given.cut(), timers);
  return method->solve(monitor, timers, start, keep);
}

Start startOf(const Solution& solution) {
  std::vector<PairResult> pairs = solution.pairs;
  broadcast(*world(), pairs);
  Start start{solution.displacement, {}};
  for (const PairResult& pair : pairs) start.status[pair.id] = pair.state;
  return start;
}

double relativeDistance(const Solution& a, const Solution& b) {
  double size = 0.0, far = 0.0, sizes = 0.0, all = 0.0;
  for (std::size_t s = 0; s < a.displacement.size(); ++s) {
    size = std::max(size, b.displacement[s].lpNorm<Eigen::Infinity>());
    far = std::max(far, (a.displacement[s] - b.displacement[s]).lpNorm<Eigen::Infinity>());
  }
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_MAX, size, Teuchos::outArg(sizes));
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_MAX, far, Teuchos::outArg(all));
  return all / sizes;
}

const std::string precise = "Outer Solver/Tolerance=1e-12";

TEUCHOS_UNIT_TEST(Method, DecompositionAndReferenceHaveOneSolution) {
  Monitor silent;
  for (const char* name : {"Contact On The Interface", "Condensed Groups"}) {
    const std::string formulation = std::string("Formulation=") + name;  // decides which rank has which subdomain
    const Solution reference = solved(Given({"Outer Solver/Type=Monolithic", formulation}), silent);
    TEST_ASSERT(reference.converged);
    TEST_EQUALITY(reference.outerSolver, "Monolithic");
    const Solution solution = solved(Given({precise, formulation}), silent);
    TEST_ASSERT(solution.converged);
    TEST_COMPARE(relativeDistance(solution, reference), <, 1e-9);
    TEST_FLOATING_EQUALITY(solution.energy, reference.energy, 1e-9);
  }
}

/// Problems of a method with lines of these laws, as messages; none if it accepts them.
std::vector<std::string> refused(const std::vector<std::string>& settings, std::vector<std::shared_ptr<const ContactLaw>> laws) {
  const Given given(settings);
  CutScene cut = given.cut();
  for (std::size_t k = 0; k < laws.size(); ++k) cut.contacts.push_back("line " + std::to_string(k));
  cut.laws = ContactLaws(std::move(laws));
  Timers timers;
  std::vector<std::string> problems;
  try {
    makeMethod(given.settings, true)->prepare(cut, timers);
  } catch (const InputError& error) {
    for (const auto& problem : error.problems()) problems.push_back(problem.path + " " + problem.message);
  }
  return problems;
}

// Friction needs a method that supports states of pairs; so does a law that never opens a pair.
TEUCHOS_UNIT_TEST(Method, RefusesFrictionWhereItKnowsNormalsAlone) {
  const auto smooth = std::make_shared<Frictionless>();
  const auto rough = std::make_shared<RoughLaw>();
  const auto guided = std::make_shared<NoSeparation>();
  const std::string onInterface = "Formulation=Contact On The Interface", groups = "Formulation=Condensed Groups";
  const std::vector<std::vector<std::string>> know{
      {onInterface, "Outer Solver/Type=Active Set"}, {groups, "Outer Solver/Type=Semismooth Newton"}, {"Outer Solver/Type=Monolithic"}, {}};
  for (const auto& settings : know) TEST_EQUALITY(refused(settings, {smooth, rough, guided}).size(), 0u);
  const std::vector<std::vector<std::string>> knowNot{{groups, "Outer Solver/Type=Chord"},
                                                      {groups, "Outer Solver/Type=Successive Approximation"}};
  for (const auto& settings : knowNot) {
    TEST_EQUALITY(refused(settings, {smooth}).size(), 0u);
    const std::vector<std::string> problems = refused(settings, {smooth, rough, guided});
    TEST_EQUALITY(problems.size(), 2u);
    if (problems.size() != 2u) continue;
    SUTURE_CHECK_SAYS(problems[0], "Contact/line 1/Law restricts sliding");
    SUTURE_CHECK_SAYS(problems[1], "Contact/line 2/Law never opens");
    SUTURE_CHECK_SAYS(problems[0], "Contact On The Interface");
  }
}

TEUCHOS_UNIT_TEST(Method, OnlyTheReferenceNeedsTheWholeMesh) {
  TEST_ASSERT(makeMethod(solverParameters({"Outer Solver/Type=Monolithic"}), true)->needsWholeMesh());
  TEST_ASSERT(!makeMethod(solverParameters({}), true)->needsWholeMesh());
}

TEUCHOS_UNIT_TEST(Method, GoesOnFromAnIntermediateState) {
  Monitor silent;
  const Given given({precise, "Formulation=Condensed Groups", "Outer Solver/Type=Chord"});
  std::vector<Start> kept;
  const Solution whole =
      solved(given, silent, nullptr, [&](const std::function<Solution()>& solution) { kept.push_back(startOf(solution())); });
  TEST_ASSERT(whole.converged);
  TEST_EQUALITY(int(kept.size()), whole.iterations - 1);
  const Solution rest = solved(given, silent, &kept[kept.size() / 2]);
  TEST_ASSERT(rest.converged);
  TEST_COMPARE(rest.iterations, <, whole.iterations);
  TEST_COMPARE(relativeDistance(rest, whole), <, 1e-9);
}

TEUCHOS_UNIT_TEST(Method, RefusesAnotherOrderOfCalls) {
  const Given given({});
  Timers timers;
  Monitor silent;
  const auto method = makeMethod(given.settings, true);
  TEST_THROW(method->solve(silent, timers), InternalError);
  method->prepare(given.cut(), timers);
  TEST_COMPARE(method->interfaceUnknowns(), >, 0);
  TEST_THROW(method->prepare(given.cut(), timers), InternalError);
  // A method that needs the mesh does not get it: rank 0 reports the error before the others wait.
  const Mesh none;
  const CutScene cut = given.cut(), empty{cut.comm, none, cut.constraints, cut.partition, cut.meshes, cut.model, cut.settings};
  TEST_THROW(makeMethod(solverParameters({"Outer Solver/Type=Monolithic"}), true)->prepare(empty, timers), InternalError);
}

TEUCHOS_UNIT_TEST(Method, TimesItsPhases) {
  const Given given({});
  Timers timers;
  Monitor silent;
  const auto method = makeMethod(given.settings, true);
  method->prepare(given.cut(), timers);
  method->solve(silent, timers);
  for (const char* phase : {"assemble", "factor", "solve"}) TEST_COMPARE(timers.seconds(phase), >, 0.0);
}

/// A user's method: nothing moves.
class Frozen : public Method {
 public:
  bool needsWholeMesh() const override { return false; }

 protected:
  void doAssemble(Subdomains) override {}
  Solution doSolve(Monitor&, const Start*, const Keep&) override {
    Solution solution;
    solution.converged = true;
    for (const SubdomainMesh& mesh : scene().meshes) solution.displacement.push_back(Vector::Zero(2 * mesh.nodes()));
    return solution;
  }
};
const Registration<Method> registration("Frozen", Schema("nothing moves"),
                                        [](const Parameters&, const Parameters&) { return std::make_unique<Frozen>(); });

TEUCHOS_UNIT_TEST(Method, OfAUsersOwnIsChosenByItsName) {
  Monitor silent;
  const Given given({"Outer Solver/Type=Frozen"});
  const Solution solution = solved(given, silent);
  TEST_ASSERT(solution.converged);
  TEST_EQUALITY(solution.displacement.size(), given.all.meshes.size());
}

}  // namespace
}  // namespace suture
