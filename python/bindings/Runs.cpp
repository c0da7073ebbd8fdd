// Runs and their solutions, exposed as numpy arrays without copies.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <suture/report/Format.hpp>

#include "PythonRun.hpp"

namespace suture::python {

namespace {

/// A subdomain of this rank in a run.
class Subdomain {
 public:
  Subdomain(py::object run, std::size_t place) : run_(std::move(run)), place_(place) {}

  const SubdomainMesh& mesh() const { return run().meshes()[place_]; }
  const std::string& body() const { return run().scene().model.bodies[static_cast<std::size_t>(mesh().body)]; }

  py::array nodes() const { return view(mesh().globalNodes.data(), {mesh().nodes()}, run_); }
  py::array elementNumbers() const { return view(mesh().globalElements.data(), {mesh().elements()}, run_); }
  py::array coordinates() const { return view(mesh().coordinates.data(), {mesh().nodes(), mesh().dimension}, run_); }
  py::array connectivity() const { return view(mesh().connectivity.data(), {size(mesh().connectivity)}, run_); }
  py::array offsets() const { return view(mesh().offsets.data(), {size(mesh().offsets)}, run_); }

  /// Without a copy, unless a prescribed rigid motion was removed from it.
  py::array displacement() const {
    const Vector& own = run().solution().displacement[place_];
    if (mesh().lift.motion.size() == 0) return view(own.data(), {mesh().nodes(), mesh().dimension}, run_);
    py::array_t<double> all({mesh().nodes(), mesh().dimension});
    Eigen::Map<Vector>(all.mutable_data(), own.size()) = own + mesh().lift.motion;
    return all;
  }
  Matrix stress() const {
    const std::map<int, Matrix>& own = run().solution().ownStresses;
    if (const auto found = own.find(static_cast<int>(place_)); found != own.end()) return found->second;
    return elementStresses(mesh(), run().scene().model, run().solution().displacement[place_]);
  }
  Vector vonMises() const { return suture::vonMises(stress()); }
  std::vector<std::string> cells() const {
    std::vector<std::string> names;
    for (const Cell cell : mesh().cells) names.push_back(cellInfo(cell).name);
    return names;
  }
  std::string repr() const {
    const Vector& own = run().solution().displacement[place_];
    double largest = 0.0;
    for (int node = 0; node < mesh().nodes(); ++node) {
      double square = 0.0;
      for (int k = 0; k < mesh().dimension; ++k) {
        const double u = mesh().total(own, Eigen::Index(node) * mesh().dimension + k);
        square += u * u;
      }
      largest = std::max(largest, std::sqrt(square));
    }
    return format("<suture.Subdomain %d '%s' of body '%s': %d nodes, %d elements, largest displacement %.4g>", mesh().id,
                  mesh().name.c_str(), body().c_str(), mesh().nodes(), mesh().elements(), largest);
  }

 private:
  template <typename T>
  static py::ssize_t size(const std::vector<T>& all) {
    return static_cast<py::ssize_t>(all.size());
  }
  const PythonRun& run() const { return run_.cast<const PythonRun&>(); }

  py::object run_;
  std::size_t place_;
};

/// The pairs of a run: one array for each value of a pair.
class Pairs {
 public:
  Pairs(py::object run, const std::vector<PairResult>& all) : run_(std::move(run)), all_(all) {}

  template <typename T>
  py::array of(const T PairResult::*value) const {
    return view(all_.empty() ? nullptr : &(all_.front().*value), {count()}, {stride()}, run_);
  }
  py::array of(const Point PairResult::*value) const {
    const double* first = all_.empty() ? nullptr : (all_.front().*value).data();
    return view(first, {count(), 3}, {stride(), sizeof(double)}, run_);
  }
  py::array status() const {
    static_assert(sizeof(PairStatus) == sizeof(int), "shown as an int");
    return view(all_.empty() ? nullptr : reinterpret_cast<const int*>(&all_.front().state.status), {count()}, {stride()}, run_);
  }
  py::ssize_t count() const { return static_cast<py::ssize_t>(all_.size()); }
  std::string repr() const {
    if (all_.empty()) return "<suture.Pairs: none on this rank (rank 0 has all pairs)>";
    int closed = 0, sticking = 0;
    double gap = -std::numeric_limits<double>::infinity(), pressure = 0.0;
    for (const PairResult& pair : all_) {
      closed += pair.state.closed() ? 1 : 0;
      sticking += pair.state.status == PairStatus::Stick ? 1 : 0;
      gap = std::max(gap, pair.gap);
      pressure = std::max(pressure, pair.pressure);
    }
    return format("<suture.Pairs: %d pairs, %d closed (%d of them stick), largest gap %.4g, largest pressure %.4g>",
                  static_cast<int>(all_.size()), closed, sticking, gap, pressure);
  }

 private:
  static constexpr py::ssize_t stride() { return sizeof(PairResult); }

  py::object run_;
  const std::vector<PairResult>& all_;
};

std::vector<Subdomain> subdomainsOf(const py::object& run) {
  std::vector<Subdomain> all;
  for (std::size_t i = 0; i < run.cast<const PythonRun&>().solution().displacement.size(); ++i) all.emplace_back(run, i);
  return all;
}

void bindPairs(py::module_& module) {
  py::class_<Pairs> pairs(module, "Pairs",
                          "State of all contact pairs, on rank 0; empty on other ranks. Arrays expose the library's values.");
  pairs.def("__len__", &Pairs::count);
  pairs.def("__repr__", &Pairs::repr);
  const auto add = [&pairs](const char* name, auto value, const char* doc) {
    pairs.def_property_readonly(
        name, [value](const Pairs& self) { return self.of(value); }, doc);
  };
  pairs.def_property_readonly("status", &Pairs::status, "0 open, 1 closed and sliding, 2 closed and stuck");
  add("pair", &PairResult::id, "number of the pair");
  add("node", &PairResult::node, "number in the mesh of the node that carries the pair");
  add("contact", &PairResult::line, "index of the contact in Result.contacts");
  add("piece", &PairResult::piece, "number of the connected contact piece");
  add("initial_gap", &PairResult::initialGap, "gap of the undeformed bodies [length]");
  add("gap", &PairResult::gap, "gap, positive if the pair is open [length]");
  add("force", &PairResult::force, "normal force, positive in compression [force]");
  add("pressure", &PairResult::pressure, "force over tributary length or area [stress]");
  add("tributary", &PairResult::length, "tributary length or area of the pair");
  add("arc_length", &PairResult::arc, "arc length along the contact [length]");
  add("dissipated_work", &PairResult::dissipated, "work of friction [energy]");
  add("bound", &PairResult::bound, "largest tangential force; 0 if the law sets none [force]");
  add("position", &PairResult::position, "position of the undeformed node [length]");
  add("displacement", &PairResult::displacement, "displacement of the node [length]");
  add("normal", &PairResult::normal, "unit normal from side A to side B");
  add("tangential_force", &PairResult::tangential, "tangential force on side B [force]");
  add("slip", &PairResult::slip, "tangential part of u_A - u_B [length]");
}

void bindSubdomain(py::module_& module) {
  py::class_<Subdomain>(module, "Subdomain", "A subdomain of this rank, with its mesh and solution.")
      .def_property_readonly("id", [](const Subdomain& self) { return self.mesh().id; })
      .def_property_readonly("name", [](const Subdomain& self) { return self.mesh().name; })
      .def_property_readonly("body", &Subdomain::body, "name of its body")
      .def_property_readonly("dimension", [](const Subdomain& self) { return self.mesh().dimension; })
      .def_property_readonly("nodes", &Subdomain::nodes, "numbers of its nodes in the mesh")
      .def_property_readonly("coordinates", &Subdomain::coordinates, "nodes x dimension [length]")
      .def_property_readonly("elements", &Subdomain::elementNumbers, "numbers of its elements in the mesh")
      .def_property_readonly("connectivity", &Subdomain::connectivity, "local nodes of element e: connectivity[offsets[e]:offsets[e + 1]]")
      .def_property_readonly("offsets", &Subdomain::offsets, "elements + 1")
      .def_property_readonly("cells", &Subdomain::cells, "names of the shapes of its elements")
      .def("__repr__", &Subdomain::repr)
      .def_property_readonly("displacement", &Subdomain::displacement, "nodes x dimension [length]")
      .def_property_readonly("stress", &Subdomain::stress,
                             "at centroids: elements x 4 (xx, yy, zz, xy), in 3D x 6 (xx, yy, zz, xy, yz, xz) [stress]")
      .def_property_readonly("von_mises", &Subdomain::vonMises, "of each element [stress]");
}

/// Values of a probe on rank 0, None on other ranks: one array for each value.
py::object tableOf(const PythonRun& run, const std::vector<ProbeValue>& rows) {
  const int dimension = run.scene().model.dimension;
  const auto count = static_cast<py::ssize_t>(rows.size());
  const auto width = static_cast<py::ssize_t>(dimension), components = static_cast<py::ssize_t>(dimension == 2 ? 4 : 6);
  const auto array = [&](py::ssize_t columns, const auto& value) {
    py::array_t<double> all(columns == 1 ? std::vector<py::ssize_t>{count} : std::vector<py::ssize_t>{count, columns});
    double* at = all.mutable_data();
    for (const ProbeValue& row : rows)
      for (py::ssize_t k = 0; k < columns; ++k) *at++ = value(row, static_cast<std::size_t>(k));
    return all;
  };
  py::dict table;
  table["position"] = array(width, [](const ProbeValue& row, std::size_t k) { return row.place[k]; });
  table["arc_length"] = array(1, [](const ProbeValue& row, std::size_t) { return row.arc; });
  table["displacement"] = array(width, [](const ProbeValue& row, std::size_t k) { return row.displacement[k]; });
  table["stress"] = array(components, [](const ProbeValue& row, std::size_t k) { return row.stress[k]; });
  const auto of = [&](double PrincipalExtremes::*value) {
    return array(1, [&](const ProbeValue& row, std::size_t) { return principalExtremes(row, dimension).*value; });
  };
  table["von_mises"] = of(&PrincipalExtremes::vonMises);
  table["principal_1"] = of(&PrincipalExtremes::largest);
  table["principal_3"] = of(&PrincipalExtremes::smallest);
  table["gap"] = array(1, [](const ProbeValue& row, std::size_t) { return row.gap; });
  table["pressure"] = array(1, [](const ProbeValue& row, std::size_t) { return row.pressure; });
  py::list bodies;
  for (const ProbeValue& row : rows) bodies.append(run.scene().model.bodies[static_cast<std::size_t>(row.body)]);
  table["body"] = bodies;
  return std::move(table);
}

/// All probes by name: their values on rank 0.
py::dict probesOf(PythonRun& run) {
  py::dict all;
  for (const auto& [probe, rows] : run.probes()) all[py::str(probe.name)] = tableOf(run, rows);
  return all;
}

/// Copies of the recovered stresses of each subdomain of this rank.
py::list nodalOf(PythonRun& run) {
  py::list all;
  for (const Matrix& one : run.nodalStresses()) all.append(py::cast(one));
  return all;
}

void bindHistory(py::module_& module) {
  py::class_<OuterRow>(module, "OuterRow", "An outer iteration, a row of history.csv.")
      .def_readonly("iteration", &OuterRow::iteration)
      .def_readonly("pcg", &OuterRow::pcg)
      .def_readonly("condition", &OuterRow::condition)
      .def_readonly("residual", &OuterRow::residual)
      .def_readonly("active", &OuterRow::active)
      .def_readonly("changed", &OuterRow::changed)
      .def_readonly("energy", &OuterRow::energy)
      .def_readonly("seconds", &OuterRow::seconds)
      .def_readonly("load_step", &OuterRow::loadStep);
}

using Values = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Values as a list, node by node, from an array of any shape. \throws py::error_already_set  they are not numbers
std::vector<double> listOf(const py::object& values) {
  const Values all(values);
  return {all.data(), all.data() + all.size()};
}

/// Sets values at a surface. Converts the values on all ranks before the collective call, so that an error cannot leave ranks waiting.
template <void (CoupledScene::*give)(const CouplingSurface&, const std::vector<double>&)>
void given(PythonRun& run, const CouplingSurface& at, const py::object& values) {
  std::vector<double> numbers;
  run.doTogether([&] { numbers = listOf(values); });
  run.doCoupled([&](CoupledScene& coupled) { (coupled.*give)(at, numbers); });
}

void bindSurface(py::module_& module) {
  const auto matrix = [](const py::object& self, const std::vector<double>& values) {
    const auto dimension = static_cast<py::ssize_t>(self.cast<const CouplingSurface&>().dimension);
    return view(values.data(), {static_cast<py::ssize_t>(values.size()) / dimension, dimension}, self);
  };
  const auto list = [](const py::object& self, const auto& values) {
    return view(values.data(), {static_cast<py::ssize_t>(values.size())}, self);
  };
  py::class_<CouplingSurface> surface(module, "Surface",
                                      "Nodes of a side group through which another program acts on a scene: those owned by this rank.");
  surface.def_readonly("group", &CouplingSurface::group);
  const auto add = [&surface](const char* name, auto member, auto shape, const char* doc) {
    surface.def_property_readonly(
        name, [=](const py::object& self) { return shape(self, self.cast<const CouplingSurface&>().*member); }, doc);
  };
  add("nodes", &CouplingSurface::nodes, list, "numbers in the mesh, ascending");
  add("areas", &CouplingSurface::areas, list, "integrals of the shape functions, i.e. forces of a unit traction");
  add("coordinates", &CouplingSurface::coordinates, matrix, "nodes x dimension [length]");
  add("normals", &CouplingSurface::normals, matrix,
      "integrals of the shape functions times the outward normal: a pressure p gives the forces -p * normals");
}

/// Displacements of a surface's nodes, nodes x dimension.
py::array displacementsOf(const PythonRun& run, const CouplingSurface& surface) {
  const std::vector<double> values = run.coupled().displacements(surface);
  py::array_t<double> all({static_cast<py::ssize_t>(values.size()) / surface.dimension, static_cast<py::ssize_t>(surface.dimension)});
  std::copy(values.begin(), values.end(), all.mutable_data());
  return std::move(all);
}

}  // namespace

void bindRuns(py::module_& module) {
  bindHistory(module);
  bindPairs(module);
  bindSubdomain(module);
  bindSurface(module);
  py::class_<PythonRun, std::shared_ptr<PythonRun>>(module, "Run")
      .def(py::init<const py::object&, const std::string&, const std::string&, const std::string&, const std::vector<std::string>&, bool,
                    const py::object&>())
      .def("solve", &PythonRun::solve)
      .def("coupling",
           [](PythonRun& self, const std::string& group) {
             CouplingSurface surface;
             self.doCoupled([&](CoupledScene& coupled) { surface = coupled.surface(group); });
             return surface;
           })
      .def("set_forces", given<&CoupledScene::setForces>)
      .def("set_tractions", given<&CoupledScene::setTractions>)
      .def("set_displacements", given<&CoupledScene::setDisplacements>)
      .def("solve_again", [](PythonRun& self, bool verified) { self.doCoupled([&](CoupledScene& coupled) { coupled.solve(verified); }); })
      .def("advance", [](PythonRun& self) { self.doCoupled([](CoupledScene& coupled) { coupled.advance(); }); })
      .def("displacements", &displacementsOf)
      .def("write", &PythonRun::writeTo)
      .def("nodal_stresses", &nodalOf)
      .def("probes", &probesOf)
      .def("probe",
           [](PythonRun& self, const Matrix& points, const std::string& body) { return tableOf(self, self.valuesAt(points, body)); })
      .def_property_readonly("bodies", [](const PythonRun& self) { return self.scene().model.bodies; })
      .def_property_readonly("dimension", [](const PythonRun& self) { return self.scene().model.dimension; })
      .def_property_readonly("is_done", &PythonRun::isDone)
      .def_property_readonly("exit_code", &PythonRun::exitCode)
      .def_property_readonly("failure", &PythonRun::failure)
      .def_property_readonly("summary_text", &PythonRun::summary)
      .def_property_readonly("notes", &PythonRun::notes)
      .def_property_readonly("history", &PythonRun::history)
      .def_property_readonly("energy", [](const PythonRun& self) { return self.solution().energy; })
      .def_property_readonly("contacts", [](const PythonRun& self) { return self.scene().contacts; })
      .def_property_readonly("subdomains", [](const py::object& self) { return subdomainsOf(self); })
      .def_property_readonly("pairs", [](const py::object& self) { return Pairs(self, self.cast<const PythonRun&>().solution().pairs); });
}

}  // namespace suture::python
