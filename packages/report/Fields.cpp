#include <Teuchos_RCP.hpp>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <suture/base/Collective.hpp>
#include <suture/report/Fields.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/Provenance.hpp>
#include <suture/report/StressAxes.hpp>
#include <suture/report/Units.hpp>
#include <suture/report/VtkHdf.hpp>
#include <unordered_map>

namespace suture {
namespace {

constexpr int kPieceElements = 4096;     // work space of a megabyte, stays in the cache between pieces
constexpr double kLargestFactor = 1000;  // safety factor in the file

// Consecutive subdomains and the values to be written for them.
struct Piece {
  GridPiece grid;
  std::vector<double> displacement, since, nodalStress, nodalPrincipal, nodalVonMises;
  std::vector<GlobalId> nodeId;
  std::vector<double> stress, principal, firstDirection, lastDirection, vonMises, young, error, bound, safety, nodalSafety;
  std::vector<int> subdomain, body, material;
  std::vector<GlobalId> elementId;

  bool isFull() const { return grid.types.size() >= kPieceElements; }
  // Keeps the allocated memory.
  void clear() {
    for (auto* values : {&grid.points, &displacement, &since, &nodalStress, &nodalPrincipal, &nodalVonMises, &stress, &principal,
                         &firstDirection, &lastDirection, &vonMises, &young, &error, &bound, &safety, &nodalSafety})
      values->clear();
    for (auto* values : {&grid.connectivity, &grid.ends, &nodeId, &elementId}) values->clear();
    for (auto* values : {&subdomain, &body, &material}) values->clear();
    grid.types.clear();
  }
};

bool hasBound(const Solution& solution) { return solution.bound && solution.bound->exists; }

// Numbers of this rank's points; a node already added by an earlier subdomain of the rank is not repeated.
class PointNumbers {
 public:
  explicit PointNumbers(const std::vector<SubdomainMesh>& subdomains) {
    for (const SubdomainMesh& mesh : subdomains) here_.insert(mesh.id);
  }
  bool isNew(const SubdomainMesh& mesh, int node) const {
    for (const int other : mesh.others(node))
      if (other < mesh.id && here_.count(other)) return false;
    return true;
  }
  // Adds the nodes of the next subdomain.
  const std::vector<GlobalId>& of(const SubdomainMesh& mesh) {
    numbers_.clear();
    for (int n = 0, nodes = mesh.bodyNodes(); n < nodes; ++n) {
      const GlobalId node = mesh.globalNodes[std::size_t(n)];
      const bool known = !isNew(mesh, n);
      numbers_.push_back(known ? ofSeam_.at(node) : next_++);
      if (!known && mesh.others(n).size() > 0) ofSeam_[node] = numbers_.back();
    }
    return numbers_;
  }

 private:
  std::set<int> here_;
  std::unordered_map<GlobalId, GlobalId> ofSeam_;  // points of nodes shared with other subdomains
  std::vector<GlobalId> numbers_;
  GlobalId next_ = 0;
};

GridSize sizeOf(const std::vector<SubdomainMesh>& subdomains, const PointNumbers& numbers) {
  GridSize size;
  for (const SubdomainMesh& mesh : subdomains) {
    for (int n = 0, nodes = mesh.bodyNodes(); n < nodes; ++n) size.points += numbers.isNew(mesh, n);
    size.cells += mesh.elements();
    size.connectivity += static_cast<GlobalId>(mesh.connectivity.size());
  }
  return size;
}

void addNodes(const SubdomainMesh& mesh, const PointNumbers& numbers, const Vector& u, Piece& all) {
  for (int n = 0, nodes = mesh.bodyNodes(); n < nodes; ++n) {
    if (!numbers.isNew(mesh, n)) continue;
    const Point x = mesh.drawnPoint(n);
    all.grid.points.insert(all.grid.points.end(), x.begin(), x.end());
    for (int k = 0; k < 3; ++k)
      all.displacement.push_back(k < mesh.dimension ? mesh.fromDrawn(u, Eigen::Index(n) * mesh.dimension + k) : 0.0);
    all.nodeId.push_back(mesh.globalNodes[std::size_t(n)]);
  }
}

/// \param u  displacements since an earlier time
void addSince(const SubdomainMesh& mesh, const PointNumbers& numbers, const Vector& u, Piece& all) {
  for (int n = 0, nodes = mesh.bodyNodes(); n < nodes; ++n)
    for (int k = 0; k < 3 && numbers.isNew(mesh, n); ++k)
      all.since.push_back(k < mesh.dimension ? u[Eigen::Index(n) * mesh.dimension + k] : 0.0);
}

void append(std::vector<double>& values, std::initializer_list<double> more) { values.insert(values.end(), more); }

/// Appends a row of elementStresses() in file order: XX YY ZZ XY YZ XZ.
void appendTensor(const Matrix& stresses, Eigen::Index row, std::vector<double>& values) {
  for (Eigen::Index k = 0; k < 6; ++k) values.push_back(k < stresses.cols() ? stresses(row, k) : 0.0);
}

/// \param stresses  at the nodes, rows as in elementStresses()
void addNodalStresses(const Run& run, const SubdomainMesh& mesh, const PointNumbers& numbers, const Matrix& stresses, Piece& all) {
  const Matrix written = inStressAxes(run, mesh, stresses);
  const Matrix principal = principalStresses(stresses);
  const Vector mises = vonMises(stresses);
  for (int n = 0, nodes = mesh.bodyNodes(); n < nodes; ++n) {
    if (!numbers.isNew(mesh, n)) continue;
    appendTensor(written, n, all.nodalStress);
    all.nodalVonMises.push_back(mises[n]);
    if (mesh.dimension == 3) {
      append(all.nodalPrincipal, {principal(n, 0), principal(n, 1), principal(n, 2)});
      continue;
    }
    const double zz = stresses(n, 2), larger = principal(n, 0), smaller = principal(n, 1);
    append(all.nodalPrincipal, {std::max(larger, zz), std::max(smaller, std::min(larger, zz)), std::min(smaller, zz)});
  }
}

void addCells(const SubdomainMesh& mesh, const std::vector<GlobalId>& number, Piece& all) {
  for (int e = 0; e < mesh.elements(); ++e) {
    const Span<const int> nodes = mesh.nodesOf(e);
    if (mesh.cells[std::size_t(e)] == Cell::Wedge6)  // VTK orients the base outwards
      for (const int k : {0, 2, 1, 3, 5, 4}) all.grid.connectivity.push_back(number[std::size_t(nodes[std::size_t(k)])]);
    else
      for (const int n : nodes) all.grid.connectivity.push_back(number[std::size_t(n)]);
    all.grid.ends.push_back(GlobalId(all.grid.connectivity.size()));
    all.grid.types.push_back(static_cast<unsigned char>(cellInfo(mesh.cells[std::size_t(e)]).vtkType));
    all.subdomain.push_back(mesh.id);
    all.body.push_back(mesh.body);
    all.elementId.push_back(mesh.globalElements[std::size_t(e)]);
  }
}

/// \param names  of materials: materialNames()
void addMaterials(const SubdomainMesh& mesh, const ElasticModel& model, const std::vector<std::string>& names, Piece& all) {
  const Material* last = nullptr;
  int number = -1;
  for (int e = 0; e < mesh.elements(); ++e) {
    const Material& material = model.materialOf(mesh, e, mesh.body);
    if (&material != last) number = int(std::find(names.begin(), names.end(), material.name) - names.begin());
    last = &material;
    all.material.push_back(number);
  }
}

/// Infinite factors, of places without load, would make colour scales and means useless. NaN, without strength, stays.
double writtenFactor(double factor) { return factor > kLargestFactor ? kLargestFactor : factor; }

/// \param own  stresses of a user-defined subdomain, or null
void addStresses(const Run& run, const SubdomainMesh& mesh, const Vector& u, const Matrix* own, Piece& all) {
  const ElasticModel& model = run.model;
  const Matrix stress = own ? *own : elementStresses(mesh, model, u), written = inStressAxes(run, mesh, stress);
  const Matrix principal = principalStresses(stress);
  const Vector mises = vonMises(stress);
  for (int e = 0; e < mesh.elements(); ++e) {
    appendTensor(written, e, all.stress);
    if (mesh.dimension == 3) {
      append(all.principal, {principal(e, 0), principal(e, 1), principal(e, 2)});
      append(all.firstDirection, {principal(e, 3), principal(e, 4), principal(e, 5)});
      append(all.lastDirection, {principal(e, 6), principal(e, 7), principal(e, 8)});
    } else {
      const double c = std::cos(principal(e, 2)), s = std::sin(principal(e, 2));
      append(all.principal, {principal(e, 0), principal(e, 1), stress(e, 2)});
      append(all.firstDirection, {c, s, 0.0});
      append(all.lastDirection, {-s, c, 0.0});
    }
    if (!model.materialOfRegion.empty()) all.young.push_back(model.materialOf(mesh, e, mesh.body).young);
  }
  all.vonMises.insert(all.vonMises.end(), mises.data(), mises.data() + mises.size());
  if (!model.hasStrength()) return;
  const Vector factors = safetyFactors(mesh, model, stress);
  for (const double factor : factors) all.safety.push_back(writtenFactor(factor));
}

std::string stressMeaning(const Run& run, const std::string& where) {
  return (run.model.axisymmetric ? "XX radial, YY along the axis, ZZ hoop, XY; YZ XZ zero; " : "XX YY ZZ XY YZ XZ; ") + where +
         "; tension positive; " + stressAxesText(run);
}

std::string principalMeaning(const ElasticModel& model) {
  if (model.dimension == 3) return "largest, middle, smallest";
  return model.axisymmetric ? "larger in the meridian plane, smaller, hoop" : "larger in-plane, smaller in-plane, out of plane";
}

bool isInSpace(const Run& run) { return run.model.dimension == 3; }

constexpr const char* kRecovered = "recovered from the elements; NaN in bodies with user-defined physics";

/// True on all ranks if any rank has them. Collective.
bool hasNodalStresses(const Run& run) { return unionOverRanks(run.comm, {int(!run.solution.nodalStresses.empty())}).back() > 0; }

// The arrays of the file, open for appending.
class FieldRows {
 public:
  FieldRows(const Run& run, VtkHdf& file)
      : file_(file),
        units_(unitsOf(*run.scene.parameters)),
        displacement_(file.pointData<double>({"Displacement", 3, units_.length, "x, y, z; along the axes"})),
        nodeId_(file.pointData<GlobalId>({"NodeId", 1, "", "number of the node in the mesh, from 0"})),
        stress_(reals("Stress", 6, units_.stress, stressMeaning(run, "at the centroid"))),
        principal_(reals("PrincipalStress", 3, units_.stress, principalMeaning(run.model) + "; at the centroid; tension positive")),
        firstDirection_(
            reals("PrincipalDirection1", 3, "",
                  isInSpace(run) ? "unit vector of the largest principal stress" : "unit vector of the larger in-plane principal stress")),
        lastDirection_(reals(
            isInSpace(run) ? "PrincipalDirection3" : "PrincipalDirection2", 3, "",
            isInSpace(run) ? "unit vector of the smallest principal stress" : "unit vector of the smaller in-plane principal stress")),
        vonMises_(reals("VonMises", 1, units_.stress, "at the centroid; never negative")) {
    if (hasNodalStresses(run)) {
      const auto atNodes = [&](const char* name, int components, const std::string& meaning) {
        return file.pointData<double>({name, components, units_.stress, meaning});
      };
      nodalStress_.emplace(atNodes("NodalStress", 6, stressMeaning(run, kRecovered)));
      nodalPrincipal_.emplace(atNodes("NodalPrincipalStress", 3, std::string("largest, middle, smallest of the tensor; ") + kRecovered));
      nodalVonMises_.emplace(atNodes("NodalVonMises", 1, kRecovered));
    }
    if (run.solution.sinceTime)
      since_.emplace(file.pointData<double>(
          {"DisplacementSince", 3, units_.length, format("x, y, z; since the time %g; along the axes", *run.solution.sinceTime)}));
    if (run.model.hasStrength()) {
      const std::string meaning = "safety factor by the strength of the material, at most 1000; NaN without strength; ";
      safety_.emplace(reals("SafetyFactor", 1, "", meaning + "at the centroid"));
      if (nodalStress_) nodalSafety_.emplace(file.pointData<double>({"NodalSafetyFactor", 1, "", meaning + "from the recovered stresses"}));
    }
    if (!run.model.materialOfRegion.empty()) young_.emplace(reals("YoungModulus", 1, units_.stress, "of the element's material"));
    if (run.solution.discretisation)
      error_.emplace(reals("ErrorEstimate", 1, "(" + units_.stress + " " + units_.length + "^2)^(1/2)",
                           "estimated discretisation error of the element in the energy norm; never negative"));
    if (hasBound(run.solution))
      bound_.emplace(reals("ErrorBound", 1, "(" + units_.stress + " " + units_.length + "^2)^(1/2)",
                           "contribution of the element to the bound of the error in the energy norm; never negative"));
    subdomain_.emplace(integers<int>("Subdomain", "number of the subdomain, from 0; names in SubdomainNames"));
    body_.emplace(integers<int>("Body", "number of the body, from 0; names in BodyNames"));
    material_.emplace(integers<int>("Material", "number of the material, from 0; names in MaterialNames"));
    elementId_.emplace(integers<GlobalId>("ElementId", "number of the element in the mesh, from 0"));
  }

  // Local.
  void append(const Piece& piece) {
    file_.append(piece.grid);
    displacement_.append(piece.displacement);
    nodeId_.append(piece.nodeId);
    stress_.append(piece.stress);
    principal_.append(piece.principal);
    firstDirection_.append(piece.firstDirection);
    lastDirection_.append(piece.lastDirection);
    vonMises_.append(piece.vonMises);
    if (nodalStress_) {
      nodalStress_->append(piece.nodalStress);
      nodalPrincipal_->append(piece.nodalPrincipal);
      nodalVonMises_->append(piece.nodalVonMises);
    }
    if (since_) since_->append(piece.since);
    if (safety_) safety_->append(piece.safety);
    if (nodalSafety_) nodalSafety_->append(piece.nodalSafety);
    if (young_) young_->append(piece.young);
    if (error_) error_->append(piece.error);
    if (bound_) bound_->append(piece.bound);
    subdomain_->append(piece.subdomain);
    body_->append(piece.body);
    material_->append(piece.material);
    elementId_->append(piece.elementId);
  }

 private:
  Hdf5Rows<double> reals(const char* name, int components, const std::string& unit, const std::string& meaning) {
    return file_.cellData<double>({name, components, unit, meaning});
  }
  template <typename T>
  Hdf5Rows<T> integers(const char* name, const char* meaning) {
    return file_.cellData<T>({name, 1, "", meaning});
  }

  VtkHdf& file_;
  const Units units_;
  Hdf5Rows<double> displacement_;
  Hdf5Rows<GlobalId> nodeId_;
  Hdf5Rows<double> stress_, principal_, firstDirection_, lastDirection_, vonMises_;
  std::optional<Hdf5Rows<double>> nodalStress_, nodalPrincipal_, nodalVonMises_, since_, young_, error_, bound_, safety_, nodalSafety_;
  std::optional<Hdf5Rows<int>> subdomain_, body_, material_;
  std::optional<Hdf5Rows<GlobalId>> elementId_;
};

// Local.
void appendAll(const Run& run, PointNumbers& numbers, FieldRows& rows) {
  Piece piece;
  const std::vector<std::string> materials = materialNames(run.model);
  for (std::size_t s = 0; s < run.subdomains.size(); ++s) {
    const SubdomainMesh& mesh = run.subdomains[s];
    const Vector& u = run.solution.displacement[s];
    addNodes(mesh, numbers, u, piece);
    if (!run.solution.nodalStresses.empty()) addNodalStresses(run, mesh, numbers, run.solution.nodalStresses[s], piece);
    if (run.solution.sinceTime) addSince(mesh, numbers, run.solution.since[s], piece);
    if (!run.solution.safety.nodal.empty())
      for (int n = 0, nodes = mesh.bodyNodes(); n < nodes; ++n)
        if (numbers.isNew(mesh, n)) piece.nodalSafety.push_back(writtenFactor(run.solution.safety.nodal[s][n]));
    addCells(mesh, numbers.of(mesh), piece);
    addMaterials(mesh, run.model, materials, piece);
    const auto own = run.solution.ownStresses.find(static_cast<int>(s));
    addStresses(run, mesh, u, own == run.solution.ownStresses.end() ? nullptr : &own->second, piece);
    if (run.solution.discretisation) {
      const Vector& error = run.solution.discretisation->ofElements[s];
      piece.error.insert(piece.error.end(), error.data(), error.data() + error.size());
    }
    if (hasBound(run.solution)) {
      const Vector& bound = run.solution.bound->ofElements[s];
      piece.bound.insert(piece.bound.end(), bound.data(), bound.data() + bound.size());
    }
    if (!piece.isFull() && s + 1 < run.subdomains.size()) continue;
    rows.append(piece);
    piece.clear();
  }
}

}  // namespace

void writeFields(const Run& run, const std::string& path) {
  PointNumbers numbers(run.subdomains);
  VtkHdf file(run.comm, path, sizeOf(run.subdomains, numbers));
  {
    FieldRows rows(run, file);
    collectively(run.comm, "writing " + path, [&] { appendAll(run, numbers, rows); });
  }
  writeProvenance(run, file.file());
  writeNames(run, file);
  file.close();
}

}  // namespace suture
