#include "PythonRun.hpp"

#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <iostream>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/reader/MeshArrays.hpp>
#include <suture/reader/MeshReader.hpp>
#include <suture/report/SceneSchema.hpp>
#include <suture/simulation/JudgeStage.hpp>

namespace suture::python {

namespace {

SceneFile parsed(const std::string& text, const std::string& name, const std::string& folder, const std::vector<std::string>& overrides) {
  return parseScene(text, name, sceneSchema(), overrides, folder);
}

std::vector<MeshArrays::Group> groupsOf(const py::dict& groups, const std::string& place) {
  std::vector<MeshArrays::Group> all;
  for (const auto& [name, numbers] : groups) {
    const auto values = numbers.cast<py::array_t<int, py::array::c_style | py::array::forcecast>>();
    all.push_back({place + "/" + std::string(py::str(name)), std::string(py::str(name)), {values.data(), values.data() + values.size()}});
  }
  return all;
}

template <typename T>
std::vector<T> valuesOf(const py::object& values) {
  const auto all = values.cast<py::array_t<T, py::array::c_style | py::array::forcecast>>();
  return {all.data(), all.data() + all.size()};
}

/// The arrays of a suture.Mesh on rank 0. Collective. \throws InputError  rank 0 has no mesh
std::shared_ptr<const MeshArrays> arraysOf(const Comm& comm, const py::object& mesh) {
  auto arrays = std::make_shared<MeshArrays>();
  collectivelyOnRoot(comm, "taking the mesh", [&] {
    if (mesh.is_none()) throw InputError("Mesh", "Generator is Given, but the scene has no suture.Mesh");
    arrays->dimension = {mesh.attr("dimension").cast<int>()};
    arrays->coordinates = valuesOf<double>(mesh.attr("points"));
    arrays->cells = valuesOf<int>(mesh.attr("cells"));
    arrays->offsets = valuesOf<int>(mesh.attr("offsets"));
    arrays->connectivity = valuesOf<int>(mesh.attr("connectivity"));
    arrays->elementGroups = groupsOf(mesh.attr("groups"), "groups");
    arrays->sideGroups = groupsOf(mesh.attr("side_groups"), "side_groups");
  });
  return arrays;
}

}  // namespace

PythonRun::Parts::Parts(const CommPtr& ranks, bool shows)
    : comm(ranks), meeting(*ranks), monitor(shows && ranks->getRank() == 0 ? &std::cout : nullptr, false) {
  monitor.stopWhen(endIsWanted);  // Ctrl-C ends a run after the current iteration
}

PythonRun::PythonRun(const py::object& comm, const std::string& text, const std::string& name, const std::string& folder,
                     const std::vector<std::string>& overrides, bool shows, const py::object& mesh)
    : held_(comm), parts_(std::make_unique<Parts>(commOf(comm), shows)) {
  together(*parts_->comm, parts_->meeting, [&] {
    SceneFile file;
    collectively(*parts_->comm, "reading the scene", [&] { file = parsed(text, name, folder, overrides); });
    parts_->scene = sceneOf(*parts_->comm, file);
    if (parts_->scene.settings().sublist("Mesh").get<std::string>("Generator") == kGivenMesh)
      parts_->scene.mesh = [arrays = arraysOf(*parts_->comm, mesh)](const Comm& comm) {
        return onRoot(comm, "making the mesh", [&] { return meshFromArrays(*arrays, "Mesh", "(arrays of the script)"); });
      };
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
    parts_->nodal.reset();
    way(*parts_->coupled);
  });
}

const JudgedScene& PythonRun::judged() const {
  if (!parts_->judged) throw InternalError("a coupled scene has neither probes nor files");
  return *parts_->judged;
}

void PythonRun::writeTo(const std::string& folder) {
  doTogether([&] { judged().writeTo(folder); });
}

const std::vector<Matrix>& PythonRun::nodalStresses() {
  if (!parts_->nodal)
    doTogether([&] {
      parts_->nodal =
          parts_->judged ? parts_->judged->nodalStresses() : recoveredStresses(*parts_->comm, meshes(), scene().model, solution());
    });
  return *parts_->nodal;
}

std::vector<std::pair<Probe, std::vector<ProbeValue>>> PythonRun::probes() {
  std::vector<std::pair<Probe, std::vector<ProbeValue>>> all;
  doTogether([&] {
    const std::vector<Probe> probes = judged().probes();
    std::vector<std::vector<ProbeValue>> values = judged().valuesAt(probes, judged().solution().nodalStresses);
    for (std::size_t i = 0; i < probes.size(); ++i) all.emplace_back(probes[i], std::move(values[i]));
  });
  return all;
}

std::vector<ProbeValue> PythonRun::valuesAt(const Matrix& points, const std::string& body) {
  const std::vector<Matrix>& nodal = nodalStresses();
  std::vector<ProbeValue> values;
  doTogether([&] {
    const ElasticModel& model = scene().model;
    Probe probe;
    probe.name = probe.path = "probe()";
    probe.dimension = model.dimension;
    SoughtPoint sought;
    if (!body.empty()) {
      const auto found = std::find(model.bodies.begin(), model.bodies.end(), body);
      if (found == model.bodies.end()) throw InputError(probe.path, unknownName("body", body, model.bodies));
      sought.body = static_cast<int>(found - model.bodies.begin());
    }
    if (points.cols() != model.dimension)
      throw InputError(probe.path, std::to_string(points.cols()) + " coordinates per point; expected " + std::to_string(model.dimension));
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      for (int k = 0; k < model.dimension; ++k) sought.place[k] = points(i, k);
      probe.points.push_back(sought);
    }
    values = std::move(judged().valuesAt({probe}, nodal).front());
  });
  return values;
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
    parts_->judged = refine(judge(suture::solve(std::move(prepared))));
    Invocation invocation;
    if (!restart.empty()) collectively(*parts_->comm, "reading " + restart, [&] { invocation.restart = usedFile(restart); });
    summary_ = output ? parts_->judged->report(invocation).summary : parts_->judged->summary(invocation);
  });
}

}  // namespace suture::python
