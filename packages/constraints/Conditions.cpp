#include <suture/base/Point.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/ConditionForm.hpp>
#include <suture/mesh/BoxTree.hpp>
#include <suture/mesh/NodeAtPoint.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cctype>

namespace suture {

namespace {

std::string capitalised(std::string text) {
  text[0] = char(std::toupper(text[0]));
  return text;
}

/// Checks that the mesh has the groups and bodies of a condition.
void checkPlace(const Mesh& mesh, const Condition& condition, Problems& problems) {
  const auto wrong = [&](const std::string& parameter, const std::string& what) { problems.add(condition.path + "/" + parameter, what); };
  if (!condition.onSides()) {
    if (!condition.body.empty() && std::find(mesh.bodies.begin(), mesh.bodies.end(), condition.body) == mesh.bodies.end())
      wrong("Body", unknownName("body", condition.body, mesh.bodies));
    return;
  }
  if (condition.groups.empty())
    wrong("Group", "is missing: " + withArticle(formOf(condition.type).name) + " needs a " + mesh.sideGroupKind() + ". " +
                       capitalised(mesh.sideGroupKind()) + "s: " + joinNames(mesh.sideGroupNames()));
  for (const std::string& group : condition.groups)
    if (const std::string problem = sideGroupProblem(mesh, group); !problem.empty()) wrong("Group", problem);
}

/// Finds the node of a condition at a point.
void findNode(const Mesh& mesh, Condition& condition, Problems& problems) {
  if (!condition.point || condition.type == Condition::Type::RigidGroup) return;
  BoundingBox box;
  for (int node = 0; node < mesh.nodes(); ++node) box.include(mesh.point(node));
  NodeAtPoint all(*condition.point, norm(minus(box.high, box.low)));
  for (int node = 0; node < mesh.nodes(); ++node) {
    const int body = mesh.bodyOfNode[std::size_t(node)];
    if (condition.body.empty() || mesh.bodies[std::size_t(body)] == condition.body)
      all.offer({norm(minus(mesh.point(node), *condition.point)), node, body, mesh.point(node)});
  }
  if (const auto found = all.choose(condition.tolerance, mesh.bodies, mesh.dimension, condition.path, problems))
    condition.node = int(found->node);
}

/// Checks components and data of a displacement made in C++; the schema already checks those of a scene file.
void checkComponents(const Mesh& mesh, const Condition& condition, Problems& problems) {
  const std::size_t count = condition.direction ? 1 : condition.components.size(),
                    given = condition.data.expressions.empty() ? condition.data.values.size() : condition.data.expressions.size();
  const bool known =
      std::all_of(condition.components.begin(), condition.components.end(), [&](int k) { return k >= 0 && k < mesh.dimension; });
  if (condition.direction && norm(condition.direction->vector) == 0.0) problems.add(condition.path + "/Direction", "the vector is zero");
  if (count == 0 || !known)
    problems.add(condition.path + "/Components", "expected components between 0 and " + std::to_string(mesh.dimension - 1));
  if (given != count)
    problems.add(condition.path + "/Value", std::to_string(given) + " values for " + std::to_string(count) + " components");
}

/// Checks one entry against the form of its type.
class Entry {
 public:
  Entry(const Mesh& mesh, const Parameters& list, const Constants& constants, Problems& problems)
      : mesh_(mesh), list_(list), constants_(constants), problems_(problems) {}

  Condition read(const std::string& name) {
    const std::size_t before = problems_.list().size();
    condition_.name = name;
    condition_.path = pathOf(list_);
    form_ = &formNamed(list_.get<std::string>("Type"));
    condition_.type = form_->type;
    readPlace();
    readComponents();
    readDirection();
    readData();
    checkSpecials();
    readSupport();
    readMotions();
    if (problems_.list().size() == before) findNode(mesh_, condition_, problems_);
    return condition_;
  }

 private:
  using Type = Condition::Type;

  void wrong(const std::string& parameter, const std::string& what) { problems_.add(pathOf(list_, parameter), what); }

  void readPlace() {
    condition_.groups = groupNames(list_, "Group");
    const std::string subject = withArticle(form_->name);
    readPoint();
    if (list_.isParameter("Group") && form_->place == ConditionForm::Place::Body)
      wrong("Group",
            subject + " acts on a body, not on a " + mesh_.sideGroupKind() + "; name the body in Body, or omit Body for all bodies");
    if (list_.isParameter("Group") && form_->place == ConditionForm::Place::Point)
      wrong("Group", subject + " acts at a point, not on a " + mesh_.sideGroupKind() + "; give its position in Point");
    if (list_.isParameter("Body") && condition_.onSides())
      wrong("Body", subject + " acts on a " + mesh_.sideGroupKind() + (form_->takes("Point") ? " or at a Point" : "") +
                        ", not on a body; name the group in Group");
    else if (list_.isParameter("Body"))
      condition_.body = list_.get<std::string>("Body");
    checkPlace(mesh_, condition_, problems_);
  }

  /// Reads the position of a condition that acts on a side group or at a point.
  void readPoint() {
    if (form_->place != ConditionForm::Place::Sides || !form_->takes("Point")) return;
    if (!list_.isParameter("Point")) {
      if (list_.isParameter("Tolerance")) wrong("Tolerance", "only a condition at a Point takes this parameter");
      return;
    }
    if (list_.isParameter("Group") && condition_.type != Type::RigidGroup)
      wrong("Point", "found together with a Group; expected only one of them");
    const auto& values = list_.get<Teuchos::Array<double>>("Point");
    condition_.point.emplace(Point{0, 0, 0});
    std::copy_n(values.begin(), std::min<std::size_t>(std::size_t(values.size()), 3), condition_.point->begin());
    if (list_.isType<double>("Tolerance")) condition_.tolerance = list_.get<double>("Tolerance");
  }

  void readComponents() {
    const std::string components = list_.get<std::string>("Components");
    if (!form_->isPartial() && components != "All")
      wrong("Components", "only a Displacement or a Mean Displacement takes this parameter; found in " + withArticle(form_->name));
    if (form_->isPartial() && mesh_.dimension == 2 && components.find('z') != std::string::npos)
      wrong("Components", "'" + components + "' in 2D; expected All, x or y");
    if (condition_.type != Type::Displacement) return;
    for (int k = 0; k < mesh_.dimension; ++k)
      if (components == "All" || components.find("xyz"[k]) != std::string::npos) condition_.components.push_back(k);
  }

  /// Reads the direction of a Displacement that prescribes only the component along it.
  void readDirection() {
    const bool isGiven = list_.isParameter("Direction"), hasKind = list_.isParameter("Along");
    if (condition_.type != Type::Displacement || !(isGiven || hasKind)) {
      if (condition_.type == Type::Displacement && list_.isParameter("Axis Point"))
        wrong("Axis Point", "only a Displacement with Along takes this parameter");
      return;
    }
    if (list_.get<std::string>("Components") != "All") wrong("Components", "found together with a direction; expected only one of them");
    SupportDirection direction;
    const auto& names = SupportDirection::names();
    if (hasKind)
      direction.along = SupportDirection::Along(std::find(names.begin(), names.end(), list_.get<std::string>("Along")) - names.begin());
    const bool hasAxis = direction.along != SupportDirection::Along::Direction, isFlat = mesh_.dimension == 2;
    if (hasAxis && isFlat && isGiven) wrong("Direction", "the axis of a 2D scene is perpendicular to the plane; leave Direction out");
    if (hasAxis && mesh_.axisymmetric) wrong("Along", "in axisymmetric scenes x is the radius: use Components");
    if (!isGiven && !(hasAxis && isFlat)) wrong("Direction", "is missing: Along needs it");
    if (!hasAxis && list_.isParameter("Axis Point")) wrong("Axis Point", "a constant direction has no axis");
    readVector("Direction", direction.vector);
    readVector("Axis Point", direction.origin);
    if (isGiven && norm(direction.vector) == 0.0) wrong("Direction", "the vector is zero");
    condition_.direction = direction;
    condition_.components = {0};
  }

  void readVector(const char* name, Point& vector) {
    if (!list_.isParameter(name)) return;
    const auto& values = list_.get<Teuchos::Array<double>>(name);
    vector = {0, 0, 0};
    std::copy_n(values.begin(), std::min<std::size_t>(std::size_t(values.size()), 3), vector.begin());
  }

  void readData() {
    if (!form_->components.empty()) {
      condition_.data = readConditionData(list_, constants_, problems_, mesh_.dimension);
      return;
    }
    std::vector<std::string> names = expressionNames();
    names.push_back("Value");
    const std::string subject = withArticle(form_->name) + (condition_.type == Type::Bilateral ? " condition" : "");
    for (const std::string& name : names)
      if (list_.isParameter(name)) wrong(name, subject + " has no value: " + form_->instead);
  }

  void readSupport() {
    if (condition_.type != Type::ElasticSupport) return;
    for (const auto& [name, value] :
         {std::make_pair("Normal Stiffness", &condition_.normal), {"Tangential Stiffness", &condition_.tangential}})
      if (list_.isType<double>(name)) *value = list_.get<double>(name);
    if (condition_.normal == 0.0 && condition_.tangential == 0.0)
      wrong("Normal Stiffness", "an Elastic Support needs a stiffness above zero, here or in Tangential Stiffness");
  }

  /// Reads the prescribed motions of a Rigid Group.
  void readMotions() {
    if (condition_.type != Type::RigidGroup) return;
    const std::vector<std::string>& names = motionNames();
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (!list_.isParameter(names[k])) continue;
      condition_.motions[k] = list_.get<double>(names[k]);
      if (mesh_.dimension == 2 && (k == 2 || k == 3 || k == 4)) wrong(names[k], "found in 2D; expected Motion x, Motion y or Rotation z");
      if (mesh_.axisymmetric && k != 1)
        wrong(names[k], "found in an axisymmetric scene, where a rigid group moves along the axis only; expected Motion y");
    }
    for (const char* load : {"Force", "Moment"}) {
      if (!list_.isParameter(load)) continue;
      const std::size_t given = static_cast<std::size_t>(list_.get<Teuchos::Array<double>>(load).size()),
                        expected = load[0] == 'M' && mesh_.dimension == 2 ? 1 : static_cast<std::size_t>(mesh_.dimension);
      if (given != expected) wrong(load, std::to_string(given) + " values; expected " + std::to_string(expected));
      if (mesh_.axisymmetric && load[0] == 'M')
        wrong(load, "a Moment cannot act on a body of revolution: it has no resultant around the circle");
    }
  }

  void checkSpecials() {
    for (const std::string& parameter : specialParameters())
      if (!form_->takes(parameter) && list_.isParameter(parameter))
        wrong(parameter, "only " + takersOf(parameter) + " takes this parameter; found in " + withArticle(form_->name));
    for (const std::string& parameter : form_->needs)
      if (!list_.isParameter(parameter)) wrong(parameter, "is missing: " + withArticle(form_->name) + " needs it");
    for (const char* vector : {"Point", "Direction", "Axis Point"})
      if (form_->takes(vector) && list_.isParameter(vector))
        if (const auto count = static_cast<int>(list_.get<Teuchos::Array<double>>(vector).size()); count != mesh_.dimension)
          wrong(vector, std::to_string(count) + " coordinates; expected " + std::to_string(mesh_.dimension));
  }

  const Mesh& mesh_;
  const Parameters& list_;
  const Constants& constants_;
  Problems& problems_;
  Condition condition_;
  const ConditionForm* form_ = nullptr;
};

}  // namespace

bool Condition::onSides() const { return formOf(type).place == ConditionForm::Place::Sides && (!point || type == Type::RigidGroup); }

Condition Condition::displacement(const std::string& group, const std::vector<double>& values, const std::vector<int>& components) {
  Condition condition;
  condition.name = group, condition.path = "Boundary Conditions/" + group;
  condition.type = Type::Displacement;
  condition.groups = {group};
  condition.components = components;
  condition.data.values = values;
  return condition;
}

Condition Condition::along(const std::string& group, const SupportDirection& direction, double value) {
  Condition condition = displacement(group, {value}, {0});
  condition.direction = direction;
  return condition;
}

Condition Condition::pointSupport(const Point& point, const std::vector<double>& values, const std::vector<int>& components) {
  Condition condition = displacement("point support", values, components);
  condition.groups.clear();
  condition.point = point;
  return condition;
}

Condition Condition::bilateral(const std::string& group) {
  Condition condition = displacement(group, {}, {});
  condition.type = Type::Bilateral;
  return condition;
}

std::vector<Condition> conditionsOn(const Mesh& mesh, const std::vector<Condition>& conditions, Problems& problems) {
  std::vector<Condition> sound;
  for (const Condition& condition : conditions) {
    const std::size_t before = problems.list().size();
    checkPlace(mesh, condition, problems);
    if (condition.type == Condition::Type::Displacement) checkComponents(mesh, condition, problems);
    if (problems.list().size() > before) continue;
    sound.push_back(condition);
    findNode(mesh, sound.back(), problems);
    if (problems.list().size() > before) sound.pop_back();
  }
  return sound;
}

std::vector<Condition> readConditions(const Mesh& mesh, const Parameters& conditions, const Constants& constants, Problems& problems) {
  std::vector<Condition> all;
  for (const std::string& name : sublistNames(conditions)) {
    const std::size_t before = problems.list().size();
    const Condition condition = Entry(mesh, conditions.sublist(name), constants, problems).read(name);
    if (problems.list().size() == before) all.push_back(condition);
  }
  return all;
}

}  // namespace suture
