// Solves a scene: elastic bodies in unilateral contact, by domain decomposition. One statement per stage, in the order of the packages.
// The main function is in support/SolveMain.cpp, since suture_study also runs this function.
#include <Teuchos_Comm.hpp>
#include <suture/base/Timers.hpp>
#include <suture/report/OutputSchema.hpp>
#include <suture/report/SceneSchema.hpp>
#include <suture/simulation/Simulation.hpp>

#include "support/Heartbeat.hpp"
#include "support/Print.hpp"
#include "support/Program.hpp"
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
  Simulation simulation(comm, sceneOf(*comm, file), monitor, timers);
  if (!options.check) simulation.writeInto(outputFolder(file));
  simulation.read();
  simulation.cut();
  sameMesh(*comm, options, simulation);
  simulation.check();
  simulation.prepare();
  printSizes(*comm, simulation, options);
  simulation.remark();
  if (options.check) {
    printChecked(*comm, simulation);
    monitor.countWarnings();
    return {};
  }
  simulation.start(options.restart);
  simulation.iterate();
  if (simulation.solution().stopped) stopIsHeard();
  simulation.judge();
  stopIsHeard();
  const RunResult result = simulation.report(invocation);
  monitor.countWarnings();
  printFailure(*comm, simulation, options);
  return result;
}

}  // namespace suture
