// Solves a scene: elastic bodies in unilateral contact, by domain decomposition. One statement per stage, in the order of the packages.
// The main function is in support/SolveMain.cpp, since suture_study also runs this function.
#include <Teuchos_Comm.hpp>
#include <suture/base/Timers.hpp>
#include <suture/report/OutputSchema.hpp>
#include <suture/report/SceneSchema.hpp>
#include <suture/simulation/Stages.hpp>

#include "support/Heartbeat.hpp"
#include "support/Print.hpp"
#include "support/Program.hpp"
#include "support/SceneDataFile.hpp"
#include "support/SceneDrawing.hpp"
#include "support/SolveAgain.hpp"
#include "support/SolveScene.hpp"
#include "support/StopSignals.hpp"

namespace suture {

RunResult solveScene(const CommPtr& comm, const SolveOptions& options) {
  Timers timers;
  RunMonitor monitor(consoleOf(*comm, options.quiet), options.verbose, options.strict);
  if (isTerminal()) monitor.useColours();
  const Heartbeat heartbeat(monitor.console());
  listenForStop(monitor);
  const SceneFile file = timed(timers, "read", [&] { return readScene(*comm, options.scene, sceneSchema(), options.overrides); });
  if (options.printDefaults) return printDefaults(*comm, file);
  sameScene(options, file, monitor);
  const Invocation invocation = options.invocation(*comm);
  RunContext run(comm, monitor, timers);
  Scene scene = sceneOf(*comm, file);
  if (!options.sceneData.empty()) return writeSceneDataFile(*comm, scene, options);
  if (!options.check) run.writeInto(outputFolder(file));
  MeshedScene meshed = read(run, std::move(scene));
  const SceneDrawing drawing(*comm, options, file, meshed.mesh());
  PartitionedScene partitioned = cut(std::move(meshed));
  sameMesh(*comm, options, partitioned);
  CheckedScene checked = check(std::move(partitioned));
  PreparedScene prepared = prepare(std::move(checked));
  printSizes(*comm, prepared, options);
  prepared.remark();
  if (options.check) {
    printChecked(*comm, prepared);
    drawing.draw(consoleOf(*comm, options.quiet));
    monitor.countWarnings();
    return {};
  }
  prepared.startFrom(options.restart);
  SolvedScene solved = solve(std::move(prepared));
  if (solved.solution().stopped) stopIsHeard();
  const JudgedScene judged = refine(judge(std::move(solved)));
  stopIsHeard();
  const RunResult result = judged.report(invocation);
  monitor.countWarnings();
  printFailure(*comm, judged, options);
  return result;
}

}  // namespace suture
