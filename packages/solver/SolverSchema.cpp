#include <suture/algebra/LocalSolver.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/precond/Preconditioner.hpp>
#include <suture/solver/OuterSolver.hpp>
#include <suture/solver/SolverSchema.hpp>
#include <suture/subdomain/SchurComplement.hpp>

#include <Teuchos_ParameterList.hpp>

#include <map>
#include <sstream>

namespace suture {

bool solvesFormulation(const std::string& method, const std::string& formulation) {
  static const std::map<std::string, std::string> only = {{"Active Set", kContactOnTheInterface},
                                                          {"Chord", kCondensedGroups},
                                                          {"Semismooth Newton", kCondensedGroups},
                                                          {"Successive Approximation", kCondensedGroups}};
  const auto found = only.find(method);
  return found == only.end() || found->second == formulation;  // of a user's own we do not know
}

std::vector<std::string> looseTolerances(const Parameters& scene) {
  constexpr double loosest = 1e-2;
  std::vector<std::string> warnings;
  const auto look = [&](const Parameters& list, const std::string& name) {
    double value = 0.0;
    if (list.isType<double>(name)) value = list.get<double>(name);
    if (list.isType<std::string>(name) && list.get<std::string>(name) != "Automatic") value = std::stod(list.get<std::string>(name));
    if (value <= loosest) return;
    std::ostringstream text;
    text << "warning: " << pathOf(list, name) << ": " << value << " is looser than " << loosest
         << ": pairs may be told open or closed by what is left of the iteration; trust the verdict alone";
    warnings.push_back(text.str());
  };
  const Parameters& outer = scene.sublist("Outer Solver");
  look(outer, "Tolerance");
  const std::string method = outer.get<std::string>("Type");
  if (outer.isSublist(method)) look(outer.sublist(method), "Inner Tolerance");
  return warnings;
}

void addSolverParameters(Schema& scene) {
  Schema condensed("The paper's: contact is hidden inside groups of subdomains, each whole on one rank.");
  condensed.real("Memory Limit", 4096.0,
                 "A group whose factors are estimated to take more is refused before it is factored: it lives on one rank, however many "
                 "there are.",
                 Range::positive(), "MB");
  scene.choice("Formulation", kContactOnTheInterface,
               {{kContactOnTheInterface,
                 Schema("Closed pairs identify unknowns of the interface; any partition, any length of contact line, on any ranks.")},
                {kCondensedGroups, condensed}},
               "What the unknowns on the interface are, and where contact is.");

  auto methods = Registry<OuterSolver>::instance().schemas();
  Schema monolithic(
      "The whole system on one rank, one factorisation with the contact unknowns last, active set: for small scenes and as a "
      "reference.");
  monolithic.oneOf("Ordering", "AMD", {"AMD", "METIS"},
                   "Of the unknowns that are not in contact: METIS leaves less fill than AMD and takes longer to find it.");
  methods.emplace(kMonolithic, monolithic);
  Schema outer("How the contact problem is solved; a scene without contact is linear and enters no outer loop.");
  outer.choice("Type", "Active Set", methods, "Name of the outer solver.");
  outer.choice("Start", "Rigid Bodies",
               {{"Rigid Bodies", Schema("Rigid bodies on unilateral elastic pads in place of contact: no linear solve. Active Set and "
                                        "Monolithic; other methods start as Bilateral.")},
                {"Bilateral", Schema("The solution with all pairs closed, the paper's auxiliary problem.")},
                {"Nested", Schema("The solution on coarser meshes, one from the other.")
                               .texts("Levels", std::nullopt,
                                      "One text a level, the coarsest first: what differs from this scene, as in --set, separated by "
                                      "semicolons: \"Mesh/Constants/scale=2; Partition/METIS/Subdomains=12\".")}},
               "Where the outer solver begins.");
  outer.wordOrNumber(
      "Tolerance", "1e-8", {"Automatic"}, {0.0, 1.0, true, true, {}},
      "Of the preconditioned norm of the residual, relative to that of the lifted start. Automatic: no digits that the mesh "
      "cannot hold; iterations end where the algebraic error is a tenth of the estimated discretisation error (energy norm), "
      "or at 1e-8.");
  outer.oneOf(
      "Neutral Motions", "Refuse", {"Refuse", "Least"},
      "What becomes of a solution in which a loaded body slides or turns freely after pairs have opened: its place is not determined "
      "then. Refuse: the run writes its results, names body and motion and ends with exit code 4. Least: the least displacement is "
      "kept, and a note says so.");
  outer.integer("Maximum Iterations", 200, "Outer iterations at most; methods by closed sets: sets at most.", Range::atLeast(0));
  outer.integer("Maximum Inner Iterations", 1000, "Conjugate gradient iterations of one linear solve at most.", Range::atLeast(1));
  scene.list("Outer Solver", outer);

  scene.list("Preconditioner", preconditionerSchema());

  Schema subdomain = subdomainSchema();
  subdomain.choice("Schur Complement", "Automatic", Registry<SchurComplement>::instance().schemas(), "How S_i is kept.");
  subdomain.real("Memory Limit", 0.0,
                 "What all ranks on one machine may take together; a run that is estimated to take more is refused before it starts. 0: "
                 "what the machine has left.",
                 Range::atLeast(0), "MB");
  scene.list("Subdomain", subdomain);
}

}  // namespace suture
