#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <suture/base/Errors.hpp>
#include <suture/base/SceneReader.hpp>
#include <suture/constraints/ConditionData.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Regions.hpp>

namespace suture {

void addModelParameters(Schema& scene) {
  scene.oneOf("Model", "Plane Strain", {"Plane Strain", "Plane Stress"},
              "How the third dimension is treated: no strain across the plane (long bodies), or no stress across it (thin sheets).");
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
  poisson.note = "an incompressible body needs a mixed element: Bodies/<name>/Element";
  return Schema("A material, named by the user.")
      .oneOf("Type", "Isotropic", {"Isotropic"}, "The law: isotropic linear elasticity.")
      .real("Young Modulus", std::nullopt, "Stress over strain in a bar pulled along its axis.", Range::positive(), "stress")
      .real("Poisson Ratio", std::nullopt, "Contraction across over extension along a bar.", poisson);
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
Material materialNamedIn(const Parameters& list, const Parameters& materials, Problems& problems) {
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
  return material;
}

}  // namespace

const Material& ElasticModel::materialOf(const CellBlock& block, int element, int body) const {
  if (materialOfRegion.empty()) return materialOfBody[body];
  if (block.regions.empty()) throw InternalError("the scene has regions, but the mesh does not know which element is in which");
  const int region = block.regions[element];
  return region < 0 ? materialOfBody[body] : materialOfRegion[region];
}

ElasticModel makeElasticModel(const Parameters& scene) {
  ElasticModel model;
  Problems problems;
  const Constants constants = sceneConstants(scene);
  model.plane = textOf(scene, "Model") == "Plane Stress" ? PlaneModel::Stress : PlaneModel::Strain;

  const Parameters& bodies = scene.sublist("Bodies");
  const Parameters& materials = scene.sublist("Materials");
  model.bodies = sublistNames(bodies);
  for (const std::string& body : model.bodies) model.materialOfBody.push_back(materialNamedIn(bodies.sublist(body), materials, problems));
  for (const RegionEntry& region : regionEntries(bodies))
    model.materialOfRegion.push_back(materialNamedIn(*region.list, materials, problems));

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

}  // namespace suture
