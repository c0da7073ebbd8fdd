#include <Eigen/Cholesky>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <set>
#include <sstream>
#include <suture/base/Errors.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/HookesLaw.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/elasticity/loads/LoadList.hpp>
#include <suture/mesh/Regions.hpp>

namespace suture {

namespace {
constexpr const char *kPlaneStrain = "Plane Strain", *kPlaneStress = "Plane Stress", *kAxisymmetric = "Axisymmetric", *kSolid = "Solid";
constexpr const char* kMixed = "Mixed";
constexpr const char* kAutomatic = "Automatic";
}  // namespace

void addModelParameters(Schema& scene) {
  scene.oneOf("Model", kPlaneStrain, {kPlaneStrain, kPlaneStress, kAxisymmetric, kSolid},
              "Solid: 3D bodies, meshed by volume elements. The other models define the third dimension: no out-of-plane strain (long "
              "bodies), no out-of-plane stress (thin sheets), or bodies of revolution about the axis x = 0: x >= 0 is the radius and y "
              "runs along the axis, on which u_x = 0 is imposed automatically. Forces (loads on sides and bodies, reactions, contact) are "
              "those of the whole circle, not per radian; the sums of their radial components are sums of magnitudes around the circle.");
}

Schema bodySchema() {
  return Schema("A body, with the name of its surface group (3D: volume group) in the mesh.")
      .text("Material", std::nullopt, "Name of its entry in the list Materials, in one of the Material Files, or of a built-in material.")
      .list("Regions", Schema("Parts of the body with a different material; the rest has the body's material.")
                           .each("region", Schema("A part of a body, named by the user.")
                                               .text("Group", std::nullopt, "Its surface group (3D: volume group) in the mesh.")
                                               .text("Material", std::nullopt, "Its material, like that of a body.")));
}

Schema materialSchema() {
  Schema material("A material, named by the user.");
  material
      .choice("Type", IsotropicLaw::kName, Registry<MaterialLaw>::instance().schemas(),
              "The linear elastic law; its parameters are in the list of the same name, those of Isotropic next to Type.",
              IsotropicLaw::kName)
      .oneOf("Element", kAutomatic, {kAutomatic, "Displacement", kMixed},
             "Elements of this material. Automatic: 4-node quadrilaterals and 8-node hexahedra have enhanced strains, which the element "
             "eliminates, so that they lock neither in bending nor as nu tends to 0.5; the others are Mixed with a Poisson ratio above "
             "0.49 (not in plane stress), else Displacement. Displacement: the plain displacement element; with 4 or 8 nodes it is much "
             "too stiff in bending. Mixed: adds a pressure in each element, discontinuous and eliminated there, for nearly incompressible "
             "materials, where Displacement elements lock: linear in Quadrilateral9 and Hexahedron27, constant in the others; not "
             "available for 3-node triangles and 4-node tetrahedra, nor in plane stress, where nothing locks.")
      .real("Density", std::nullopt,
            "Mass per volume, for Gravity and Rotation, in units for which density x length / time^2 x length is a stress, e.g. kg/m^3 "
            "with N, m, s or t/mm^3 with N, mm, s.",
            Range::atLeast(0.0), "mass / volume")
      .optional()
      .real("Thermal Expansion", std::nullopt, "Strain of a free body along any direction per unit of Temperature.", Range::any(),
            "1 / temperature")
      .optional()
      .boolean("Allow Locking", false,
               "Accept 3-node triangles and 4-node tetrahedra with a Poisson ratio above 0.49 (except in plane stress) as Displacement "
               "elements. They are much too stiff there, and a warning is printed.");
  addStrengthParameters(material);
  return material
      .text("Based On", std::nullopt,
            "Name of another material of this scene, its Material Files or the built-in file: its values apply where this entry has none.")
      .optional()
      .text("Title", std::nullopt, "What the material is, for people.")
      .optional()
      .text("Source", std::nullopt, "Where the values come from: standard, handbook, test report.")
      .optional()
      .text("Remarks", std::nullopt, "Range and limits of the values.")
      .optional();
}

Matrix elasticity(const Material& material, PlaneModel plane, int dimension) {
  if (dimension == 3) return material.stiffness();
  const Eigen::Matrix4d c = planePart(material.stiffness());
  const Eigen::Vector3i inPlane(0, 1, 3);
  Eigen::Matrix3d d;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) d(i, j) = c(inPlane[i], inPlane[j]);
  if (plane == PlaneModel::Strain) return d;
  // Eliminates the out-of-plane stress, in closed form where one exists: near nu = 0.5 the difference loses digits.
  if (material.law) {
    const Eigen::Vector3d across(c(0, 2), c(1, 2), c(3, 2));
    return d - across * across.transpose() / c(2, 2);
  }
  const double lambda = material.young * material.poisson / (1.0 - material.poisson * material.poisson);
  d.topLeftCorner<2, 2>().setConstant(lambda);
  d.diagonal().head<2>().array() += 2.0 * c(3, 3);
  return d;
}

namespace {

std::string textOf(const Parameters& list, const std::string& name) {
  return list.isType<std::string>(name) ? list.get<std::string>(name) : std::string();
}

// \param number  of the law in the scene, from 1. \throws InputError  if it is invalid or cannot be used in 2D
void setLaw(Material& material, std::shared_ptr<const MaterialLaw> law, int number, int dimension) {
  const std::optional<IsotropicModuli> moduli = law->isotropic();
  if (!moduli && dimension == 2) planePart(law->stiffness());  // throws
  const auto [young, poisson] = moduli ? *moduli : nearestIsotropic(law->stiffness());
  material.young = young;
  material.poisson = poisson;
  if (moduli) return;
  material.law = std::move(law);
  material.number = number;
}

// Adds a problem unless it is known: bodies and regions may share a material.
void addOnce(const Problem& problem, Problems& problems) {
  const auto& all = problems.list();
  if (std::none_of(all.begin(), all.end(), [&](const Problem& p) { return p.path == problem.path && p.message == problem.message; }))
    problems.add(problem.path, problem.message);
}

// Reads the law of an entry of Materials; false if it is invalid. `number`: of the entry, from 1.
bool readLaw(const Parameters& entry, int number, int dimension, Material& material, Problems& problems) {
  const std::string type = entry.get<std::string>("Type");
  try {
    setLaw(material, Registry<MaterialLaw>::instance().make(type, entry.isSublist(type) ? entry.sublist(type) : entry), number, dimension);
    return true;
  } catch (const InputError& error) {
    for (Problem problem : error.problems()) {
      if (problem.path == MaterialLaw::kind()) problem.path = pathOf(entry, entry.isSublist(type) ? type : "Type");
      addOnce(problem, problems);
    }
    return false;
  }
}

void readStrength(const Parameters& entry, Material& material, Problems& problems) {
  Problems found;
  material.strength = strengthOf(entry, found);
  for (const Problem& problem : found.list()) addOnce(problem, problems);
}

// True if the law remains positive definite without the couplings that Mixed elements replace by a pressure.
bool mayBeMixed(const Material& material) {
  Material mixed = material;
  mixed.element = ElementForm::Mixed;
  return Eigen::LLT<ElasticStiffness>(HookesLaw<3>(mixed, PlaneModel::Strain).pointwise).info() == Eigen::Success;
}

bool isMixedOfItself(const Material& material, PlaneModel plane) {
  return plane == PlaneModel::Strain && material.poisson > kLockingPoisson && !material.allowLocking && mayBeMixed(material);
}

// The material named by the parameter `Material` of a list.
Material materialNamedIn(const Parameters& list, const Parameters& materials, const ElasticModel& model, Problems& problems) {
  const PlaneModel plane = model.plane;
  Material material;
  material.name = list.get<std::string>("Material");
  const std::vector<std::string> known = sublistNames(materials);
  const auto found = std::find(known.begin(), known.end(), material.name);
  if (found == known.end()) {
    problems.add(pathOf(list, "Material"), unknownName("material", material.name, known));
    return material;
  }
  const Parameters& own = materials.sublist(material.name);
  if (!readLaw(own, static_cast<int>(found - known.begin()) + 1, model.dimension, material, problems)) return material;
  const std::string element = textOf(own, "Element");
  material.named = !element.empty() && element != kAutomatic;
  material.enhanced = !material.named;
  if (own.isType<double>("Density")) material.density = own.get<double>("Density");
  if (own.isType<double>("Thermal Expansion")) {
    material.expansion = own.get<double>("Thermal Expansion");
    material.number = static_cast<int>(found - known.begin()) + 1;  // stresses jump where the expansion jumps
  }
  readStrength(own, material, problems);
  material.allowLocking = own.isType<bool>("Allow Locking") && own.get<bool>("Allow Locking");
  if (element == kMixed || (!material.named && isMixedOfItself(material, plane))) material.element = ElementForm::Mixed;
  if (element == kMixed && plane == PlaneModel::Strain && !mayBeMixed(material))
    problems.add(pathOf(own, "Element"), "Mixed, but without the coupling of normal strains the law " + own.get<std::string>("Type") +
                                             " with these moduli is not positive definite. Choose Displacement");
  return material;
}

}  // namespace

const Material& ElasticModel::materialOf(const CellBlock& block, int element, int body) const {
  if (materialOfRegion.empty()) return materialOfBody[body];
  if (block.regions.empty()) throw InternalError("the scene has regions, but the mesh has no region numbers (assignRegions)");
  const int region = block.regions[element];
  return region < 0 ? materialOfBody[body] : materialOfRegion[region];
}

void ElasticModel::addBody(const std::string& body, std::shared_ptr<const MaterialLaw> law) {
  law->stiffness();  // throws
  Material material;
  material.name = body;
  setLaw(material, std::move(law), int(bodies.size()) + 1, dimension);
  if (isMixedOfItself(material, plane)) material.element = ElementForm::Mixed;
  material.enhanced = true;
  bodies.push_back(body);
  materialOfBody.push_back(material);
}

bool ElasticModel::hasStrength() const {
  const auto has = [](const Material& material) { return material.strength != nullptr; };
  return std::any_of(materialOfBody.begin(), materialOfBody.end(), has) ||
         std::any_of(materialOfRegion.begin(), materialOfRegion.end(), has);
}

bool ElasticModel::nearlyIncompressible() const {
  const auto stiff = [](const Material& material) { return material.poisson > 0.45; };
  return plane == PlaneModel::Strain && (std::any_of(materialOfBody.begin(), materialOfBody.end(), stiff) ||
                                         std::any_of(materialOfRegion.begin(), materialOfRegion.end(), stiff));
}

bool isAxisymmetric(const Parameters& scene) { return textOf(scene, "Model") == kAxisymmetric; }

int sceneDimension(const Parameters& scene) { return textOf(scene, "Model") == kSolid ? 3 : 2; }

std::string modelName(const ElasticModel& model) {
  if (model.dimension == 3) return kSolid;
  return model.axisymmetric ? kAxisymmetric : model.plane == PlaneModel::Stress ? kPlaneStress : kPlaneStrain;
}

void requireGeometry(const CellBlock& block, const ElasticModel& model) {
  if (block.dimension != model.dimension)
    throw InternalError("the model is " + modelName(model) + ", but the mesh has dimension " + std::to_string(block.dimension));
  if (block.axisymmetric != model.axisymmetric)
    throw InternalError(model.axisymmetric ? "the scene is axisymmetric, but makeAxisymmetric() was not called for the mesh"
                                           : "the mesh is axisymmetric, but the scene is not");
}

void requireDimension(const CellBlock& mesh, const std::string& source, const ElasticModel& model) {
  if (mesh.dimension == model.dimension) return;
  throw InputError(
      "Model", model.dimension == 2
                   ? "'" + modelName(model) + "' needs a plane mesh; the mesh " + source + " has volume elements: expected '" + kSolid + "'"
                   : "'" + modelName(model) + "' needs volume elements; the mesh " + source + " is plane: expected '" + kPlaneStrain +
                         "', '" + kPlaneStress + "' or '" + kAxisymmetric + "'");
}

void checkElements(const CellBlock& block, const std::function<int(int element)>& bodyOf, const ElasticModel& model, Problems& problems) {
  std::set<std::pair<const Material*, int>> seen;
  for (int e = 0; e < block.elements(); ++e) {
    if (block.cells[e] != Cell::Triangle3 && block.cells[e] != Cell::Tetrahedron4) continue;
    const std::string kind = block.dimension == 2 ? "3-node triangles" : "4-node tetrahedra";
    const int body = bodyOf(e);
    const Material& material = model.materialOf(block, e, body);
    const bool mixed = material.named && material.element == ElementForm::Mixed;
    const bool locks = model.plane == PlaneModel::Strain && material.poisson > kLockingPoisson && !material.allowLocking && !material.named;
    if ((!mixed && !locks) || !seen.insert({&material, body}).second) continue;
    std::ostringstream text;
    if (mixed)
      text << "Mixed, but the body '" << model.bodies[body] << "' has " << kind << ", which have no stable pressure";
    else
      text << material.poisson << " with " << kind << " in the body '" << model.bodies[body] << "': above " << kLockingPoisson
           << " they lock (the body becomes far too stiff)";
    text << ". Mesh it with " << (block.dimension == 2 ? "6-node triangles or quadrilaterals" : "10-node tetrahedra or hexahedra");
    if (!mixed)
      text << ", for which Materials/" << material.name << "/Element = Mixed is chosen, or choose Displacement there, or set Materials/"
           << material.name << "/Allow Locking to accept locking";
    Problem found{"Materials/" + material.name + (mixed ? "/Element" : "/Poisson Ratio"), text.str()};
    addOnce(found, problems);
  }
}

ElasticModel makeElasticModel(const Parameters& scene) {
  ElasticModel model;
  Problems problems;
  const Constants constants = sceneConstants(scene);
  model.plane = textOf(scene, "Model") == kPlaneStress ? PlaneModel::Stress : PlaneModel::Strain;
  model.axisymmetric = isAxisymmetric(scene);
  model.dimension = sceneDimension(scene);

  const Parameters& bodies = scene.sublist("Bodies");
  const Parameters& materials = scene.sublist("Materials");
  model.bodies = sublistNames(bodies);
  for (const std::string& body : model.bodies)
    model.materialOfBody.push_back(materialNamedIn(bodies.sublist(body), materials, model, problems));
  for (const RegionEntry& region : regionEntries(bodies)) {
    model.materialOfRegion.push_back(materialNamedIn(*region.list, materials, model, problems));
    model.bodyOfRegion.push_back(region.body);
  }
  if (model.plane == PlaneModel::Stress)
    for (const std::string& name : sublistNames(materials))
      if (textOf(materials.sublist(name), "Element") == kMixed)
        problems.add(pathOf(materials.sublist(name), "Element"),
                     "Mixed in plane stress, where no element locks, because the thickness is free to change. Choose Displacement");

  readLoads(scene, constants, model, problems);
  if (scene.isSublist("Exact Solution"))
    model.exact = readExactSolution(scene.sublist("Exact Solution"), model.bodies, model.dimension, constants, problems);
  problems.throwIfAny();
  return model;
}

double contactCompliance(const Material& material, PlaneModel plane) {
  return (plane == PlaneModel::Stress ? 1.0 : 1.0 - material.poisson * material.poisson) / material.young;
}

}  // namespace suture
