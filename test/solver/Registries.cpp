// The contract of every registry, for all its entries: constructed with its defaults, documented, refused under another name, and with it
// the contact problem has the reference's solution.
#include <Teuchos_UnitTestHarness.hpp>
#include <solver/SceneChoices.hpp>
#include <suture/condensed/CondensedProblem.hpp>
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
  const std::size_t slash = path.rfind('/');
  const std::string list = slash == std::string::npos ? "" : path.substr(0, slash), parameter = path.substr(list.empty() ? 0 : slash + 1);
  for (const std::string& name : registry.names()) {
    out << Base::kind() << " " << name << "\n";
    isDocumented(name, registry.schemas().at(name), success, out);
    // Parameters of a scene that names the strategy and nothing else.
    Parameters scene = solverParameters({path + "=" + name});
    Parameters* own = &scene;
    for (std::size_t at = 0, end = 0; !list.empty() && end != std::string::npos; at = end + 1) {
      end = list.find('/', at);
      own = &own->sublist(list.substr(at, end == std::string::npos ? end : end - at));
    }
    TEST_EQUALITY(own->get<std::string>(parameter), name);
    TEST_ASSERT(makeStrategy<Base>(*own, parameter) != nullptr);
    // Near misses are refused, and the message contains the name.
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
    std::vector<std::string> all = settings;
    all.push_back("Formulation=" + formulation);
    const Parameters wanted = solverParameters(all);
    if (!makeStrategy<OuterSolver>(wanted.sublist("Outer Solver"), "Type")->solves(*formulationOf(wanted)))
      continue;  // the settings chose it
    for (const std::string& setting : all) out << setting << "; ";
    out << "\n";
    const Formulated one(scene, world(), formulation, settings);
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

/// A user's formulation.
class Borrowed : public Formulation {
 public:
  bool keepsGroupsWhole() const override { return true; }
  bool hidesContact() const override { return true; }
  std::string outerSolver() const override { return "Chord"; }

 protected:
  std::unique_ptr<InterfaceProblem> doMake(const CommPtr& comm, const Partition& partition,
                                           const std::vector<std::unique_ptr<Subdomain>>& subdomains, const LocalAlgebra& algebra,
                                           const ContactLaws&) const override {
    return std::make_unique<CondensedProblem>(comm, partition, subdomains, algebra.solver, algebra.schur);
  }
};
const Registration<Formulation> borrowed("Borrowed Groups", Schema("groups of a user's own"),
                                         [](const Parameters&) { return std::make_unique<Borrowed>(); });

const std::vector<std::string> preciseOptions = {"Outer Solver/Tolerance=1e-10"};

TEUCHOS_UNIT_TEST(Registries, EveryOuterSolver) {
  checkRegistry<OuterSolver>({"Outer Solver/Type"}, {"Outer Solver/Tolerance=1e-8", "Outer Solver/Maximum Iterations=2000"}, success, out);
}
TEUCHOS_UNIT_TEST(Registries, EveryFormulation) {
  checkEntries<Formulation>("Formulation", success, out);
  const Scene scene = pressedBlocks();
  Monitor silent;
  const MonolithicResult reference = solveMonolithic(scene.mesh, scene.constraints, scene.model, MonolithicOptions(), silent);
  isTheReferences(scene, reference, preciseOptions, 1e-6, success, out);  // in every one
}
TEUCHOS_UNIT_TEST(Registries, AFormulationAlonePicksAnOuterSolverThatFits) {
  for (const std::string& formulation : formulations()) {
    const Parameters scene = solverParameters({"Formulation=" + formulation});
    const auto solver = scene.sublist("Outer Solver").get<std::string>("Type");
    out << formulation << ": " << solver << "\n";
    TEST_EQUALITY(solver, formulationOf(scene)->outerSolver());
    TEST_NOTHROW(checkCombination(scene));
  }
  TEST_EQUALITY(solverParameters({}).sublist("Outer Solver").get<std::string>("Type"), "Active Set");
}
TEUCHOS_UNIT_TEST(Registries, AChosenOuterSolverThatDoesNotFitIsRefusedWithThoseThatDo) {
  try {
    checkCombination(solverParameters({"Formulation=Borrowed Groups", "Outer Solver/Type=Active Set"}));
    TEST_ASSERT(false);
  } catch (const InputError& error) {
    TEST_EQUALITY(error.problems()[0].path, "Outer Solver/Type");
    TEST_EQUALITY(error.problems()[0].message,
                  "'Active Set' does not solve the formulation 'Borrowed Groups'. Those that do: Chord, Semismooth Newton, Successive "
                  "Approximation, Monolithic. Or choose the Formulation 'Contact On The Interface'");
  }
}
TEUCHOS_UNIT_TEST(Registries, EveryPreconditioner) { checkRegistry<Preconditioner>({"Preconditioner/Type"}, preciseOptions, success, out); }
TEUCHOS_UNIT_TEST(Registries, EveryWeighting) {
  checkRegistry<Weighting>({"Preconditioner/BDDC/Weighting", "Preconditioner/Neumann-Neumann/Weighting"}, preciseOptions, success, out);
}
TEUCHOS_UNIT_TEST(Registries, EveryCoarseSpace) {
  checkRegistry<CoarseSpace>({"Preconditioner/Neumann-Neumann/Coarse Space"}, preciseOptions, success, out);
}
TEUCHOS_UNIT_TEST(Registries, EveryPrimalConstraints) {
  checkRegistry<PrimalConstraints>({"Preconditioner/BDDC/Edge Constraints"}, preciseOptions, success, out);
}
TEUCHOS_UNIT_TEST(Registries, EverySchurComplement) {
  checkRegistry<SchurComplement>({"Subdomain/Schur Complement"}, preciseOptions, success, out);
}
TEUCHOS_UNIT_TEST(Registries, EveryLocalSolver) { checkRegistry<LocalSolver>({"Subdomain/Local Solver"}, preciseOptions, success, out); }

}  // namespace
}  // namespace suture
