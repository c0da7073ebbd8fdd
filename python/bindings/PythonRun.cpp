#include "PythonRun.hpp"

#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <iostream>
#include <suture/base/Collective.hpp>
#include <suture/report/SceneSchema.hpp>

namespace suture::python {

namespace {

SceneFile parsed(const std::string& text, const std::string& name, const std::string& folder, const std::vector<std::string>& overrides) {
  SceneFile file = parseScene(text, name, sceneSchema(), overrides);
  file.folder = folder;
  return file;
}

}  // namespace

PythonRun::Parts::Parts(const CommPtr& ranks, bool shows)
    : comm(ranks), meeting(*ranks), monitor(shows && ranks->getRank() == 0 ? &std::cout : nullptr, false) {
  monitor.stopWhen(endIsWanted);  // Ctrl-C ends a run after the current iteration
}

PythonRun::PythonRun(const py::object& comm, const std::string& text, const std::string& name, const std::string& folder,
                     const std::vector<std::string>& overrides, bool shows)
    : held_(comm), parts_(std::make_unique<Parts>(commOf(comm), shows)) {
  together(*parts_->comm, parts_->meeting, [&] {
    SceneFile file;
    collectively(*parts_->comm, "reading the scene", [&] { file = parsed(text, name, folder, overrides); });
    parts_->simulation = std::make_unique<Simulation>(parts_->comm, sceneOf(*parts_->comm, file), parts_->monitor, parts_->timers);
  });
}

PythonRun::~PythonRun() {
  if (interpreterHasEnded()) static_cast<void>(parts_.release());
}

void PythonRun::doTogether(const std::function<void(Simulation&)>& way) {
  const ToPythonsOutput output;
  together(*parts_->comm, parts_->meeting, [&] { way(*parts_->simulation); });
}

std::string PythonRun::failure() const {
  const Solution& solution = simulation().solution();
  if (isDone()) return "";
  if (!solution.failure.empty()) return solution.failure;
  if (!solution.undetermined.empty()) return solution.undetermined;
  return solution.stopped ? "stopped on request" : "the verdict does not hold";
}

void PythonRun::solve(const std::optional<std::string>& output, const std::string& restart) {
  doTogether([&](Simulation& simulation) {
    if (output) simulation.writeInto(*output);
    simulation.read();
    simulation.cut();
    simulation.check();
    simulation.prepare();
    simulation.remark();
    simulation.start(restart);
    simulation.iterate();
    simulation.judge();
    Invocation invocation;
    if (!restart.empty()) collectively(*parts_->comm, "reading " + restart, [&] { invocation.restart = usedFile(restart); });
    summary_ = output ? simulation.report(invocation).summary : simulation.summary(invocation);
  });
}

void PythonRun::solveAgain(bool verified) {
  doTogether([&](Simulation& simulation) { simulation.solveAgain(verified); });
}

}  // namespace suture::python
