#include <suture/base/Errors.hpp>
#include <suture/interface/Formulation.hpp>
#include <suture/solver/SolveInterface.hpp>
#include <suture/solver/accuracy/RequestedAccuracy.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

namespace suture {

std::unique_ptr<InterfaceProblem> makeInterfaceProblem(const CommPtr& comm, const Partition& partition, const Subdomains& subdomains,
                                                       const Parameters& settings, const ContactLaws& laws) {
  const Parameters& own = settings.sublist("Subdomain");
  const auto schur = [&own] { return makeStrategy<SchurComplement>(own, "Schur Complement"); };
  return formulationOf(settings)->make(comm, partition, subdomains, {localSolverMaker(own), schur}, laws);
}

InterfaceState stateOf(const Start& start, const InterfaceProblem& problem, const Subdomains& subdomains) {
  std::vector<Vector> freeValues;
  for (std::size_t i = 0; i < subdomains.size(); ++i) freeValues.push_back(subdomains[i]->freeValues(start.displacement[i]));
  return problem.stateOf(freeValues, start.status);
}

std::string unsettled(const ContactProblem& contact, const std::vector<int>& pairs, const std::vector<std::string>& contacts,
                      const std::vector<std::string>& bodies, bool atLimit) {
  constexpr std::size_t kMost = 10;
  const RigidBodyModel::Pairs& data = contact.bodies().rigid().data();
  std::map<int, std::vector<int>> byLine;
  for (const int pair : pairs) byLine[data.line[pair]].push_back(pair);
  std::string text;
  for (const auto& [line, own] : byLine) {
    std::set<std::string> names;
    text += "; pairs ";
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (k < kMost) text += (k > 0 ? ", " : "") + std::to_string(own[k]);
      for (const int part : data.bodies[own[k]]) names.insert("'" + bodies.at(contact.bodies().parts()[part].body) + "'");
    }
    if (own.size() > kMost) text += " and " + std::to_string(own.size() - kMost) + " more";
    text += " of contact '" + contacts.at(line) + "' (";
    for (const std::string& name : names) text += (name == *names.begin() ? "" : ", ") + name;
    text += ")";
  }
  return text + " still open and close from step to step; try " +
         (atLimit ? "a larger Outer Solver/Maximum Iterations, Load Steps with smaller increments" : "Load Steps with smaller increments") +
         ", or Outer Solver/Type = Monolithic";
}

std::string slidesAway(const ContactBodies& parts, const Vector& motion, const std::vector<std::string>& bodies, bool frictional,
                       double multiple) {
  constexpr double kNone = 1e-8;  // relative to a unit motion
  constexpr int kNamed = 20;
  int moving = 0;
  std::string text = std::string("no equilibrium was found: ") + (frictional ? "friction" : "contact") + " does not hold";
  for (std::size_t p = 0; p < parts.parts().size(); ++p) {
    const RigidPart& part = parts.parts()[p];
    if (part.free.cols() == 0) continue;
    const Vector own = parts.amplitudes(static_cast<int>(p), motion);
    if (own.norm() >= kNone && ++moving <= kNamed)
      text += " body '" + bodies.at(part.body) + "', which can " + inWords(part, own, parts.dimension()) + ",";
  }
  if (moving > kNamed) text += " and " + std::to_string(moving - kNamed) + " more bodies,";
  text.back() = text.back() == ',' ? ':' : text.back();
  if (!frictional)
    return text +
           " the loads push away from all pairs that could resist this motion. A prescribed displacement or an Elastic Support would "
           "hold it";
  std::ostringstream friction;
  friction.precision(3);
  friction << (multiple > 0.0 ? "At these loads, friction " : "More friction");
  if (multiple > 0.0) friction << multiple << " times as large";
  return text + " all pairs that resist this motion are at their friction limit. " + friction.str() +
         ", a prescribed displacement or an Elastic Support would hold it";
}

OuterResult solveInterface(const InterfaceProblem& problem, const Parameters& settings, Monitor& monitor, const InterfaceState* start,
                           const AutomaticTolerance::Estimate& discretisationError,
                           const std::function<void(const InterfaceState&)>& accepted, Teuchos::RCP<Preconditioner>* kept,
                           double leastTolerance) {
  const Parameters& own = settings.sublist("Outer Solver");
  OuterSettings outer;
  if (isAutomatic(settings)) {
    if (!discretisationError.of) throw InternalError("an automatic tolerance needs an error estimate");
    outer.discretisationError = discretisationError;
  } else {
    outer.tolerance = std::max(std::stod(own.get<std::string>("Tolerance")), leastTolerance);
  }
  outer.maximumIterations = own.get<int>("Maximum Iterations");
  outer.maximumInnerIterations = own.get<int>("Maximum Inner Iterations");
  outer.rigidStart = own.get<std::string>("Start") != "Bilateral";
  outer.preconditioner = [&settings, kept] {
    if (kept && !kept->is_null()) return *kept;
    const Teuchos::RCP<Preconditioner> made = makePreconditioner(settings.sublist("Preconditioner"));
    if (kept) *kept = made;
    return made;
  };
  outer.accepted = accepted;
  return makeStrategy<OuterSolver>(own, "Type")->solve(problem, outer, monitor, start);
}

Solution recover(const Comm& comm, const InterfaceProblem& problem, const OuterResult& result, const Subdomains& subdomains,
                 const Parameters& settings) {
  const AutomaticTolerance::Recovered before = result.recovered;
  const InterfaceProblem::Recovered recovered = before ? *before : problem.recover(result.state);
  Solution solution;
  static_cast<OuterFigures&>(solution) = result;
  solution.stopped = result.stopped && !result.converged;
  if (problem.pairs() > 0) solution.outerSolver = settings.sublist("Outer Solver").get<std::string>("Type");
  solution.energy = recovered.energy;
  for (std::size_t i = 0; i < subdomains.size(); ++i) solution.displacement.push_back(subdomains[i]->cartesian(recovered.freeValues[i]));

  std::vector<const SubdomainMesh*> meshes;
  for (const auto& subdomain : subdomains) meshes.push_back(&subdomain->mesh());
  solution.pairs = pairResults(comm, meshes, solution.displacement, recovered.pairs);
  return solution;
}

}  // namespace suture
