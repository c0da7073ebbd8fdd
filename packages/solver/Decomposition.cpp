#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/contact/GroupMemory.hpp>
#include <suture/elasticity/SubdomainLoads.hpp>
#include <suture/interface/CondensedProblem.hpp>
#include <suture/interface/ContactInterfaceProblem.hpp>
#include <suture/partition/RigidLift.hpp>
#include <suture/solver/Decomposition.hpp>
#include <suture/solver/SolverSchema.hpp>
#include <suture/solver/solvability/CarriedBodies.hpp>
#include <suture/subdomain/ElasticSubdomain.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>

namespace suture {

double takeOutLift(const Comm& comm, const ElasticModel& model, std::vector<SubdomainMesh>& meshes, Constraints& constraints) {
  if (!prescribesMotion(comm, meshes) && !hasGaps(comm, meshes)) return 0.0;
  const auto carry = [&](const BodyParts& parts) { return carriedMotions(comm, meshes, model, parts); };
  if (!takeOutRigidMotions(comm, meshes, carry)) return 0.0;
  int has = !constraints.rules.empty();
  Teuchos::broadcast(comm, 0, 1, &has);
  if (has) takeOver(comm, meshes, constraints);
  double work = 0.0, all = 0.0;
  for (const SubdomainMesh& mesh : meshes) work += subdomainLoads(mesh, model).dot(mesh.lift.motion);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, work, Teuchos::outArg(all));
  return all;
}

Subdomains makeSubdomains(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model) {
  Subdomains subdomains;
  collectively(comm, "assembling the subdomains", [&] {
    for (const SubdomainMesh& mesh : meshes) {
      subdomains.push_back(std::make_unique<ElasticSubdomain>(mesh, model));
      subdomains.back()->assemble();
    }
  });
  return subdomains;
}

namespace {

Subdomains namedSubdomains(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const Parameters& scene) {
  Subdomains subdomains;
  std::vector<int> own;  // bodies of this rank with physics of their own
  collectively(comm, "making the subdomains", [&] {
    for (const SubdomainMesh& mesh : meshes) {
      const Parameters& body = scene.sublist("Bodies").sublist(model.bodies[mesh.body]);
      subdomains.push_back(makeStrategy<Subdomain>(body, "Subdomain", mesh, model));
      if (!subdomains.back()->followsModel()) own.push_back(mesh.body);
    }
  });
  const bool needsLaw =
      isMonolithic(scene) || !model.exact.empty() || scene.sublist("Output").get<bool>("Error Estimate") || isAutomatic(scene);
  if (!needsLaw) return subdomains;
  Problems problems;
  for (const int number : unionOverRanks(comm, own)) {
    const Parameters& body = scene.sublist("Bodies").sublist(model.bodies[number]);
    problems.add(
        pathOf(body, "Subdomain"),
        "'" + body.get<std::string>("Subdomain") +
            "' has physics of its own, but the scene asks for what needs the law of a material at every point: the outer solver "
            "Monolithic, an Exact Solution, Output/Error Estimate or the tolerance Automatic. A law of your own (Materials/<name>/Type) "
            "goes with all of them");
  }
  problems.throwIfAny();
  return subdomains;
}

}  // namespace

Subdomains makeSubdomains(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const Parameters& scene) {
  Subdomains subdomains = namedSubdomains(comm, meshes, model, scene);
  collectively(comm, "assembling the subdomains", [&] {
    for (const auto& subdomain : subdomains) subdomain->assemble();
  });
  return subdomains;
}

void checkPhysics(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const Parameters& scene) {
  namedSubdomains(comm, meshes, model, scene);
}

void releaseFollowers(Subdomains& subdomains) {
  for (auto& subdomain : subdomains)
    if (subdomain->followsModel()) subdomain.reset();
}

bool isCondensed(const Parameters& scene) { return scene.get<std::string>("Formulation") == kCondensedGroups; }

bool isAutomatic(const Parameters& scene) { return scene.sublist("Outer Solver").get<std::string>("Tolerance") == "Automatic"; }

double requestedAccuracy(const Parameters& scene, const Solution& solution) {
  if (!isAutomatic(scene)) return std::stod(scene.sublist("Outer Solver").get<std::string>("Tolerance"));
  return solution.discretisation ? 0.1 * solution.discretisation->relative() : 1e-8;
}

AutomaticTolerance::Estimate discretisationErrorOf(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                                   const Subdomains& subdomains) {
  double unknowns = 0.0, all = 0.0;
  int order = 1, highest = 1;
  for (const auto& subdomain : subdomains) unknowns += subdomain->dofs();
  for (const SubdomainMesh& mesh : meshes)
    for (const Cell cell : mesh.cells) order = std::max(order, static_cast<int>(cellInfo(cell).sideNodes.front().size()) - 1);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, unknowns, Teuchos::outArg(all));
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, order, Teuchos::outArg(highest));
  const auto of = [&](const std::vector<Vector>& freeValues) {
    std::vector<Vector> displacement;
    for (std::size_t i = 0; i < subdomains.size(); ++i) displacement.push_back(subdomains[i]->cartesian(freeValues[i]));
    return estimateError(comm, meshes, model, displacement);
  };
  const double nodes = std::max(0.5 * all, 1.0);
  return {of, highest == 1 ? 3.0 / std::sqrt(nodes) : 1.5 / nodes};
}

bool isMonolithic(const Parameters& scene) { return scene.sublist("Outer Solver").get<std::string>("Type") == kMonolithic; }

namespace {

// Sets of closed pairs decide about normals alone: nobody would decide which pairs of such a law stick.
void checkLaws(const Parameters& contact) {
  Problems problems;
  const ContactLaws laws(contact);
  const std::vector<std::string> names = sublistNames(contact);
  for (int line = 0; line < laws.size(); ++line)
    if (laws.of(line).rows(2) > 1) {
      const Parameters& own = contact.sublist(names[line]);
      problems.add(pathOf(own, "Law"), "'" + own.get<std::string>("Law") + "' restricts sliding, which no outer solver looks for; " +
                                           "expected a law of the normal direction, as " + Frictionless::kName);
    }
  problems.throwIfAny();
}

}  // namespace

void checkCombination(const Parameters& scene) {
  checkLaws(scene.sublist("Contact"));
  const auto formulation = scene.get<std::string>("Formulation");
  const auto method = scene.sublist("Outer Solver").get<std::string>("Type");
  if (scene.sublist("Contact").numParams() == 0 || solvesFormulation(method, formulation)) return;
  std::vector<std::string> fitting;
  for (const std::string& name : Registry<OuterSolver>::instance().names())
    if (solvesFormulation(name, formulation)) fitting.push_back(name);
  fitting.push_back(kMonolithic);
  std::string list;
  for (const std::string& name : fitting) list += (list.empty() ? "" : ", ") + name;
  throw InputError(pathOf(scene.sublist("Outer Solver"), "Type"),
                   "'" + method + "' does not solve the formulation '" + formulation + "'. Those that do: " + list +
                       ". Or choose the Formulation '" + (isCondensed(scene) ? kContactOnTheInterface : kCondensedGroups) + "'");
}

namespace {

/// Groups do not spread over ranks: one that cannot fit is refused before hours are spent on it, or the machine.
void checkGroupMemory(const Comm& comm, const Partition& partition, const Subdomains& subdomains, const Parameters& own) {
  const auto limit = own.get<double>("Memory Limit");
  collectively(comm, "measuring the contact groups", [&] {
    std::map<int, std::vector<const Subdomain*>> membersOf;
    for (const auto& subdomain : subdomains)
      if (const int group = partition.groupOf[subdomain->mesh().id]; group >= 0) membersOf[group].push_back(subdomain.get());
    Problems problems;
    for (const auto& [group, members] : membersOf) {
      const GroupMemory memory = groupMemory(members);
      if (memory.megabytes() <= limit) continue;
      std::ostringstream text;
      text << "contact group " << group + 1 << " of " << members.size() << " subdomains ('" << members.front()->mesh().name
           << "', ...) has " << memory.unknowns << " unknowns and " << memory.rows
           << " pairs; factoring it, on one rank, is estimated to take " << std::fixed << std::setprecision(memory.megabytes() < 10 ? 2 : 0)
           << memory.megabytes() << " MB, more than the limit of " << std::defaultfloat << std::setprecision(6) << limit
           << " MB. Raise the limit if the rank has the memory, or choose Formulation '" << kContactOnTheInterface
           << "', which needs no group on one rank";
      problems.add(pathOf(own, "Memory Limit"), text.str());
    }
    problems.throwIfAny();
  });
}

}  // namespace

namespace {

/// "; pairs 3, 4 of contact 'joint' (bodies 'upper', 'lower') still change: ...".
std::string unsettled(const ContactSets& sets, const std::vector<int>& pairs, const Parameters& scene) {
  constexpr std::size_t kMost = 10;
  const RigidContact::Pairs& data = sets.bodies().rigid().data();
  const std::vector<std::string> contacts = sublistNames(scene.sublist("Contact")), bodies = sublistNames(scene.sublist("Bodies"));
  std::map<int, std::vector<int>> byLine;
  for (const int pair : pairs) byLine[data.line[pair]].push_back(pair);
  std::string text;
  for (const auto& [line, own] : byLine) {
    std::set<std::string> names;
    text += "; pairs ";
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (k < kMost) text += (k > 0 ? ", " : "") + std::to_string(own[k]);
      for (const int part : data.bodies[own[k]]) names.insert("'" + bodies.at(sets.bodies().parts()[part].body) + "'");
    }
    if (own.size() > kMost) text += " and " + std::to_string(own.size() - kMost) + " more";
    text += " of contact '" + contacts.at(line) + "' (";
    for (const std::string& name : names) text += (name == *names.begin() ? "" : ", ") + name;
    text += ")";
  }
  return text +
         " still open and close from step to step; more Outer Solver/Maximum Iterations, or Outer Solver/Type = Monolithic, may settle "
         "them";
}

}  // namespace

std::unique_ptr<InterfaceProblem> makeInterfaceProblem(const CommPtr& comm, const Partition& partition, const Subdomains& subdomains,
                                                       const Parameters& scene) {
  const Parameters& own = scene.sublist("Subdomain");
  const auto schur = [&own] { return makeStrategy<SchurComplement>(own, "Schur Complement"); };
  const ContactLaws laws = scene.isSublist("Contact") ? ContactLaws(scene.sublist("Contact")) : ContactLaws();
  if (isCondensed(scene)) {
    checkGroupMemory(*comm, partition, subdomains, scene.sublist(kCondensedGroups));
    return std::make_unique<CondensedProblem>(comm, partition, subdomains, localSolverMaker(own), schur, laws);
  }
  return std::make_unique<ContactInterfaceProblem>(comm, partition, subdomains, localSolverMaker(own), schur, laws);
}

OuterResult solveInterface(const InterfaceProblem& problem, const Parameters& scene, Monitor& monitor, const InterfaceState* start,
                           const AutomaticTolerance::Estimate& discretisationError) {
  const Parameters& own = scene.sublist("Outer Solver");
  OuterSettings settings;
  if (isAutomatic(scene)) {
    if (!discretisationError.of) throw InternalError("an automatic tolerance without an estimate of the error");
    settings.discretisationError = discretisationError;
  } else {
    settings.tolerance = std::stod(own.get<std::string>("Tolerance"));
  }
  settings.maximumIterations = own.get<int>("Maximum Iterations");
  settings.maximumInnerIterations = own.get<int>("Maximum Inner Iterations");
  settings.rigidStart = own.get<std::string>("Start") != "Bilateral";
  settings.preconditioner = [&scene] { return makePreconditioner(scene.sublist("Preconditioner")); };
  OuterResult result = makeStrategy<OuterSolver>(own, "Type")->solve(problem, settings, monitor, start);
  if (!result.converged && !result.unsettled.empty()) result.failure += unsettled(*problem.sets(), result.unsettled, scene);
  return result;
}

Solution recover(const Comm& comm, const InterfaceProblem& problem, const OuterResult& result, const Subdomains& subdomains,
                 const Parameters& scene) {
  const AutomaticTolerance::Recovered before = result.recovered;
  const InterfaceProblem::Recovered recovered = before ? *before : problem.recover(result.state);
  Solution solution;
  solution.converged = result.converged;
  solution.stopped = result.stopped && !result.converged;
  solution.failure = result.failure;
  if (problem.pairs() > 0) solution.outerSolver = scene.sublist("Outer Solver").get<std::string>("Type");
  solution.outerIterations = result.iterations;
  solution.pcgTotal = result.pcgTotal;
  solution.residual = result.residual;
  solution.energyError = result.energyError;
  solution.discretisation = result.discretisation;
  solution.auxiliary = result.auxiliary;
  solution.estimates = result.estimates;
  solution.coarseSize = result.coarseSize;
  solution.setupSeconds = result.setupSeconds;
  solution.bytesRead = result.bytesRead;
  solution.chosenSchur = result.chosenSchur;
  solution.energy = recovered.energy;
  for (std::size_t i = 0; i < subdomains.size(); ++i) solution.displacement.push_back(subdomains[i]->cartesian(recovered.freeValues[i]));

  std::vector<const SubdomainMesh*> meshes;
  for (const auto& subdomain : subdomains) meshes.push_back(&subdomain->mesh());
  solution.pairs = pairResults(comm, meshes, solution.displacement, recovered.pairs);
  return solution;
}

ProblemSize problemSize(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const Partition& partition) {
  GlobalId sizes[5] = {0, 0, 0, 0, 0};
  if (comm.getRank() == 0) {
    sizes[0] = mesh.nodes();
    sizes[1] = mesh.elements();
    sizes[2] = sizes[0] * mesh.dimension;
    for (const NodeRule& rule : constraints.rules) sizes[2] -= std::count(rule.fixed.begin(), rule.fixed.begin() + mesh.dimension, true);
    sizes[3] = static_cast<GlobalId>(constraints.pairs.size());
    sizes[4] = static_cast<GlobalId>(constraints.pieces.size());
  }
  Teuchos::broadcast(comm, 0, 5, sizes);
  ProblemSize size;
  size.nodes = sizes[0];
  size.elements = sizes[1];
  size.dofs = sizes[2];
  size.pairs = static_cast<int>(sizes[3]);
  size.pieces = static_cast<int>(sizes[4]);
  size.subdomains = partition.subdomains();
  size.groups = static_cast<int>(partition.groups.size());
  return size;
}

ProblemSize withInterface(ProblemSize size, const InterfaceProblem* problem) {
  size.interfaceDofs = problem ? problem->space()->size() : 0;
  return size;
}

}  // namespace suture
