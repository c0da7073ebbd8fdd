#include <suture/answer/values/SafetyFactors.hpp>
#include <suture/answer/verdict/SeamExchange.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/mesh/CellGeometry.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace suture {

namespace {

constexpr double kNoStrength = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostWarnings = 5;

const Strength* strengthIn(const ElasticModel& model, int body, int region) {
  return (region < 0 ? model.materialOfBody[std::size_t(body)] : model.materialOfRegion[std::size_t(region)]).strength.get();
}

int regionOf(const SubdomainMesh& mesh, const ElasticModel& model, int element) {
  return model.materialOfRegion.empty() ? -1 : mesh.regions[std::size_t(element)];
}

/// A place with its factor. Sent as bytes.
struct SafetyPlace {
  GlobalId id = -1;
  PrincipalStress stress{};
  double factor = 0.0;
  int body = -1, region = -1;
};

/// The search of one rank: Largest keeps the places of the least factors of each body, independently of the partition.
class LeastSearch {
 public:
  explicit LeastSearch(const ElasticModel& model) : least_(model.bodies.size()) {}

  template <typename Place>
  void take(const SafetyPlace& one, const Place& place) {
    if (!std::isfinite(one.factor) || !least_[std::size_t(one.body)].mayTake(-one.factor)) return;
    least_[std::size_t(one.body)].take(-one.factor, one.body, one.id, place);
    candidates_.push_back(one);
  }

  /// The same on all ranks; bodies without load do not exist. Collective.
  std::vector<LeastSafety> over(const Comm& comm) {
    Packer mine;
    mine.put(least_);
    std::vector<Largest> all(least_.size());
    for (const std::string& bytes : allGather(comm, mine.bytes())) {
      const auto theirs = Unpacker(bytes).get<std::vector<Largest>>();
      for (std::size_t body = 0; body < all.size(); ++body) all[body].take(theirs[body]);
    }
    std::vector<LeastSafety> found(all.size());
    for (std::size_t body = 0; body < all.size(); ++body) {
      const Extreme place = all[body].found();
      if (!place.exists()) continue;
      found[body].body = int(body);
      found[body].id = place.id;
      found[body].factor = -place.value;
      found[body].place = place.place;
    }
    addStresses(comm, found);
    return found;
  }

 private:
  /// Adds the stress and the region at the places, from the ranks that have them; of several candidates there the one with the least
  /// factor.
  void addStresses(const Comm& comm, std::vector<LeastSafety>& found) const {
    std::vector<SafetyPlace> mine;
    for (const SafetyPlace& one : candidates_)
      if (found[std::size_t(one.body)].id == one.id) mine.push_back(one);
    Packer packer;
    packer.put(mine);
    std::vector<double> best(found.size(), std::numeric_limits<double>::infinity());
    for (const std::string& bytes : allGather(comm, packer.bytes()))
      for (const SafetyPlace& one : Unpacker(bytes).get<std::vector<SafetyPlace>>()) {
        if (!(one.factor < best[std::size_t(one.body)])) continue;
        best[std::size_t(one.body)] = one.factor;
        found[std::size_t(one.body)].stress = one.stress;
        found[std::size_t(one.body)].region = one.region;
      }
  }

  std::vector<Largest> least_;  // by body, of negative factors
  std::vector<SafetyPlace> candidates_;
};

void searchElements(const SubdomainMesh& mesh, const ElasticModel& model, const Matrix& stresses, LeastSearch& search) {
  for (int e = 0; e < mesh.elements(); ++e) {
    const int region = regionOf(mesh, model, e);
    const Strength* strength = strengthIn(model, mesh.body, region);
    if (!strength) continue;
    const PrincipalStress s = principalStress(stresses.row(e));
    search.take({mesh.globalElements[std::size_t(e)], s, strength->factor(s), mesh.body, region}, [&] { return centreOf(mesh, e); });
  }
}

/// Materials of the elements at each node, over all subdomains: a row per material, that of the body first, then those of the regions.
/// Collective.
std::vector<Matrix> materialsAtNodes(const Comm& comm, const SearchedFields& fields) {
  const ElasticModel& model = fields.model;
  std::vector<Matrix> all;
  for (const SubdomainMesh& mesh : fields.meshes) {
    Matrix& here = all.emplace_back(Matrix::Zero(Eigen::Index(model.materialOfRegion.size()) + 1, mesh.nodes()));
    for (int e = 0; e < mesh.elements(); ++e)
      for (const int node : mesh.nodesOf(e)) here(regionOf(mesh, model, e) + 1, node) = 1.0;
  }
  if (!model.materialOfRegion.empty()) SeamExchange(comm, fields.meshes).sum(all);
  return all;
}

/// Factors at the nodes of a mesh. \param materials  of materialsAtNodes()
Vector searchNodes(const SubdomainMesh& mesh, const ElasticModel& model, const Matrix& stresses, const Matrix& materials,
                   LeastSearch& search) {
  Vector factors = Vector::Constant(mesh.nodes(), kNoStrength);
  for (int node = 0; node < mesh.nodes(); ++node) {
    SafetyPlace least;
    for (int region = -1; region + 1 < int(materials.rows()); ++region) {
      const Strength* strength = materials(region + 1, node) > 0.0 ? strengthIn(model, mesh.body, region) : nullptr;
      if (!strength) continue;
      const PrincipalStress s = principalStress(stresses.row(node));
      const double factor = strength->factor(s);
      if (least.id >= 0 && !(factor < least.factor)) continue;
      least = {mesh.globalNodes[std::size_t(node)], s, factor, mesh.body, region};
      factors[node] = factor;
    }
    if (least.id >= 0) search.take(least, [&] { return mesh.point(node); });
  }
  return factors;
}

}  // namespace

SafetyFactors findSafety(const Comm& comm, const SearchedFields& fields) {
  SafetyFactors found;
  const ElasticModel& model = fields.model;
  if (!model.hasStrength()) return found;
  const bool isRecovered = unionOverRanks(comm, {int(!fields.nodal.empty())}).back() > 0;
  const std::vector<Matrix> materials = isRecovered ? materialsAtNodes(comm, fields) : std::vector<Matrix>();
  LeastSearch search(model);
  collectively(comm, "finding the safety factors", [&] {
    for (std::size_t i = 0; i < fields.meshes.size(); ++i) {
      const SubdomainMesh& mesh = fields.meshes[i];
      const auto own = fields.own.find(static_cast<int>(i));
      if (own != fields.own.end()) {
        searchElements(mesh, model, own->second, search);
        if (isRecovered) found.nodal.push_back(Vector::Constant(mesh.nodes(), kNoStrength));
      } else if (isRecovered) {
        found.nodal.push_back(searchNodes(mesh, model, fields.nodal[i], materials[i], search));
      } else {
        searchElements(mesh, model, elementStresses(mesh, model, fields.displacement[i]), search);
      }
    }
  });
  std::vector<LeastSafety> least = search.over(comm);
  for (int body = 0; body < int(model.bodies.size()); ++body) {
    bool has = model.materialOfBody[std::size_t(body)].strength != nullptr;
    for (std::size_t region = 0; region < model.materialOfRegion.size(); ++region)
      has = has || (model.bodyOfRegion[region] == model.bodies[std::size_t(body)] && model.materialOfRegion[region].strength);
    if (!has) continue;
    least[std::size_t(body)].body = body;
    found.ofBodies.push_back(least[std::size_t(body)]);
  }
  return found;
}

Vector safetyFactors(const SubdomainMesh& mesh, const ElasticModel& model, const Matrix& stresses) {
  Vector factors = Vector::Constant(mesh.elements(), kNoStrength);
  for (int e = 0; e < mesh.elements(); ++e)
    if (const Strength* strength = strengthIn(model, mesh.body, regionOf(mesh, model, e)))
      factors[e] = strength->factor(principalStress(stresses.row(e)));
  return factors;
}

void keepLeast(std::vector<LeastSafety>& least, const std::vector<LeastSafety>& step) {
  if (least.empty()) least = step;
  for (std::size_t i = 0; i < step.size(); ++i)
    if (step[i].factor < least[i].factor) least[i] = step[i];
}

std::vector<std::string> safetyNotes(const ElasticModel& model, const SafetyFactors& factors) {
  std::vector<std::string> notes;
  std::size_t exceeded = 0;
  std::set<std::string> anisotropic;
  for (const LeastSafety& one : factors.ofBodies) {
    const Material& own = one.material(model);
    if (own.law && own.strength && anisotropic.insert(own.name).second)
      notes.push_back("the material '" + own.name + "' is anisotropic, but its strength (" + own.strength->name() +
                      ") is the same in all directions: its safety factors are approximations");
    if (!(one.factor < 1.0) || ++exceeded > kMostWarnings) continue;
    const Material& material = one.material(model);
    std::ostringstream text;
    text.precision(3);
    text << "warning: the stresses of '" << model.bodies[std::size_t(one.body)] << "' exceed the strength of '" << material.name
         << "': safety factor " << one.factor << " (" << material.strength->name() << ") at " << placeText(one.place, model.dimension);
    if (one.step > 0) text << " in load step " << one.step;
    text << ": the linear elastic answer is not valid there";
    notes.push_back(text.str());
  }
  if (exceeded > kMostWarnings)
    notes.push_back("warning: the stresses of " + std::to_string(exceeded - kMostWarnings) +
                    " more bodies exceed their strength: safety in summary.json lists them");
  return notes;
}

}  // namespace suture
