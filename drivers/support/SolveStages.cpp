#include "SolveStages.hpp"

#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/constraints/BuildConstraints.hpp>
#include <suture/mesh/MeshReader.hpp>
#include <suture/mesh/Regions.hpp>
#include <suture/quality/Verify.hpp>
#include <suture/report/Checkpoint.hpp>
#include <suture/report/Units.hpp>
#include <suture/solver/solvability/NeutralMotions.hpp>
#include <suture/solver/solvability/Solvability.hpp>

#include "NestedLevels.hpp"
#include "Program.hpp"
#include "StopSignals.hpp"

namespace suture {

RunResult printDefaults(const Comm& comm, const SceneFile& file) {
  if (std::ostream* out = consoleOf(comm, false)) *out << toXml(*file.parameters) << std::flush;
  return {};
}

Mesh meshStage(const Comm& comm, const SceneFile& file) {
  Mesh mesh = readMesh(comm, file.parameters->sublist("Mesh"), file.folder);
  collectivelyOnRoot(comm, "checking the mesh", [&] {
    const Parameters& bodies = file.parameters->sublist("Bodies");
    assignBodies(mesh, sublistNames(bodies));
    assignRegions(mesh, bodies);
    if (isAxisymmetric(*file.parameters)) makeAxisymmetric(mesh);
  });
  return mesh;
}

Constraints constraintsStage(const Comm& comm, const Mesh& mesh, const Parameters& scene) {
  return onRoot(comm, "building the constraints", [&] {
    const ElasticModel model = makeElasticModel(scene);
    const auto compliance = [&](int element) {
      return contactCompliance(model.materialOf(mesh, element, mesh.bodyOfElement[element]), model.plane);
    };
    return buildConstraints(mesh, scene.sublist("Boundary Conditions"), scene.sublist("Contact"), sceneConstants(scene),
                            {compliance, unitsOf(scene).length});
  });
}

void elementsStage(const Comm& comm, const Mesh& mesh, const ElasticModel& model) {
  collectivelyOnRoot(comm, "checking the elements", [&] {
    Problems problems;
    checkElements(
        mesh, [&](int element) { return mesh.bodyOfElement[element]; }, model, problems);
    problems.throwIfAny();
  });
}

void elementsStage(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model) {
  collectively(comm, "checking the elements", [&] {
    Problems problems;
    for (const SubdomainMesh& mesh : meshes)
      checkElements(
          mesh, [&](int) { return mesh.body; }, model, problems);
    problems.throwIfAny();
  });
}

void solvabilityStage(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const ElasticModel& model,
                      const Partition& partition) {
  collectivelyOnRoot(comm, "checking that the scene has a solution",
                     [&] { checkSolvability(mesh, constraints, model, partition.bodiesAreConnected); });
}

namespace {

bool isCut(const Parameters& scene) { return scene.sublist("Partition").get<std::string>("Type") == kPartitionedMesh; }

bool mayBeMortar(const Parameters& contact) {
  const std::vector<std::string> lines = sublistNames(contact);
  return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
    const Parameters& own = contact.sublist(line);
    return own.isParameter("Side B") && own.get<std::string>("Coupling") != "Matching Nodes";
  });
}

MadeFor madeFor(const Parameters& scene) {
  MadeFor lists;
  for (const char* name : {"Bodies", "Boundary Conditions", "Constants", "Contact", "Functions"}) lists[name] = toXml(scene.sublist(name));
  lists["Model"] = isAxisymmetric(scene) ? "axisymmetric" : "plane";
  // The gap between curved sides depends on which of the bodies gives way more.
  if (mayBeMortar(scene.sublist("Contact"))) {
    lists["Materials"] = toXml(scene.sublist("Materials"));
    lists["Model"] = scene.get<std::string>("Model");
  }
  return lists;
}

}  // namespace

Whole wholeStage(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const Partition& partition) {
  return {problemSize(comm, mesh, constraints, partition), constraints.pieces,
          onRoot(comm, "hashing the mesh", [&] { return mesh.hash(); })};
}

namespace {

std::string bytesOf(const Whole& whole) {
  Packer packer;
  packer.put(whole.size);
  packer.put(whole.hash);
  packer.put(whole.pieces);
  return std::move(packer).bytes();
}

Whole wholeFrom(const std::string& bytes) {
  Unpacker unpacker(bytes);
  Whole whole;
  unpacker.get(whole.size);
  unpacker.get(whole.hash);
  unpacker.get(whole.pieces);
  return whole;
}

}  // namespace

bool needsWholeMesh(const Parameters& scene) { return !isCut(scene) || isMonolithic(scene); }

CutMesh cutStage(const Comm& comm, const SceneFile& file, const Mesh& mesh, const Constraints& constraints) {
  const Parameters& scene = *file.parameters;
  CutMesh cut;
  if (!isCut(scene)) {
    cut.partition = makePartition(comm, mesh, constraints, scene.sublist("Partition"), isCondensed(scene));
    cut.meshes = distribute(comm, mesh, constraints, cut.partition);
    cut.partition.share.reset();  // nothing else needs it
    cut.whole = wholeStage(comm, mesh, constraints, cut.partition);
    return cut;
  }
  const std::string path = meshFile(scene.sublist("Mesh"), file.folder);
  if (path.empty())
    throw InputError(pathOf(scene.sublist("Partition"), "Type"),
                     std::string(kPartitionedMesh) + " needs a Mesh/File of suture_partition; this scene generates its mesh");
  PartitionedMesh read = readPartitionedMesh(comm, path, madeFor(scene), isCondensed(scene));
  cut.partition = std::move(read.partition);
  cut.meshes = std::move(read.mine);
  cut.whole = wholeFrom(read.remarks);
  return cut;
}

void addCut(Hdf5File& file, const Mesh& mesh, const Constraints& constraints, const Partition& partition, const Whole& whole,
            const Parameters& scene) {
  addPartition(file, mesh, constraints, partition, madeFor(scene), bytesOf(whole));
}

void forget(Mesh& mesh, Constraints& constraints, Partition& partition) {
  mesh = Mesh();
  constraints = Constraints();
  partition.subdomainOfElement = std::vector<int>();
  giveBackFreedMemory();
}

Subdomains subdomainsStage(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const Parameters& scene) {
  if (!isMonolithic(scene)) return makeSubdomains(comm, meshes, model, scene);
  checkPhysics(comm, meshes, model, scene);
  return {};
}

std::unique_ptr<InterfaceProblem> problemStage(const CommPtr& comm, const Partition& partition, const Subdomains& subdomains,
                                               const Parameters& scene) {
  return isMonolithic(scene) ? nullptr : makeInterfaceProblem(comm, partition, subdomains, scene);
}

std::unique_ptr<InterfaceState> startStage(const CommPtr& comm, const SolveOptions& options, const InterfaceProblem* problem,
                                           const std::string& meshHash, const std::vector<SubdomainMesh>& meshes,
                                           const Subdomains& subdomains, const Parameters& scene, Monitor& monitor) {
  if (options.restart.empty()) return problem ? nestedStartStage(comm, options, scene, *problem, subdomains, monitor) : nullptr;
  const Checkpoint checkpoint = readCheckpoint(*comm, options.restart, meshHash, meshes);
  if (!problem) return nullptr;  // Monolithic solves the scene at once
  std::vector<Vector> freeValues;
  for (std::size_t i = 0; i < subdomains.size(); ++i) freeValues.push_back(subdomains[i]->freeValues(checkpoint.displacement[i]));
  return std::make_unique<InterfaceState>(problem->stateOf(freeValues, checkpoint.status));
}

namespace {
bool wantsErrorEstimate(const Parameters& scene) { return scene.sublist("Output").get<bool>("Error Estimate") || isAutomatic(scene); }
}  // namespace

void errorStage(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const Parameters& scene,
                Solution& solution, Timers& timers) {
  if (!model.exact.empty())
    solution.errors = timed(timers, "errors", [&] {
      return exactErrors(comm, meshes, model, scene.sublist("Contact"), solution.displacement, solution.pairs);
    });
  if (wantsErrorEstimate(scene) && !solution.discretisation)
    solution.discretisation = timed(timers, "estimate", [&] { return estimateError(comm, meshes, model, solution.displacement); });
}

void neutralStage(const Comm& comm, std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const std::vector<ContactPiece>& pieces,
                  const Parameters& scene, Solution& solution, Monitor& monitor) {
  if (solution.converged) settleNeutralMotions(comm, meshes, model, solution);
  if (comm.getRank() == 0) solution.onAxis = axisResults(pieces, solution.pairs);
  for (const NeutralMotion& motion : solution.neutral) monitor.note(inWords(motion));
  if (scene.sublist("Outer Solver").get<std::string>("Neutral Motions") != "Least") solution.undetermined = undetermined(solution.neutral);
  if (!solution.undetermined.empty()) solution.failure = solution.undetermined;
}

void verifyStage(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                 const std::vector<ContactPiece>& pieces, const Subdomains& subdomains, const Parameters& scene, Solution& solution) {
  const auto own = [&](int mesh) -> std::optional<OwnForces> {
    if (subdomains.empty() || !subdomains[mesh]) return std::nullopt;
    return OwnForces{subdomains[mesh]->internalForces(solution.displacement[mesh]), subdomains[mesh]->nodalLoads()};
  };
  const double tolerance = requestedAccuracy(scene, solution);
  solution.verification = verify(comm, {meshes, model, solution.displacement, solution.pairs, pieces, tolerance, own});
  collectively(comm, "finding the stresses", [&] {
    for (std::size_t i = 0; i < subdomains.size(); ++i)
      if (subdomains[i]) solution.ownStresses[static_cast<int>(i)] = subdomains[i]->stresses(solution.displacement[i]);
  });
  if (solution.converged && !solution.verification.holds())
    solution.failure = "the verdict does not hold: " + solution.verification.failure();
}

namespace {
std::string checkpointPath(const std::string& folder) { return (std::filesystem::path(folder) / "checkpoint.h5").string(); }
}  // namespace

bool writeCheckpoints(const CommPtr& comm, const Parameters& scene, const std::string& folder, const std::string& meshHash,
                      const std::vector<SubdomainMesh>& meshes, const Subdomains& subdomains, const InterfaceProblem* problem,
                      RunMonitor& monitor) {
  const double every = 60.0 * scene.sublist("Output").get<double>("Checkpoint Every");
  if (every <= 0.0 || !problem) return false;
  const auto last = std::make_shared<double>(Timers::now());
  monitor.takeStates([=, &scene, &meshes, &subdomains](const InterfaceState& state) {
    int due = comm->getRank() == 0 && Timers::now() - *last >= every;
    broadcastBytes(*comm, &due, sizeof due);
    if (due == 0) return;
    OuterResult result;
    result.state = state;
    writeCheckpoint(*comm, checkpointPath(folder), meshHash, meshes, recover(*comm, *problem, result, subdomains, scene));
    *last = Timers::now();
  });
  return true;
}

void printSizes(const Comm& comm, const SceneFile& file, const ProblemSize& size, double memory, const SolveOptions& options) {
  std::ostream* console = consoleOf(comm, options.quiet && !options.check);
  if (!console) return;
  printHeader(*console, comm, file, size);
  if (options.check)
    *console << "   about " << static_cast<long>(std::ceil(memory)) << " MB of memory for a run\n"
             << "   nothing wrong was found; nothing was solved (--check)" << std::endl;
}

RunResult reportStage(const Run& run, const SolveOptions& options) {
  const bool done = run.solution.converged && run.solution.undetermined.empty() && run.solution.verification.holds();
  const ExitCode code = done ? ExitCode::Done : run.solution.stopped ? ExitCode::Stopped : ExitCode::Numerical;
  stopIsHeard();
  const Parameters& output = run.scene.parameters->sublist("Output");
  // First: who asked for the stop may not wait for the rest.
  if (code != ExitCode::Done || output.get<bool>("Checkpoint"))
    writeCheckpoint(run.comm, checkpointPath(run.folder), run.meshHash, run.subdomains, run.solution);
  const Written written = writeReport(run, code);
  if (code == ExitCode::Done && !output.get<bool>("Checkpoint") && output.get<double>("Checkpoint Every") > 0.0 &&
      run.comm.getRank() == 0) {
    std::error_code ignored;
    std::filesystem::remove(checkpointPath(run.folder), ignored);
  }
  if (std::ostream* console = consoleOf(run.comm, options.quiet)) printFooter(*console, run, written.figures);
  // With --quiet the exit code would be all that tells.
  if (code != ExitCode::Done && options.quiet && run.comm.getRank() == 0)
    std::cerr << "suture_solve: " << (run.solution.converged ? "" : "not converged: ") << run.solution.failure << std::endl;
  return {code, run.solution.failure, written.summary};
}

}  // namespace suture
