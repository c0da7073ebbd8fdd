#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/ConditionData.hpp>
#include <suture/constraints/ConditionForm.hpp>
#include <suture/elasticity/StressVector.hpp>
#include <suture/elasticity/loads/LoadList.hpp>
#include <suture/mesh/SideGroups.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace suture {

namespace {

using Kind = Load::Kind;

const std::map<Kind, Condition::Type>& types() {
  static const std::map<Kind, Condition::Type> all{{Kind::Traction, Condition::Type::Traction},
                                                   {Kind::Pressure, Condition::Type::Pressure},
                                                   {Kind::BodyForce, Condition::Type::BodyForce},
                                                   {Kind::Random, Condition::Type::RandomLoad},
                                                   {Kind::Gravity, Condition::Type::Gravity},
                                                   {Kind::Rotation, Condition::Type::Rotation},
                                                   {Kind::Force, Condition::Type::Force},
                                                   {Kind::Moment, Condition::Type::Moment},
                                                   {Kind::PointForce, Condition::Type::PointForce},
                                                   {Kind::Temperature, Condition::Type::Temperature},
                                                   {Kind::InitialStrain, Condition::Type::InitialStrain},
                                                   {Kind::InitialStress, Condition::Type::InitialStress}};
  return all;
}

std::string textIn(const Parameters& list, const std::string& name) {
  return list.isType<std::string>(name) ? list.get<std::string>(name) : std::string();
}

double numberIn(const Parameters& list, const std::string& name, double otherwise) {
  return list.isType<double>(name) ? list.get<double>(name) : otherwise;
}

Point pointIn(const Parameters& list, const std::string& name) {
  Point point{0, 0, 0};
  if (!list.isParameter(name)) return point;
  const auto values = list.get<Teuchos::Array<double>>(name);
  std::copy_n(values.begin(), std::min<std::size_t>(values.size(), 3), point.begin());
  return point;
}

/// A single value acts along the axis of rotation: z in 2D, y in axisymmetric scenes.
int firstComponent(Kind kind, const ElasticModel& model) {
  return model.dimension == 2 && (kind == Kind::Moment || kind == Kind::Rotation) ? (model.axisymmetric ? 1 : 2) : 0;
}

/// Indices of the components named by `Components`: "All", "y", "xz".
std::vector<std::size_t> componentsOf(const std::string& text, int dimension) {
  std::vector<std::size_t> all;
  for (const char letter : text == "All" || text.empty() ? std::string("xyz").substr(0, std::size_t(dimension)) : text)
    all.push_back(std::size_t(letter - 'x'));
  return all;
}

Load readLoad(Kind kind, const Parameters& condition, const ElasticModel& model, const Constants& constants, Problems& problems) {
  Load load;
  load.kind = kind;
  load.path = pathOf(condition);
  load.body = textIn(condition, "Body");
  load.groups = groupNames(condition, "Group");
  if (!load.body.empty() && std::find(model.bodies.begin(), model.bodies.end(), load.body) == model.bodies.end())
    problems.add(pathOf(condition, "Body"), unknownName("body", load.body, model.bodies));
  load.place = pointIn(condition, "Point");
  load.tolerance = numberIn(condition, "Tolerance", 0.0);
  if (kind == Kind::Rotation && model.axisymmetric && condition.isParameter("Point"))
    problems.add(pathOf(condition, "Point"), "an axisymmetric body rotates about its axis x = 0; leave Point out");

  if (kind == Kind::Random) {
    if (condition.isType<int>("Seed")) load.seed = condition.get<int>("Seed");
    load.value = {numberIn(condition, "Amplitude", 0.0), numberIn(condition, "Mean", 0.0), 0.0};
    if (!condition.isType<double>("Amplitude"))
      problems.add(pathOf(condition, "Amplitude"), "is missing: a Random Load needs the largest force per node and component");
    return load;
  }
  ConditionData data = readConditionData(condition, constants, problems, model.dimension);
  load.reference = numberIn(condition, "Reference Temperature", 0.0);
  if (load.hasTensor()) std::copy_n(data.values.begin(), std::min(data.values.size(), load.tensor.size()), load.tensor.begin());
  const int first = firstComponent(kind, model);
  for (std::size_t k = 0; !load.hasTensor() && k < data.values.size() && first + k < 3; ++k) load.value[first + k] = data.values[k];
  load.expressions = std::move(data.expressions);
  return load;
}

/// Adds the loads of a Mean Displacement, one per component, or of a Preload.
void readControlled(const Parameters& condition, ElasticModel& model, const Constants& constants, Problems& problems) {
  const std::string type = textIn(condition, "Type");
  if (type != "Mean Displacement" && type != "Preload") return;
  const std::size_t before = problems.list().size();
  const ConditionData data = readConditionData(condition, constants, problems, model.dimension);
  std::vector<Load> loads;
  if (type == "Preload") {
    const Point direction = pointIn(condition, "Direction");
    if (norm(direction) == 0.0)
      problems.add(pathOf(condition, "Direction"), "is missing or zero: a Preload needs the axis of its bolt");
    else if (model.axisymmetric && direction[0] != 0.0)
      problems.add(pathOf(condition, "Direction"), "is not along the axis of a body of revolution; expected {0, 1}");
    else if (numberIn(condition, "Length", 0.0) > 0.0 && data.values.size() == 1)
      loads.push_back(Load::preload(textIn(condition, "Body"), direction, numberIn(condition, "Length", 0.0), data.values[0],
                                    condition.isParameter("Point") ? std::optional<Point>(pointIn(condition, "Point")) : std::nullopt));
    if (const std::string body = textIn(condition, "Body"); std::find(model.bodies.begin(), model.bodies.end(), body) == model.bodies.end())
      problems.add(pathOf(condition, "Body"), body.empty()
                                                  ? "is missing: a Preload needs the body of its bolt. Bodies: " + joinNames(model.bodies)
                                                  : unknownName("body", body, model.bodies));
  } else {
    const std::vector<std::size_t> components = componentsOf(textIn(condition, "Components"), model.dimension);
    for (std::size_t k = 0; k < std::min(components.size(), data.values.size()); ++k) {
      loads.push_back(Load::meanDisplacement("", static_cast<int>(components[k]), data.values[k]));
      loads.back().groups = groupNames(condition, "Group");
      if (model.axisymmetric && components[k] == 0)
        problems.add(pathOf(condition, "Components"), "an axisymmetric group has no mean displacement along x; expected y");
    }
  }
  if (problems.list().size() != before) return;
  for (Load& load : loads) {
    load.path = pathOf(condition);
    load.name = load.path.substr(load.path.rfind('/') + 1);
    model.loads.push_back(load);
  }
}

/// Adds the Force and the Moment of a Rigid Group.
void readReferenceForce(const Parameters& condition, ElasticModel& model, Problems& problems) {
  if (textIn(condition, "Type") != "Rigid Group" || (!condition.isParameter("Force") && !condition.isParameter("Moment"))) return;
  Load load;
  load.kind = Kind::ReferenceForce;
  load.path = pathOf(condition);
  load.name = load.path.substr(load.path.rfind('/') + 1);
  load.groups = groupNames(condition, "Group");
  load.place = pointIn(condition, "Point");
  load.value = pointIn(condition, "Force");
  load.torque = pointIn(condition, "Moment");
  if (model.dimension == 2) load.torque = {0, 0, load.torque[0]};
  if (model.axisymmetric && load.value[0] != 0.0)
    problems.add(pathOf(condition, "Force"), "a radial force has no resultant around the circle; expected {0, force along the axis}");
  model.loads.push_back(load);
}

/// Materials of a load's bodies and of their regions.
std::set<const Material*> materialsUnder(const Load& load, const ElasticModel& model) {
  std::set<const Material*> all;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (load.actsOn(model.bodies[b])) all.insert(&model.materialOfBody[b]);
  for (std::size_t r = 0; r < model.materialOfRegion.size(); ++r)
    if (load.actsOn(model.bodyOfRegion[r])) all.insert(&model.materialOfRegion[r]);
  return all;
}

void checkLoad(const Load& load, const std::string& path, const ElasticModel& model, Problems& problems) {
  const ConditionForm& form = formOf(load.kind);
  const std::string& name = form.name;
  const std::size_t given = load.expressions.size(), wanted = form.componentsIn(model.dimension).size();
  if (given > 0 && (!form.varies || given != wanted))
    problems.add(path, std::to_string(given) + " expressions; expected " +
                           (load.kind == Kind::Random ? "none, the load is random"
                            : form.varies             ? std::to_string(wanted)
                                                      : "none, " + withArticle(name) + " is constant"));
  if (model.axisymmetric && load.kind == Kind::Moment)
    problems.add(path, "a Moment cannot act on a body of revolution: it has no resultant around the circle");
  if (model.axisymmetric && load.kind == Kind::Gravity && load.value[0] != 0.0)
    problems.add(path + "/Value", "radial gravity is not axisymmetric; expected {0, acceleration along the axis}");
  if (model.plane == PlaneModel::Stress && load.kind == Kind::InitialStress && load.tensor[2] != 0.0)
    problems.add(path + "/Value", "a stress zz, which does not exist in plane stress; expected 0 as the third entry");
  std::set<std::string> told;
  const auto demand = [&](const Material* material, const std::optional<double>& value, const std::string& parameter,
                          const std::string& why) {
    if (!value && told.insert(material->name).second)
      problems.add("Materials/" + material->name + "/" + parameter, "is missing: the " + name + " of " + path + " " + why);
  };
  for (const Material* material : materialsUnder(load, model)) {
    if (load.usesDensity()) demand(material, material->density, "Density", "acts on the mass");
    if (load.kind == Kind::Temperature) demand(material, material->expansion, "Thermal Expansion", "acts through it");
  }
}

/// Checks that each body has at most one temperature.
void checkTemperatures(const ElasticModel& model, Problems& problems) {
  for (std::size_t i = 0; i < model.loads.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Load &one = model.loads[j], &other = model.loads[i];
      if (one.kind != Kind::Temperature || other.kind != Kind::Temperature) continue;
      if (one.body.empty() || other.body.empty() || one.body == other.body)
        problems.add(other.path + "/Body", "already has a Temperature, by " + one.path + "; a body has only one");
    }
}

}  // namespace

const ConditionForm& formOf(Load::Kind kind) { return formOf(types().at(kind)); }
const std::string& nameOf(Load::Kind kind) { return formOf(kind).name; }

void Load::setAmount(double amount) {
  if (kind == Kind::InitialStrain) {
    const double strain = -amount / length;
    for (int c = 0; c < 6; ++c) tensor[c] = (c < 3 ? 1.0 : 2.0) * strain * axis[kStressAxes[c][0]] * axis[kStressAxes[c][1]];
  } else {
    value = scaled(amount, axis);
  }
}

Load Load::meanDisplacement(const std::string& group, int component, double value) {
  Load load = force(group, {0, 0, 0});
  load.control = Control::MeanDisplacement;
  load.axis[component] = 1.0;
  load.target = value;
  return load;
}

Load Load::preload(const std::string& body, const Point& direction, double length, double value, const std::optional<Point>& middle) {
  Load load = initialStrain({}, body);
  load.control = Control::SectionForce;
  load.axis = unit(direction);
  load.length = length;
  load.target = value;
  load.isLocal = middle.has_value();
  load.place = middle.value_or(load.place);
  return load;
}

Load Load::rotation(const Point& velocity, const Point& about, const std::string& body) {
  Load load{Kind::Rotation, body, velocity};
  load.place = about;
  return load;
}

Load Load::temperature(double value, double reference, const std::string& body) {
  Load load{Kind::Temperature, body, {value, 0, 0}};
  load.reference = reference;
  return load;
}

Load Load::initialStrain(const std::array<double, 6>& tensor, const std::string& body) {
  Load load{Kind::InitialStrain, body};
  load.tensor = tensor;
  return load;
}

Load Load::initialStress(const std::array<double, 6>& tensor, const std::string& body) {
  Load load = initialStrain(tensor, body);
  load.kind = Kind::InitialStress;
  return load;
}

Load Load::pointForce(const Point& place, const Point& value, const std::string& body) {
  Load load{Kind::PointForce, body, value};
  load.place = place;
  return load;
}

void readLoads(const Parameters& scene, const Constants& constants, ElasticModel& model, Problems& problems) {
  if (!scene.isSublist("Boundary Conditions")) return;
  const Parameters& conditions = scene.sublist("Boundary Conditions");
  for (const std::string& name : sublistNames(conditions)) {
    const Parameters& condition = conditions.sublist(name);
    if (textIn(condition, "Type") == "Elastic Support")
      model.supports.push_back({groupNames(condition, "Group"), numberIn(condition, "Normal Stiffness", 0.0),
                                numberIn(condition, "Tangential Stiffness", 0.0), name});
    readControlled(condition, model, constants, problems);
    readReferenceForce(condition, model, problems);
    for (const auto& [kind, type] : types()) {
      if (formOf(type).name != textIn(condition, "Type")) continue;
      const std::size_t before = problems.list().size();
      model.loads.push_back(readLoad(kind, condition, model, constants, problems));
      model.loads.back().name = name;
      if (problems.list().size() == before) checkLoad(model.loads.back(), model.loads.back().path, model, problems);
    }
  }
  checkTemperatures(model, problems);
}

void checkLoads(const ElasticModel& model, Problems& problems) {
  for (std::size_t i = 0; i < model.loads.size(); ++i)
    checkLoad(model.loads[i], "ElasticModel::loads/" + std::to_string(i + 1), model, problems);
  checkTemperatures(model, problems);
}

std::vector<std::string> loadNotes(const ElasticModel& model) {
  constexpr std::size_t kNamed = 3;
  std::vector<std::string> paths;
  for (const Load& load : model.loads)
    if (load.kind == Kind::PointForce) paths.push_back(load.path.empty() ? "the scene" : load.path);
  if (paths.empty()) return {};
  const std::string singular = " singular: they grow without bound as the mesh is refined";
  if (paths.size() == 1) return {"the Point Force of " + paths[0] + " makes the stresses at its node" + singular};
  std::string named;
  for (std::size_t i = 0; i < std::min(paths.size(), kNamed); ++i) named += (i ? ", " : "") + paths[i];
  if (paths.size() > kNamed) named += " and " + std::to_string(paths.size() - kNamed) + " more";
  return {std::to_string(paths.size()) + " Point Forces (" + named + ") make the stresses at their nodes" + singular};
}

}  // namespace suture
