#include <Teuchos_RCP.hpp>
#include <cmath>
#include <suture/report/Fields.hpp>
#include <suture/report/Provenance.hpp>
#include <suture/report/Units.hpp>
#include <suture/report/VtkHdf.hpp>
#include <unordered_map>

namespace suture {
namespace {

// All that a rank writes: the grid and its arrays, side by side.
struct BodyFields {
  GridPart grid;
  std::vector<double> displacement;
  std::vector<GlobalId> nodeId;
  std::vector<double> stress, principal, direction1, direction2, vonMises, young, error;
  std::vector<int> subdomain, body;
  std::vector<GlobalId> elementId;
};

// Numbers of the subdomain's nodes in the grid; a node that another subdomain of this rank has brought is not repeated.
std::vector<GlobalId> addNodes(const SubdomainMesh& mesh, const Vector& u, std::unordered_map<GlobalId, GlobalId>& known, BodyFields& all) {
  std::vector<GlobalId> number;
  for (int n = 0; n < mesh.nodes(); ++n) {
    const auto [at, added] = known.emplace(mesh.globalNodes[std::size_t(n)], GlobalId(known.size()));
    number.push_back(at->second);
    if (!added) continue;
    const Point x = mesh.point(n);
    all.grid.points.insert(all.grid.points.end(), x.begin(), x.end());
    for (int k = 0; k < 3; ++k) all.displacement.push_back(k < mesh.dimension ? u[n * mesh.dimension + k] : 0.0);
    all.nodeId.push_back(at->first);
  }
  return number;
}

void addCells(const SubdomainMesh& mesh, const std::vector<GlobalId>& number, BodyFields& all) {
  for (int e = 0; e < mesh.elements(); ++e) {
    for (const int n : mesh.nodesOf(e)) all.grid.connectivity.push_back(number[std::size_t(n)]);
    all.grid.offsets.push_back(GlobalId(all.grid.connectivity.size()));
    all.grid.types.push_back(static_cast<unsigned char>(cellInfo(mesh.cells[std::size_t(e)]).vtkType));
    all.subdomain.push_back(mesh.id);
    all.body.push_back(mesh.body);
    all.elementId.push_back(mesh.globalElements[std::size_t(e)]);
  }
}

void addStresses(const SubdomainMesh& mesh, const ElasticModel& model, const Vector& u, BodyFields& all) {
  const auto materialOf = [&](int e) -> const Material& { return model.materialOf(mesh, e, mesh.body); };
  const Matrix stress = elementStresses(mesh, materialOf, model.plane, u);
  const Matrix principal = principalStresses(stress);
  const Vector mises = vonMises(stress);
  const auto append = [](std::vector<double>& values, std::initializer_list<double> more) {
    for (const double value : more) values.push_back(value);
  };
  for (int e = 0; e < mesh.elements(); ++e) {
    const double xx = stress(e, 0), yy = stress(e, 1), zz = stress(e, 2), xy = stress(e, 3);
    const double c = std::cos(principal(e, 2)), s = std::sin(principal(e, 2));
    append(all.stress, {xx, yy, zz, xy, 0.0, 0.0});
    append(all.principal, {principal(e, 0), principal(e, 1), zz});
    append(all.direction1, {c, s, 0.0});
    append(all.direction2, {-s, c, 0.0});
    all.vonMises.push_back(mises[e]);
    if (!model.materialOfRegion.empty()) all.young.push_back(materialOf(e).young);
  }
}

const char* stressMeaning(const ElasticModel& model) {
  return model.axisymmetric ? "XX radial, YY along the axis, ZZ hoop, XY; YZ XZ zero; at the centroid; tension positive"
                            : "XX YY ZZ XY YZ XZ; at the centroid; tension positive";
}

BodyFields gather(const Run& run) {
  BodyFields all;
  std::unordered_map<GlobalId, GlobalId> known;
  std::size_t nodes = 0, elements = 0, corners = 0;
  for (const SubdomainMesh& mesh : run.subdomains) {
    nodes += mesh.nodes();
    elements += mesh.elements();
    corners += mesh.connectivity.size();
  }
  known.reserve(nodes);
  for (std::vector<double>* values : {&all.grid.points, &all.displacement}) values->reserve(3 * nodes);
  all.nodeId.reserve(nodes);
  all.grid.connectivity.reserve(corners);
  all.stress.reserve(6 * elements);
  for (std::vector<double>* values : {&all.principal, &all.direction1, &all.direction2}) values->reserve(3 * elements);
  for (std::vector<int>* values : {&all.subdomain, &all.body}) values->reserve(elements);
  for (std::vector<GlobalId>* values : {&all.grid.offsets, &all.elementId}) values->reserve(elements);
  for (std::size_t s = 0; s < run.subdomains.size(); ++s) {
    const SubdomainMesh& mesh = run.subdomains[s];
    const Vector& u = run.solution.displacement[s];
    addCells(mesh, addNodes(mesh, u, known, all), all);
    addStresses(mesh, run.model, u, all);
    if (run.solution.discretisation) {
      const Vector& error = run.solution.discretisation->ofElements[s];
      all.error.insert(all.error.end(), error.data(), error.data() + error.size());
    }
  }
  return all;
}

}  // namespace

void writeFields(const Run& run, const std::string& path) {
  const Units units = unitsOf(*run.scene.parameters);
  const BodyFields all = gather(run);
  VtkHdf file(run.comm, path, all.grid);
  file.pointData({"Displacement", 3, units.length, "x, y, z; along the axes"}, all.displacement);
  file.pointData({"NodeId", 1, "", "number of the node in the mesh, from 0"}, all.nodeId);
  file.cellData({"Stress", 6, units.stress, stressMeaning(run.model)}, all.stress);
  file.cellData({"PrincipalStress", 3, units.stress,
                 run.model.axisymmetric ? "larger in the meridian plane, smaller, hoop; at the centroid; tension positive"
                                        : "larger in-plane, smaller in-plane, out of plane; at the centroid; tension positive"},
                all.principal);
  file.cellData({"PrincipalDirection1", 3, "", "unit vector of the larger in-plane principal stress"}, all.direction1);
  file.cellData({"PrincipalDirection2", 3, "", "unit vector of the smaller in-plane principal stress"}, all.direction2);
  file.cellData({"VonMises", 1, units.stress, "at the centroid; never negative"}, all.vonMises);
  if (!run.model.materialOfRegion.empty()) file.cellData({"YoungModulus", 1, units.stress, "of the element's material"}, all.young);
  if (run.solution.discretisation)
    file.cellData({"ErrorEstimate", 1, "(" + units.stress + " " + units.length + "^2)^(1/2)",
                   "estimated discretisation error of the element in the energy norm; never negative"},
                  all.error);
  file.cellData({"Subdomain", 1, "", "number of the subdomain, from 0; names in /Record/Subdomains"}, all.subdomain);
  file.cellData({"Body", 1, "", "number of the body, from 0; names in /Record/Bodies"}, all.body);
  file.cellData({"ElementId", 1, "", "number of the element in the mesh, from 0"}, all.elementId);
  writeProvenance(run, file.file());
  writeNames(run, file.file());
  file.close();
}

}  // namespace suture
