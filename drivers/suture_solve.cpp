// Solves a scene: elastic bodies in unilateral contact, by domain decomposition. One statement a stage, in the order of the packages.
// The program's main is in support/SolveMain.cpp: suture_study runs this function, too.
#include <Teuchos_ParameterList.hpp>

#include <suture/base/Timers.hpp>
#include <suture/elasticity/LockingNotes.hpp>
#include <suture/reference/MonolithicScene.hpp>
#include <suture/report/Figures.hpp>
#include <suture/solver/SolverSchema.hpp>

#include "support/Program.hpp"
#include "support/SolveStages.hpp"
#include "support/StopSignals.hpp"

namespace suture {

RunResult solveScene(const CommPtr& comm, const SolveOptions& options) {
  Timers timers;
  RunMonitor monitor(consoleOf(*comm, options.quiet), options.verbose, options.strict);
  listenForStop(monitor);
  const SceneFile file = timed(timers, "read", [&] { return readScene(*comm, options.scene, sceneSchema(), options.overrides); });
  if (options.printDefaults) return printDefaults(*comm, file);
  const Parameters& scene = *file.parameters;
  checkCombination(scene);
  const std::string folder = outputFolder(file);
  const auto output = options.check ? nullptr : std::make_unique<RunFolder>(*comm, folder);

  const bool whole = needsWholeMesh(scene);
  Mesh mesh = timed(timers, "read", [&] { return whole ? meshStage(*comm, file) : Mesh(); });
  Constraints constraints = timed(timers, "read", [&] { return whole ? constraintsStage(*comm, mesh, scene) : Constraints(); });
  CutMesh cut = timed(timers, "partition", [&] { return cutStage(*comm, file, mesh, constraints); });
  const ElasticModel model = makeElasticModel(scene);
  timed(timers, "partition", [&] {
    elementsStage(*comm, cut.meshes, model);
    if (whole) solvabilityStage(*comm, mesh, constraints, model, cut.partition);
  });
  checkExactSolution(*comm, cut.meshes, model, scene.sublist("Contact"));
  const double memory = checkMemory(*comm, cut.meshes, cut.whole.size.dofs, scene);
  const double liftWork = timed(timers, "partition", [&] { return takeOutLift(*comm, model, cut.meshes, constraints); });
  monitor.shiftEnergy(-liftWork);
  if (!isMonolithic(scene)) forget(mesh, constraints, cut.partition);
  auto subdomains = timed(timers, "assemble", [&] { return subdomainsStage(*comm, cut.meshes, model, scene); });
  auto problem = timed(timers, "factor", [&] { return problemStage(comm, cut.partition, subdomains, scene); });
  const ProblemSize size = withInterface(cut.whole.size, problem.get());
  printSizes(*comm, file, size, memory, options);
  for (const std::string& note : cut.partition.notes) monitor.note(note);
  for (const std::string& note : lockingNotes(model)) monitor.note(note);
  for (const std::string& note : looseTolerances(scene)) monitor.note(note);
  if (options.check) return {};
  const auto reference =
      timed(timers, "assemble", [&] { return isMonolithic(scene) ? assembleMonolithic(*comm, mesh, constraints, model) : nullptr; });
  const auto start = startStage(comm, options, problem.get(), cut.whole.hash, cut.meshes, subdomains, scene, monitor);
  const auto discretisationError = discretisationErrorOf(*comm, cut.meshes, model, subdomains);
  writeCheckpoints(comm, scene, folder, cut.whole.hash, cut.meshes, subdomains, problem.get(), monitor);
  Solution solution = timed(timers, "solve", [&] {
    if (!problem) return solveMonolithicScene(*comm, mesh, constraints, reference.get(), cut.meshes, scene, monitor);
    return recover(*comm, *problem, solveInterface(*problem, scene, monitor, start.get(), discretisationError), subdomains, scene);
  });
  if (solution.stopped) stopIsHeard();
  solution.energy -= liftWork;
  problem.reset();
  releaseFollowers(subdomains);
  timed(timers, "verify", [&] { neutralStage(*comm, cut.meshes, model, cut.whole.pieces, scene, solution, monitor); });
  errorStage(*comm, cut.meshes, model, scene, solution, timers);
  timed(timers, "verify", [&] { verifyStage(*comm, cut.meshes, model, cut.whole.pieces, subdomains, scene, solution); });
  subdomains.clear();
  giveBackFreedMemory();  // what is written needs it; the verdict works in it as it is

  for (const std::string& note : pressureNotes(*comm, cut.whole.pieces, solution)) monitor.note(note);
  for (const std::string& note : plausibilityNotes(*comm, cut.meshes, cut.whole.pieces, solution)) monitor.note(note);
  return reportStage(
      {*comm, file, model, cut.whole.pieces, cut.meshes, size, solution, monitor, timers, cut.whole.hash, options.commandLine, folder},
      options);
}

}  // namespace suture
