#include "PythonRun.hpp"

#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <iostream>
#include <suture/base/Collective.hpp>
#include <suture/report/SceneSchema.hpp>

namespace suture::python {

namespace {

SceneFile parsed(const std::string& text, const std::string& name, const std::string& folder, const std::vector<std::string>& overrides) {
  return parseScene(text, name, sceneSchema(), overrides, folder);
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
    parts_->scene = sceneOf(*parts_->comm, file);
  });
}

PythonRun::~PythonRun() {
  if (interpreterHasEnded()) static_cast<void>(parts_.release());
}

void PythonRun::doTogether(const std::function<void()>& way) {
  const ToPythonsOutput output;
  together(*parts_->comm, parts_->meeting, way);
}

void PythonRun::doCoupled(const std::function<void(CoupledScene&)>& way) {
  doTogether([&] {
    if (!parts_->coupled) parts_->coupled.emplace(RunContext(parts_->comm, parts_->monitor, parts_->timers), parts_->scene);
    way(*parts_->coupled);
  });
}

const CoupledScene& PythonRun::coupled() const {
  if (!parts_->coupled) throw InternalError("a coupled scene has at least one surface");
  return *parts_->coupled;
}

const Scene& PythonRun::scene() const {
  return parts_->judged ? parts_->judged->scene() : parts_->coupled ? parts_->coupled->scene() : parts_->scene;
}

const std::vector<SubdomainMesh>& PythonRun::meshes() const { return parts_->judged ? parts_->judged->meshes() : coupled().meshes(); }

const Solution& PythonRun::solution() const { return parts_->judged ? parts_->judged->solution() : coupled().solution(); }

ExitCode PythonRun::ending() const { return parts_->judged ? parts_->judged->ending() : coupled().ending(); }

std::string PythonRun::failure() const {
  if (isDone()) return "";
  if (!solution().failure.empty()) return solution().failure;
  if (!solution().undetermined.empty()) return solution().undetermined;
  return solution().stopped ? "stopped on request" : "the verdict does not hold";
}

void PythonRun::solve(const std::optional<std::string>& output, const std::string& restart) {
  doTogether([&] {
    RunContext run(parts_->comm, parts_->monitor, parts_->timers);
    if (output) run.writeInto(*output);
    PreparedScene prepared = prepare(check(cut(read(run, parts_->scene))));
    prepared.remark();
    prepared.startFrom(restart);
    parts_->judged = judge(suture::solve(std::move(prepared)));
    Invocation invocation;
    if (!restart.empty()) collectively(*parts_->comm, "reading " + restart, [&] { invocation.restart = usedFile(restart); });
    summary_ = output ? parts_->judged->report(invocation).summary : parts_->judged->summary(invocation);
  });
}

}  // namespace suture::python
