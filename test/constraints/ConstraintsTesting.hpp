#pragma once
#include <suture/base/Errors.hpp>
#include <suture/base/SceneReader.hpp>
#include <suture/constraints/BuildConstraints.hpp>
#include <suture/mesh/Generators.hpp>

#include <Teuchos_ParameterList.hpp>

#include <cmath>
#include <functional>
#include <string>

namespace constraintstesting {

using namespace suture;

/// A list of parameters `name`: entries as "name=value" with the type that the value looks like.
inline std::string entry(const std::string& name, const std::vector<std::pair<std::string, std::string>>& parameters) {
  std::string xml = "<ParameterList name=\"" + name + "\">";
  for (const auto& [key, value] : parameters) xml += "<Parameter name=\"" + key + "\" value=\"" + value + "\"/>";
  return xml + "</ParameterList>";
}
inline std::string displacement(const std::string& name, const std::string& group, const std::string& value,
                                const std::string& components = "All") {
  return entry(name, {{"Group", group}, {"Type", "Displacement"}, {"Value", value}, {"Components", components}});
}
inline std::string bilateral(const std::string& name, const std::string& group) {
  return entry(name, {{"Group", group}, {"Type", "Bilateral"}});
}
inline std::string contact(const std::string& name, const std::string& a, const std::string& b) {
  return entry(name, {{"Side A", a}, {"Side B", b}});
}

/// The same, node to node or not at all.
inline std::string matching(const std::string& name, const std::string& a, const std::string& b) {
  return entry(name, {{"Side A", a}, {"Side B", b}, {"Coupling", "Matching Nodes"}});
}

inline Constraints build(const Mesh& mesh, const std::string& conditions, const std::string& contacts = "",
                         const ContactScales& scales = {}) {
  Schema schema("scene");
  schema.list("Boundary Conditions", Schema("conditions").each("condition", boundaryConditionSchema()));
  schema.list("Contact", Schema("lines").each("line", contactSchema()));
  const SceneFile scene = parseScene("<ParameterList name=\"Suture\"><ParameterList name=\"Boundary Conditions\">" + conditions +
                                         "</ParameterList><ParameterList name=\"Contact\">" + contacts + "</ParameterList></ParameterList>",
                                     "test.xml", schema);
  return buildConstraints(mesh, scene.parameters->sublist("Boundary Conditions"), scene.parameters->sublist("Contact"), {{"A", 2.5}},
                          scales);
}

/// What is wrong, one problem a line, or "no error".
inline std::string said(const Mesh& mesh, const std::string& conditions, const std::string& contacts = "") {
  try {
    build(mesh, conditions, contacts);
  } catch (const InputError& error) {
    std::string all;
    for (const Problem& problem : error.problems()) all += problem.path + ": " + problem.message + "\n";
    return all;
  }
  return "no error";
}

/// Blocks [0,4] x [k, k+1], k = 0, 1, ..., of nx x 2 cells, named b0, b1, ...
inline Mesh stack(int count, int nx = 8, Cell cell = Cell::Triangle3) {
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

/// Moves every node of a body.
inline void move(Mesh& mesh, int body, const std::function<Point(Point)>& to) {
  for (int i = 0; i < mesh.nodes(); ++i) {
    if (mesh.bodyOfNode[i] != body) continue;
    const Point p = to(mesh.point(i));
    for (int k = 0; k < 2; ++k) mesh.coordinates[2 * i + k] = p[k];
  }
}
inline void moveAll(Mesh& mesh, const std::function<Point(Point)>& to) {
  for (std::size_t body = 0; body < mesh.bodies.size(); ++body) move(mesh, static_cast<int>(body), to);
}

/// The node of a body nearest to a place.
inline int nodeAt(const Mesh& mesh, int body, double x, double y) {
  int best = -1;
  double least = 1e300;
  for (int i = 0; i < mesh.nodes(); ++i) {
    const double away = std::hypot(mesh.point(i)[0] - x, mesh.point(i)[1] - y);
    if (mesh.bodyOfNode[i] == body && away < least) least = away, best = i;
  }
  return best;
}
inline const NodeRule* ruleAt(const Constraints& constraints, int node) {
  for (const NodeRule& rule : constraints.rules)
    if (rule.node == node) return &rule;
  return nullptr;
}

}  // namespace constraintstesting

/// Asserts that the text `problems` holds `part`, and shows the whole if it does not.
#define SUTURE_CHECK_SAYS(problems, part)                                                    \
  do {                                                                                       \
    const std::string suture_whole = problems, suture_part = part;                           \
    const bool suture_found = suture_whole.find(suture_part) != std::string::npos;           \
    if (!suture_found) out << "not in the message: " << suture_part << "\n" << suture_whole; \
    TEST_ASSERT(suture_found);                                                               \
  } while (false)
