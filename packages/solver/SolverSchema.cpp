#include <suture/algebra/LocalSolver.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/precond/Preconditioner.hpp>
#include <suture/solver/Method.hpp>
#include <suture/solver/OuterSolver.hpp>
#include <suture/solver/SolverSchema.hpp>
#include <suture/solver/accuracy/RequestedAccuracy.hpp>
#include <suture/subdomain/SchurComplement.hpp>

#include <Teuchos_ParameterList.hpp>

#include <sstream>

namespace suture {

namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

template <typename Base>
std::unique_ptr<Base> madeBy(const Parameters& list, const std::string& name) {
  return Registry<Base>::instance().make(name, list.isSublist(name) ? list.sublist(name) : Parameters());
}

/// The default outer solver of a resolved scene: `fallback` if it fits the formulation, else the formulation's own default.
std::string fittingSolver(const Parameters& scene, const std::string& fallback) {
  const auto formulation = formulationOf(scene);
  const bool fits = madeBy<OuterSolver>(scene.sublist("Outer Solver"), fallback)->solves(*formulation);
  return fits ? fallback : formulation->outerSolver();
}

/// The default tolerance of a resolved scene. Other methods than outer solvers are direct, or have their own tolerance.
std::string fittingTolerance(const Parameters& scene) {
  const bool iterates = Registry<OuterSolver>::instance().has(scene.sublist("Outer Solver").get<std::string>("Type"));
  return iterates && refinesMesh(scene) ? "Automatic" : "1e-8";
}

}  // namespace

void checkCombination(const Parameters& settings) {
  const Parameters& outer = settings.sublist("Outer Solver");
  const auto formulation = formulationOf(settings);
  const auto chosen = makeStrategy<OuterSolver>(outer, "Type");
  if (chosen->solves(*formulation)) return;
  std::vector<std::string> solvers, formulations;
  for (const std::string& name : Registry<OuterSolver>::instance().names())
    if (madeBy<OuterSolver>(outer, name)->solves(*formulation)) solvers.push_back(name);
  for (const std::string& name : Registry<Method>::instance().names()) solvers.push_back(name);
  for (const std::string& name : Registry<Formulation>::instance().names())
    if (chosen->solves(*madeBy<Formulation>(settings, name))) formulations.push_back("'" + name + "'");
  throw InputError(pathOf(outer, "Type"), "'" + outer.get<std::string>("Type") + "' does not solve the formulation '" +
                                              settings.get<std::string>("Formulation") + "'. Those that do: " + listed(solvers) +
                                              ". Or choose the Formulation " + listed(formulations));
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
         << ": the remaining residual may decide whether pairs are open or closed; rely only on the verdict";
    warnings.push_back(text.str());
  };
  const Parameters& outer = scene.sublist("Outer Solver");
  look(outer, "Tolerance");
  const std::string method = outer.get<std::string>("Type");
  if (outer.isSublist(method)) look(outer.sublist(method), "Inner Tolerance");
  return warnings;
}

void addSolverParameters(Schema& scene) {
  scene.choice("Formulation", "Contact On The Interface", Registry<Formulation>::instance().schemas(),
               "Unknowns of the interface problem and treatment of contact.");

  constexpr const char* usual = "Active Set";
  auto solvers = Registry<OuterSolver>::instance().schemas();
  for (const auto& [name, schema] : Registry<Method>::instance().schemas())
    if (!solvers.emplace(name, schema).second) throw InternalError("an outer solver and a method have the same name: '" + name + "'");
  Schema outer("Solver of the contact problem; a scene without contact is linear and needs no outer iterations.");
  outer
      .choice("Type", usual, solvers,
              std::string("Name of the outer solver. If none is given and ") + usual +
                  " does not fit the Formulation, its default solver is used.")
      .fittingDefault([](const Parameters& whole) { return fittingSolver(whole, usual); });
  outer.choice("Start", "Rigid Bodies",
               {{"Rigid Bodies", Schema("Rigid bodies on unilateral elastic pads, without a linear solve. For Active Set, Monolithic and "
                                        "Semismooth Newton; other methods start as Bilateral.")},
                {"Bilateral", Schema("Solution with all pairs closed, the auxiliary problem of the paper.")},
                {"Nested", Schema("Solution on a sequence of coarser meshes.")
                               .texts("Levels", std::nullopt,
                                      "One text per level, the coarsest first: changes to this scene in the syntax of --set, separated by "
                                      "semicolons: \"Mesh/Constants/scale=2; Partition/METIS/Subdomains=12\".")}},
               "Initial state of the outer solver.");
  outer
      .wordOrNumber(
          "Tolerance", "1e-8", {"Automatic"}, {0.0, 1.0, true, true, {}},
          "Bound of the residual in the preconditioner's norm, relative to the energy norm of the solution (Active Set, Semismooth "
          "Newton) or to the residual of the start with all pairs closed (other methods). Automatic: iterations stop when the "
          "algebraic error is a tenth of the estimated discretisation error (energy norm), at the latest at 1e-8. With Accuracy/Error "
          "the default is Automatic.")
      .fittingDefault([](const Parameters& whole) { return fittingTolerance(whole); });
  outer.oneOf(
      "Neutral Motions", "Refuse", {"Refuse", "Least"},
      "Treatment of a solution in which a loaded body can slide or turn freely after pairs have opened, so that its position is not "
      "determined. Refuse: the run writes its results, reports body and motion and ends with exit code 4. Least: the smallest "
      "displacement is used and reported in a note.");
  outer.integer("Maximum Iterations", 200,
                "Maximum number of outer iterations; for methods by sets of closed pairs, maximum number of sets.", Range::atLeast(0));
  outer.integer("Maximum Inner Iterations", 1000, "Maximum number of conjugate gradient iterations per linear solve.", Range::atLeast(1));
  scene.list("Outer Solver", outer);

  scene.list("Preconditioner", preconditionerSchema());

  Schema subdomain = subdomainSchema();
  subdomain.choice("Schur Complement", "Automatic", Registry<SchurComplement>::instance().schemas(), "Storage of S_i.");
  subdomain.real("Memory Limit", 0.0,
                 "Memory limit for all ranks on one machine together; a run whose estimate exceeds it is refused before it starts. 0: the "
                 "available memory of the machine.",
                 Range::atLeast(0), "MB");
  scene.list("Subdomain", subdomain);
}

}  // namespace suture
