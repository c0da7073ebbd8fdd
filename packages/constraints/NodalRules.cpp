#include <suture/base/Point.hpp>
#include <suture/constraints/ContactSurface.hpp>
#include <suture/constraints/NodalRules.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/SideGeometry.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <tuple>

namespace suture {

namespace {

const double sameDirection = 1e-6;  // sine, below which two directions are one
const double sameValue = 1e-9;      // relative

/// direction . u = value
struct Row {
  Point direction{0, 0, 0};
  double value = 0;
  int condition = -1;
};
using Rows = std::map<int, std::vector<Row>>;  // node -> rows

/// \param problems  gets the first place where an expression has no finite value
void addDisplacement(const Mesh& mesh, const std::vector<Condition>& conditions, int number, Rows& rows, Problems& problems) try {
  const Condition& condition = conditions[number];
  std::set<int> nodes;
  for (const Side& side : sidesOf(mesh.sideGroups, condition.groups))
    for (const int node : mesh.nodesOf(side)) nodes.insert(node);
  for (const int node : nodes)
    for (std::size_t i = 0; i < condition.components.size(); ++i) {
      Row row;
      row.direction[condition.components[i]] = 1;
      row.value = condition.data.at(i, mesh.point(node));
      row.condition = number;
      rows[node].push_back(row);
    }
} catch (const InputError& error) {
  problems.add(error);
}

// All conditions together: a round wall named in two pieces must not get two nearly parallel rows where the pieces meet.
void addBilateral(const Mesh& mesh, const std::vector<Condition>& conditions, Rows& rows) {
  struct Bundle {
    Point sum;  // sum of the normals, weighted by length
    std::set<int> conditions;
  };
  std::map<int, std::vector<Bundle>> bundles;
  std::set<std::pair<int, int>> seen;
  for (int number = 0; number < static_cast<int>(conditions.size()); ++number) {
    if (conditions[number].type != Condition::Type::Bilateral) continue;
    for (const Side& side : sidesOf(mesh.sideGroups, conditions[number].groups)) {
      if (!seen.insert({side.element, side.side}).second) continue;
      const std::vector<int> nodes = mesh.nodesOf(side);
      std::vector<Point> points;
      for (const int node : nodes) points.push_back(mesh.point(node));
      const std::vector<NodeNormal> normals = nodeNormals(points, mesh.dimension);
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        std::vector<Bundle>& here = bundles[nodes[i]];
        const Point normal = scaled(normals[i].weight, normals[i].density);
        const auto like =
            std::find_if(here.begin(), here.end(), [&](const Bundle& b) { return angleBetween(b.sum, normal) <= kSharpAngle; });
        if (like == here.end())
          here.push_back({normal, {number}});
        else
          like->sum = plus(like->sum, normal), like->conditions.insert(number);
      }
    }
  }
  for (const auto& [node, here] : bundles)
    for (const Bundle& bundle : here)
      for (const int condition : bundle.conditions) rows[node].push_back({unit(bundle.sum), 0.0, condition});
}

// u_r = 0 at r = 0, as if the scene said it: the last of the conditions, but the first row of its nodes.
void addAxis(const Mesh& mesh, std::vector<Condition>& conditions, Rows& rows) {
  Condition axis;
  axis.name = "the axis of symmetry";
  axis.path = "Model";
  axis.type = Condition::Type::Displacement;
  for (int node = 0; node < mesh.nodes(); ++node)
    if (mesh.coordinates[std::size_t(node) * mesh.dimension] == 0.0) rows[node].push_back({{1, 0, 0}, 0.0, int(conditions.size())});
  conditions.push_back(axis);
}

/// Rows that contradict each other, told once for each pair of conditions.
class Contradictions {
 public:
  Contradictions(const Mesh& mesh, const std::vector<Condition>& conditions) : mesh_(mesh), conditions_(conditions) {}

  void add(int node, const Row& kept, const Row& other) {
    Found& found = all_[std::minmax(kept.condition, other.condition)];
    if (found.nodes++ == 0) found.node = node, found.kept = kept, found.other = other;
  }

  void report(Problems& problems) const {
    for (const auto& [pair, found] : all_) {
      char text[300];
      std::snprintf(text, sizeof text, "at %s the displacement along (%.6g, %.6g) is to be %.6g, but '%s' makes it %.6g",
                    placeText(mesh_.point(found.node)).c_str(), found.other.direction[0], found.other.direction[1], found.other.value,
                    conditions_[found.kept.condition].name.c_str(), found.kept.value);
      problems.add(conditions_[found.other.condition].path,
                   std::string(text) + (found.nodes > 1 ? " (and so at " + std::to_string(found.nodes - 1) + " more nodes)" : "") +
                       "; where conditions meet, their values must agree");
    }
  }

 private:
  struct Found {
    int nodes = 0, node = -1;
    Row kept, other;
  };
  const Mesh& mesh_;
  const std::vector<Condition>& conditions_;
  std::map<std::pair<int, int>, Found> all_;
};

bool areParallel(const Row& a, const Row& b) { return norm(cross(a.direction, b.direction)) <= sameDirection; }

/// The first row of another direction than that of the first; null where there is none.
const Row* secondOf(const std::vector<Row>& rows) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return !areParallel(rows[0], row); });
  return found == rows.end() ? nullptr : &*found;
}

/// \param last  conditions from this number on are none of the scene's
void addSupports(int node, const std::vector<Row>& rows, int last, std::vector<Support>& supports) {
  const Row *first = &rows[0], *second = secondOf(rows);
  const auto add = [&](const Row& held, const Point& along) {
    std::set<int> conditions;
    for (const Row& row : rows)
      if (areParallel(held, row)) conditions.insert(row.condition);
    for (const int condition : conditions)
      if (condition < last) supports.push_back({node, condition, held.direction, scaled(1.0 / double(conditions.size()), along)});
  };
  if (!second) return add(*first, first->direction);
  const double det = cross(first->direction, second->direction)[2];
  add(*first, {second->direction[1] / det, -second->direction[0] / det, 0});
  add(*second, {-first->direction[1] / det, first->direction[0] / det, 0});
}

NodeRule ruleOf(int node, const std::vector<Row>& rows, Contradictions& contradictions) {
  const Row &first = rows[0], *second = secondOf(rows);
  double scale = 0;
  for (const Row& row : rows) scale = std::max(scale, std::abs(row.value));
  NodeRule rule;
  rule.node = node;
  if (second) {  // two equations for two components
    const double det = cross(first.direction, second->direction)[2];
    rule.fixed = {true, true, false};
    rule.value = {(first.value * second->direction[1] - second->value * first.direction[1]) / det,
                  (first.direction[0] * second->value - second->direction[0] * first.value) / det, 0};
  } else if (first.direction[1] == 0 || first.direction[0] == 0) {  // Cartesian axes do
    const int k = first.direction[0] == 0 ? 1 : 0;
    rule.fixed[k] = true;
    rule.value[k] = first.value / first.direction[k];
  } else {
    rule.axes[0] = first.direction;
    rule.axes[1] = turned(first.direction);
    rule.fixed[0] = true;
    rule.value[0] = first.value;
  }

  // Displacement that the rule gives along each row's direction, against the value of the row.
  for (const Row& row : rows) {
    double along = 0;
    for (int k = 0; k < 2; ++k)
      if (rule.fixed[k]) along += dot(rule.axes[k], row.direction) * rule.value[k];
    if (std::abs(along - row.value) <= sameValue * scale) continue;
    Row kept = areParallel(first, row) || !second ? first : *second;
    kept.value = along;
    contradictions.add(node, kept, row);
  }
  return rule;
}

}  // namespace

std::vector<NodeRule> nodalRules(const Mesh& mesh, const std::vector<Condition>& scene, Problems& problems,
                                 std::vector<Support>& supports) {
  Rows rows;
  std::vector<Condition> conditions = scene;
  if (mesh.axisymmetric) addAxis(mesh, conditions, rows);
  for (int number = 0; number < static_cast<int>(conditions.size()); ++number)
    if (conditions[number].type == Condition::Type::Displacement && !conditions[number].groups.empty())
      addDisplacement(mesh, conditions, number, rows, problems);
  addBilateral(mesh, conditions, rows);

  Contradictions contradictions(mesh, conditions);
  std::vector<NodeRule> rules;
  for (const auto& [node, here] : rows) {
    rules.push_back(ruleOf(node, here, contradictions));
    addSupports(node, here, int(scene.size()), supports);
  }
  contradictions.report(problems);
  return rules;
}

}  // namespace suture
