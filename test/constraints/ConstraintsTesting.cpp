#include <constraints/ConstraintsTesting.hpp>

namespace constraintstesting {

std::string entry(const std::string& name, const std::vector<std::pair<std::string, std::string>>& parameters) {
  std::string xml = "<ParameterList name=\"" + name + "\">";
  for (const auto& [key, value] : parameters) xml += "<Parameter name=\"" + key + "\" value=\"" + value + "\"/>";
  return xml + "</ParameterList>";
}

std::string displacement(const std::string& name, const std::string& group, const std::string& value, const std::string& components) {
  return entry(name, {{"Group", group}, {"Type", "Displacement"}, {"Value", value}, {"Components", components}});
}

std::string bilateral(const std::string& name, const std::string& group) { return entry(name, {{"Group", group}, {"Type", "Bilateral"}}); }

std::string contact(const std::string& name, const std::string& a, const std::string& b) {
  return entry(name, {{"Side A", a}, {"Side B", b}});
}

std::string matching(const std::string& name, const std::string& a, const std::string& b) {
  return entry(name, {{"Side A", a}, {"Side B", b}, {"Coupling", "Matching Nodes"}});
}

Constraints build(const Mesh& mesh, const std::string& conditions, const std::string& contacts, const ContactScales& scales) {
  Schema schema("scene");
  schema.list("Boundary Conditions", Schema("conditions").each("condition", boundaryConditionSchema()));
  schema.list("Contact", Schema("lines").each("line", contactSchema()));
  const SceneFile scene = parseScene("<ParameterList name=\"Suture\"><ParameterList name=\"Boundary Conditions\">" + conditions +
                                         "</ParameterList><ParameterList name=\"Contact\">" + contacts + "</ParameterList></ParameterList>",
                                     "test.xml", schema);
  return buildConstraints(mesh, scene.parameters->sublist("Boundary Conditions"), scene.parameters->sublist("Contact"), {{"A", 2.5}},
                          scales);
}

std::string said(const Mesh& mesh, const std::string& conditions, const std::string& contacts) {
  try {
    build(mesh, conditions, contacts);
  } catch (const InputError& error) {
    std::string all;
    for (const Problem& problem : error.problems()) all += problem.path + ": " + problem.message + "\n";
    return all;
  }
  return "no error";
}

Mesh stack(int count, int nx, Cell cell) {
  std::vector<Box> all;
  for (int k = 0; k < count; ++k) {
    Box box;
    box.name = "b" + std::to_string(k);
    box.x1 = 4, box.y0 = k, box.y1 = k + 1;
    box.nx = nx, box.ny = 2;
    box.cell = cell;
    all.push_back(box);
  }
  return boxes(all);
}

int nodeAt(const Mesh& mesh, int body, double x, double y) {
  int best = -1;
  double least = 1e300;
  for (int i = 0; i < mesh.nodes(); ++i) {
    const double away = std::hypot(mesh.point(i)[0] - x, mesh.point(i)[1] - y);
    if (mesh.bodyOfNode[i] == body && away < least) least = away, best = i;
  }
  return best;
}

const NodeRule* ruleAt(const Constraints& constraints, int node) {
  for (const NodeRule& rule : constraints.rules)
    if (rule.node == node) return &rule;
  return nullptr;
}

}  // namespace constraintstesting
