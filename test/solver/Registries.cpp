// The contract of every registry, for all its entries: made from its own defaults, documented, refused under another name, and with it the
// contact problem has the reference's solution.
#include <Teuchos_UnitTestHarness.hpp>
#include <solver/SceneChoices.hpp>
#include <suture/precond/PrimalConstraints.hpp>
#include <suture/precond/Weighting.hpp>
#include <suture/precond/coarse/CoarseSpace.hpp>

#include <set>

namespace suture {
namespace {

using namespace blocks;

void isDocumented(const std::string& name, const Schema& schema, bool& success, Teuchos::FancyOStream& out) {
  TEST_ASSERT(!schema.doc().empty());
  for (const Schema::Parameter& parameter : schema.parameters()) {
    out << name << "/" << parameter.name << "\n";
    TEST_ASSERT(!parameter.doc.empty());
  }
  for (const auto& [list, own] : schema.lists()) isDocumented(name + "/" + list, own, success, out);
}

/// Names, defaults, documentation. `path`: of the parameter that chooses.
template <typename Base>
void checkEntries(const std::string& path, bool& success, Teuchos::FancyOStream& out) {
  const auto& registry = Registry<Base>::instance();
  TEST_COMPARE(registry.names().size(), >=, 2);
  const std::string list = path.substr(0, path.rfind('/')), parameter = path.substr(path.rfind('/') + 1);
  for (const std::string& name : registry.names()) {
    out << Base::kind() << " " << name << "\n";
    isDocumented(name, registry.schemas().at(name), success, out);
    // Parameters of a scene that names the strategy and nothing else.
    Parameters scene = solverParameters({path + "=" + name});
    Parameters* own = &scene;
    for (std::size_t at = 0, end = 0; end != std::string::npos; at = end + 1) {
      end = list.find('/', at);
      own = &own->sublist(list.substr(at, end == std::string::npos ? end : end - at));
    }
    TEST_EQUALITY(own->get<std::string>(parameter), name);
    TEST_ASSERT(makeStrategy<Base>(*own, parameter) != nullptr);
    // Near misses are refused, with the name.
    try {
      registry.make(name + "x", Parameters());
      TEST_ASSERT(false);
    } catch (const InputError& error) {
      TEST_ASSERT(std::string(error.what()).find("'" + name + "'") != std::string::npos);
    }
  }
}

/// The solution with these settings is the reference's.
void isTheReferences(const Scene& scene, const MonolithicResult& reference, const std::vector<std::string>& settings, double tolerance,
                     bool& success, Teuchos::FancyOStream& out) {
  int solved = 0;
  for (const std::string& formulation : formulations()) {
    const Parameters wanted = solverParameters(settings);
    std::string method = wanted.sublist("Outer Solver").get<std::string>("Type");
    std::vector<std::string> all = settings;
    if (!solvesFormulation(method, formulation)) {
      // A setting that chooses no method is for every formulation: by the first method that fits.
      if (std::any_of(settings.begin(), settings.end(), [](const std::string& s) { return s.rfind("Outer Solver/Type", 0) == 0; }))
        continue;
      for (const char* other : {"Semismooth Newton", "Active Set"})
        if (solvesFormulation(other, formulation)) method = other;
      all.push_back("Outer Solver/Type=" + method);
    }
    for (const std::string& setting : all) out << setting << "; ";
    out << formulation << "\n";
    const Formulated one(scene, world(), formulation, all);
    Monitor silent;
    const OuterResult result = solveInterface(*one.problem, one.parameters, silent);
    TEST_ASSERT(result.converged);
    if (!result.converged) out << result.failure << "\n";
    const Distance far = distance(one.all, one.problem->recover(result.state), reference);
    TEST_COMPARE(far.displacement, <, tolerance);
    TEST_COMPARE(far.force, <, 10 * tolerance);
    TEST_EQUALITY(far.otherwise, 0);
    ++solved;
  }
  TEST_COMPARE(solved, >, 0);
}

template <typename Base>
void checkRegistry(const std::vector<std::string>& paths, const std::vector<std::string>& with, bool& success, Teuchos::FancyOStream& out) {
  const Scene scene = pressedBlocks();
  Monitor silent;
  const MonolithicResult reference = solveMonolithic(scene.mesh, scene.constraints, scene.model, MonolithicOptions(), silent);
  TEST_ASSERT(reference.converged);
  for (const std::string& path : paths) {
    checkEntries<Base>(path, success, out);
    for (const std::string& name : Registry<Base>::instance().names()) {
      std::vector<std::string> settings = with;
      settings.push_back(path + "=" + name);
      if (path.rfind("Preconditioner/", 0) == 0 && path.find('/', 15) != std::string::npos)
        settings.push_back("Preconditioner/Type=" + path.substr(15, path.find('/', 15) - 15));
      isTheReferences(scene, reference, settings, 1e-6, success, out);
    }
  }
}

const std::vector<std::string> precise = {"Outer Solver/Tolerance=1e-10"};

TEUCHOS_UNIT_TEST(Registries, EveryOuterSolver) {
  checkRegistry<OuterSolver>({"Outer Solver/Type"}, {"Outer Solver/Tolerance=1e-8", "Outer Solver/Maximum Iterations=2000"}, success, out);
}
TEUCHOS_UNIT_TEST(Registries, EveryPreconditioner) { checkRegistry<Preconditioner>({"Preconditioner/Type"}, precise, success, out); }
TEUCHOS_UNIT_TEST(Registries, EveryWeighting) {
  checkRegistry<Weighting>({"Preconditioner/BDDC/Weighting", "Preconditioner/Neumann-Neumann/Weighting"}, precise, success, out);
}
TEUCHOS_UNIT_TEST(Registries, EveryCoarseSpace) {
  checkRegistry<CoarseSpace>({"Preconditioner/Neumann-Neumann/Coarse Space"}, precise, success, out);
}
TEUCHOS_UNIT_TEST(Registries, EveryPrimalConstraints) {
  checkRegistry<PrimalConstraints>({"Preconditioner/BDDC/Edge Constraints"}, precise, success, out);
}
TEUCHOS_UNIT_TEST(Registries, EverySchurComplement) {
  checkRegistry<SchurComplement>({"Subdomain/Schur Complement"}, precise, success, out);
}
TEUCHOS_UNIT_TEST(Registries, EveryLocalSolver) { checkRegistry<LocalSolver>({"Subdomain/Local Solver"}, precise, success, out); }

}  // namespace
}  // namespace suture
