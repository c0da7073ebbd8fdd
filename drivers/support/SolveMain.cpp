// main of suture_solve, which is implemented in ../suture_solve.cpp.
#include "Plugins.hpp"
#include "Program.hpp"
#include "SolveAgain.hpp"
#include "SolveScene.hpp"
#include "TellingOverrides.hpp"

using namespace suture;

int main(int argc, char* argv[]) {
  SolveOptions options;
  if (const auto end = options.parse(argc, argv)) return *end;
  std::string subject = options.again.empty() ? options.scene : options.again;
  return runProgram("suture_solve", subject, [&](const CommPtr& comm) {
    if (!options.again.empty()) return solveAgain(comm, options, subject);
    loadPlugins(options.plugins);
    return tellingOverrides(options.overrides, [&] { return solveScene(comm, options).code; });
  });
}
