#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <set>
#include <sstream>
#include <suture/base/Errors.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/ConditionData.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Regions.hpp>

namespace suture {

namespace {
constexpr const char* kAxisymmetric = "Axisymmetric";
constexpr const char* kMixed = "Mixed";
constexpr const char* kAutomatic = "Automatic";
}  // namespace

void addModelParameters(Schema& scene) {
  scene.oneOf(
      "Model", "Plane Strain", {"Plane Strain", "Plane Stress", kAxisymmetric},
      "How the third dimension is treated: no strain across the plane (long bodies), no stress across it (thin sheets), or bodies of "
      "revolution about the axis x = 0: x >= 0 is the radius and y runs along the axis, on which u_x = 0 without being said. Forces "
      "(loads on sides and bodies, reactions, contact) are those of the whole circle, not of a radian; the sums of their radial "
      "components are sums of magnitudes round the circle.");
}

Schema bodySchema() {
  return Schema("A body: named like its surface group in the mesh.")
      .text("Material", std::nullopt, "Name of its entry in the list Materials.")
      .list("Regions", Schema("Parts of the body with a material of their own; the rest has the body's.")
                           .each("region", Schema("A part of a body, named by the user.")
                                               .text("Group", std::nullopt, "Its surface group in the mesh.")
                                               .text("Material", std::nullopt, "Name of its entry in the list Materials.")));
}

Schema materialSchema() {
  Range poisson;
  poisson.low = -1.0;
  poisson.high = 0.5;
  poisson.lowOpen = poisson.highOpen = true;
  poisson.note = "the elements Displacement and Mixed of Materials/<name>/Element go up to 0.4999 and further, not to 0.5 itself";
  return Schema("A material, named by the user.")
      .oneOf("Type", "Isotropic", {"Isotropic"}, "The law: isotropic linear elasticity.")
      .real("Young Modulus", std::nullopt, "Stress over strain in a bar pulled along its axis.", Range::positive(), "stress")
      .real("Poisson Ratio", std::nullopt, "Contraction across over extension along a bar.", poisson)
      .oneOf(
          "Element", kAutomatic, {kAutomatic, "Displacement", kMixed},
          "Unknowns of the elements of this material. Automatic: Mixed with a Poisson ratio above 0.49 (plane strain, axisymmetric), else "
          "Displacement. Mixed: also a pressure in each element, discontinuous and eliminated there, for "
          "nearly incompressible materials, where Displacement elements lock: constant in Quadrilateral4, Quadrilateral8 and Triangle6, "
          "linear in Quadrilateral9; not for 3-node triangles, and not in plane stress, where nothing locks.")
      .boolean("Allow Locking", false,
               "Accept 3-node triangles with a Poisson ratio above 0.49 (plane strain, axisymmetric), as Displacement elements: they are "
               "much too "
               "stiff there, and a warning says so.");
}

Matrix elasticity(const Material& material, PlaneModel plane, int dimension) {
  const double young = material.young, nu = material.poisson;
  const double shear = young / (2.0 * (1.0 + nu));
  // Plane stress: the Lame constant that remains after the stress across has been eliminated.
  const bool sheet = dimension == 2 && plane == PlaneModel::Stress;
  const double lambda = sheet ? young * nu / (1.0 - nu * nu) : young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
  const int normals = dimension, voigt = dimension == 2 ? 3 : 6;
  Matrix d = Matrix::Zero(voigt, voigt);
  d.topLeftCorner(normals, normals).setConstant(lambda);
  d.diagonal().head(normals).array() += 2.0 * shear;
  d.diagonal().tail(voigt - normals).setConstant(shear);
  return d;
}

namespace {

Load::Kind kindOf(const std::string& type) {
  if (type == "Traction") return Load::Kind::Traction;
  if (type == "Pressure") return Load::Kind::Pressure;
  if (type == "Random Load") return Load::Kind::Random;
  return Load::Kind::BodyForce;
}

bool isLoad(const std::string& type) { return type == "Traction" || type == "Pressure" || type == "Body Force" || type == "Random Load"; }

std::string textOf(const Parameters& list, const std::string& name) {
  return list.isType<std::string>(name) ? list.get<std::string>(name) : std::string();
}

Load loadOf(const Parameters& condition, const std::vector<std::string>& bodies, const Constants& constants, Problems& problems) {
  Load load;
  const std::string type = textOf(condition, "Type");
  load.kind = kindOf(type);
  load.group = textOf(condition, load.onBody() ? "Body" : "Group");
  if (load.onBody() && !load.group.empty() && std::find(bodies.begin(), bodies.end(), load.group) == bodies.end())
    problems.add(pathOf(condition, "Body"), unknownName("body", load.group, bodies));

  if (load.kind == Load::Kind::Random) {
    if (condition.isType<int>("Seed")) load.seed = condition.get<int>("Seed");
    if (condition.isType<double>("Mean")) load.value[1] = condition.get<double>("Mean");
    if (condition.isType<double>("Amplitude"))
      load.value[0] = condition.get<double>("Amplitude");
    else
      problems.add(pathOf(condition, "Amplitude"), "is missing: a Random Load needs the largest force on a node's component");
    return load;
  }
  ConditionData data = readConditionData(condition, constants, problems);
  std::copy_n(data.values.begin(), std::min<std::size_t>(data.values.size(), 2), load.value.begin());
  load.expressions = std::move(data.expressions);
  return load;
}

// What the parameter `Material` of a list names.
Material materialNamedIn(const Parameters& list, const Parameters& materials, PlaneModel plane, Problems& problems) {
  Material material;
  material.name = list.get<std::string>("Material");
  const std::vector<std::string> known = sublistNames(materials);
  if (std::find(known.begin(), known.end(), material.name) == known.end()) {
    problems.add(pathOf(list, "Material"), unknownName("material", material.name, known));
    return material;
  }
  const Parameters& own = materials.sublist(material.name);
  material.young = own.get<double>("Young Modulus");
  material.poisson = own.get<double>("Poisson Ratio");
  const std::string element = textOf(own, "Element");
  material.named = !element.empty() && element != kAutomatic;
  material.allowLocking = own.isType<bool>("Allow Locking") && own.get<bool>("Allow Locking");
  const bool locks = plane == PlaneModel::Strain && material.poisson > kLockingPoisson && !material.allowLocking;
  if (element == kMixed || (!material.named && locks)) material.element = ElementForm::Mixed;
  return material;
}

}  // namespace

const Material& ElasticModel::materialOf(const CellBlock& block, int element, int body) const {
  if (materialOfRegion.empty()) return materialOfBody[body];
  if (block.regions.empty()) throw InternalError("the scene has regions, but the mesh does not know which element is in which");
  const int region = block.regions[element];
  return region < 0 ? materialOfBody[body] : materialOfRegion[region];
}

bool ElasticModel::nearlyIncompressible() const {
  const auto stiff = [](const Material& material) { return material.poisson > 0.45; };
  return plane == PlaneModel::Strain && (std::any_of(materialOfBody.begin(), materialOfBody.end(), stiff) ||
                                         std::any_of(materialOfRegion.begin(), materialOfRegion.end(), stiff));
}

bool isAxisymmetric(const Parameters& scene) { return textOf(scene, "Model") == kAxisymmetric; }

void requireGeometry(const CellBlock& block, const ElasticModel& model) {
  if (block.axisymmetric != model.axisymmetric)
    throw InternalError(model.axisymmetric ? "the scene is axisymmetric, but the mesh was not told (makeAxisymmetric)"
                                           : "the mesh is axisymmetric, but the scene is not");
}

void checkElements(const CellBlock& block, const std::function<int(int element)>& bodyOf, const ElasticModel& model, Problems& problems) {
  std::set<std::pair<const Material*, int>> seen;
  for (int e = 0; e < block.elements(); ++e) {
    if (block.cells[e] != Cell::Triangle3) continue;
    const int body = bodyOf(e);
    const Material& material = model.materialOf(block, e, body);
    const bool mixed = material.named && material.element == ElementForm::Mixed;
    const bool locks = model.plane == PlaneModel::Strain && material.poisson > kLockingPoisson && !material.allowLocking && !material.named;
    if ((!mixed && !locks) || !seen.insert({&material, body}).second) continue;
    std::ostringstream text;
    if (mixed)
      text << "Mixed, but the body '" << model.bodies[body] << "' has 3-node triangles, for which there is no stable pressure";
    else
      text << material.poisson << " with 3-node triangles in the body '" << model.bodies[body] << "': above " << kLockingPoisson
           << " they lock (the body becomes far too stiff)";
    text << ". Mesh it with 6-node triangles or quadrilaterals";
    if (!mixed)
      text << ", for which Materials/" << material.name << "/Element = Mixed is chosen, or choose Displacement there, or set Materials/"
           << material.name << "/Allow Locking, if locking is what you want to see";
    Problem found{"Materials/" + material.name + (mixed ? "/Element" : "/Poisson Ratio"), text.str()};
    const auto& all = problems.list();
    if (std::none_of(all.begin(), all.end(), [&](const Problem& p) { return p.path == found.path && p.message == found.message; }))
      problems.add(found.path, found.message);
  }
}

ElasticModel makeElasticModel(const Parameters& scene) {
  ElasticModel model;
  Problems problems;
  const Constants constants = sceneConstants(scene);
  model.plane = textOf(scene, "Model") == "Plane Stress" ? PlaneModel::Stress : PlaneModel::Strain;
  model.axisymmetric = isAxisymmetric(scene);

  const Parameters& bodies = scene.sublist("Bodies");
  const Parameters& materials = scene.sublist("Materials");
  model.bodies = sublistNames(bodies);
  for (const std::string& body : model.bodies)
    model.materialOfBody.push_back(materialNamedIn(bodies.sublist(body), materials, model.plane, problems));
  for (const RegionEntry& region : regionEntries(bodies))
    model.materialOfRegion.push_back(materialNamedIn(*region.list, materials, model.plane, problems));
  if (model.plane == PlaneModel::Stress)
    for (const std::string& name : sublistNames(materials))
      if (textOf(materials.sublist(name), "Element") == kMixed)
        problems.add(pathOf(materials.sublist(name), "Element"),
                     "Mixed in plane stress, where no element locks: a sheet is free to change its thickness. Choose Displacement");

  if (scene.isSublist("Boundary Conditions")) {
    const Parameters& conditions = scene.sublist("Boundary Conditions");
    for (const std::string& name : sublistNames(conditions))
      if (isLoad(textOf(conditions.sublist(name), "Type")))
        model.loads.push_back(loadOf(conditions.sublist(name), model.bodies, constants, problems));
  }
  if (scene.isSublist("Exact Solution"))
    model.exact = readExactSolution(scene.sublist("Exact Solution"), model.bodies, constants, problems);
  problems.throwIfAny();
  return model;
}

double contactCompliance(const Material& material, PlaneModel plane) {
  return (plane == PlaneModel::Stress ? 1.0 : 1.0 - material.poisson * material.poisson) / material.young;
}

}  // namespace suture
