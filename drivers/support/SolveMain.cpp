// main of suture_solve; what it does is in ../suture_solve.cpp.
#include "Plugins.hpp"
#include "Program.hpp"
#include "SolveScene.hpp"
#include "TellingOverrides.hpp"

using namespace suture;

int main(int argc, char* argv[]) {
  SolveOptions options;
  if (const auto end = options.parse(argc, argv)) return *end;
  return runProgram("suture_solve", options.scene, [&](const CommPtr& comm) {
    loadPlugins(options.plugins);
    return tellingOverrides(options.overrides, [&] { return solveScene(comm, options).code; });
  });
}
