#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/BuildConstraints.hpp>
#include <suture/constraints/Conditions.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>

namespace suture {

namespace {

const std::vector<std::pair<std::string, Condition::Type>>& types() {
  using T = Condition::Type;
  static const std::vector<std::pair<std::string, T>> all = {{"Displacement", T::Displacement}, {"Bilateral", T::Bilateral},
                                                             {"Traction", T::Traction},         {"Pressure", T::Pressure},
                                                             {"Body Force", T::BodyForce},      {"Random Load", T::RandomLoad}};
  return all;
}

std::string nameOf(Condition::Type type) {
  for (const auto& [name, known] : types())
    if (known == type) return name;
  throw InternalError("a type of boundary condition without a name");
}

/// Groups and bodies of a condition, against those of the mesh.
void checkPlace(const Mesh& mesh, const Condition& condition, Problems& problems) {
  const auto wrong = [&](const std::string& parameter, const std::string& what) { problems.add(condition.path + "/" + parameter, what); };
  if (condition.onBody()) {
    if (!condition.body.empty() && std::find(mesh.bodies.begin(), mesh.bodies.end(), condition.body) == mesh.bodies.end())
      wrong("Body", unknownName("body", condition.body, mesh.bodies));
    return;
  }
  if (condition.groups.empty())
    wrong("Group", "is missing: a " + nameOf(condition.type) + " needs a curve group. Curve groups: " + joinNames(mesh.sideGroupNames()));
  for (const std::string& group : condition.groups) {
    const auto found = mesh.sideGroups.find(group);
    if (found == mesh.sideGroups.end())
      wrong("Group", unknownCurve(mesh, group));
    else if (found->second.empty())
      wrong("Group", "the curve group '" + group + "' of the mesh " + mesh.source + " is empty");
  }
}

/// Components and data of a displacement made in C++; a scene file has only sound ones.
void checkComponents(const Mesh& mesh, const Condition& condition, Problems& problems) {
  const std::size_t count = condition.components.size(),
                    given = condition.data.expressions.empty() ? condition.data.values.size() : condition.data.expressions.size();
  const bool known =
      std::all_of(condition.components.begin(), condition.components.end(), [&](int k) { return k >= 0 && k < mesh.dimension; });
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
    condition_.name = name;
    condition_.path = pathOf(list_);
    typeName_ = list_.get<std::string>("Type");
    for (const auto& [known, type] : types())
      if (known == typeName_) condition_.type = type;
    readPlace();
    readComponents();
    readData();
    readRandom();
    return condition_;
  }

 private:
  using Type = Condition::Type;

  void wrong(const std::string& parameter, const std::string& what) { problems_.add(pathOf(list_, parameter), what); }

  void readPlace() {
    condition_.groups = groupNames(list_, "Group");
    if (list_.isParameter("Group") && condition_.onBody())
      wrong("Group", "a " + typeName_ + " acts on a body, not on a curve group; name it in Body, or leave it out for all bodies");
    if (list_.isParameter("Body") && !condition_.onBody())
      wrong("Body", "only a Body Force or a Random Load has it; found in a " + typeName_);
    else if (list_.isParameter("Body"))
      condition_.body = list_.get<std::string>("Body");
    checkPlace(mesh_, condition_, problems_);
  }

  void readComponents() {
    const std::string components = list_.get<std::string>("Components");
    if (condition_.type != Type::Displacement) {
      if (components != "All") wrong("Components", "only a Displacement has it; found in a " + typeName_);
      return;
    }
    if (components != "y") condition_.components.push_back(0);
    if (components != "x") condition_.components.push_back(1);
  }

  void readData() {
    const bool random = condition_.type == Type::RandomLoad;
    if (condition_.type != Type::Bilateral && !random) {
      condition_.data = readConditionData(list_, constants_, problems_);
      return;
    }
    std::vector<std::string> names = expressionNames();
    names.push_back("Value");
    for (const std::string& name : names)
      if (list_.isParameter(name))
        wrong(name, random ? "a Random Load has no value: it has Amplitude and Seed"
                           : "a Bilateral condition has no value: the normal displacement is zero");
  }

  void readRandom() {
    const bool random = condition_.type == Type::RandomLoad;
    for (const char* name : {"Seed", "Amplitude", "Mean"})
      if (!random && list_.isParameter(name)) wrong(name, "only a Random Load has it; found in a " + typeName_);
    if (random && !list_.isParameter("Amplitude")) wrong("Amplitude", "is missing: a Random Load needs the largest force on a component");
  }

  const Mesh& mesh_;
  const Parameters& list_;
  const Constants& constants_;
  Problems& problems_;
  Condition condition_;
  std::string typeName_;
};

}  // namespace

Condition Condition::displacement(const std::string& group, const std::vector<double>& values, const std::vector<int>& components) {
  Condition condition;
  condition.name = group, condition.path = "Boundary Conditions/" + group;
  condition.type = Type::Displacement;
  condition.groups = {group};
  condition.components = components;
  condition.data.values = values;
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
    if (problems.list().size() == before) sound.push_back(condition);
  }
  return sound;
}

std::string unknownCurve(const Mesh& mesh, const std::string& group) {
  return "in the mesh " + mesh.source + ": " + unknownName("curve group", group, mesh.sideGroupNames());
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

Schema boundaryConditionSchema() {
  std::vector<std::string> names;
  for (const auto& entry : types()) names.push_back(entry.first);
  return Schema("one boundary condition; several may meet at a corner")
      .texts("Group", std::nullopt,
             "curve group of the mesh on which it acts, or several as {left, right}; not for a Body Force or Random Load")
      .orOne()
      .optional()
      .oneOf("Type", std::nullopt, names,
             "Displacement: given; Bilateral: normal displacement zero, free to slide; Traction: force vector on an area of the undeformed "
             "body; Pressure: > 0 pushes into the body; Body Force: force on a volume; Random Load: forces on all nodes of a "
             "body, for studies of solvers")
      .reals("Value", std::nullopt,
             "Displacement: one entry a component [length]; Traction: two [stress]; Pressure: one [stress]; Body Force: two "
             "[force / volume]; none for Bilateral and Random Load")
      .optional()
      .text("Expression x", std::nullopt,
            "instead of Value: the component along x as a function of x and y, the place on the undeformed body. Known are the names in "
            "Constants and Functions, pi, + - * / ^, comparisons, c ? a : b, and sqrt, sin, atan2, exp, ln, abs, min and others; in the "
            "file < is written &lt;")
      .optional()
      .text("Expression y", std::nullopt, "the same of the component along y")
      .optional()
      .text("Expression", std::nullopt, "the same of a Pressure")
      .optional()
      .oneOf("Components", "All", {"All", "x", "y"}, "components that a Displacement prescribes; the others are free")
      .text("Body", std::nullopt, "body on which a Body Force or Random Load acts; all bodies if left out")
      .optional()
      .integer("Seed", std::nullopt,
               "of a Random Load, whose forces depend on it, on the number of the node and on the component only; 0 if left out")
      .optional()
      .real("Amplitude", std::nullopt, "of a Random Load: forces are uniform between minus and plus this", Range::positive(), "force")
      .optional()
      .real("Mean", std::nullopt, "of a Random Load, added to every component; 0 if left out", Range::any(), "force")
      .optional();
}

}  // namespace suture
