#include <suture/base/Point.hpp>
#include <suture/constraints/NodalRules.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/SideGeometry.hpp>
#include <suture/pairs/ContactSurface.hpp>
#include <suture/pairs/PairFrame.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

namespace suture {

namespace {

const double sameDirection = 1e-6;  // sine of the angle below which two directions are equal
const double sameValue = 1e-9;      // relative

/// direction . u = value
struct Row {
  Point direction{0, 0, 0};
  double value = 0;
  int condition = -1;
  int factor = 0;
};
using Rows = std::map<int, std::vector<Row>>;  // node -> rows

/// \throws InputError  the node is on the axis
Point directionAt(const Mesh& mesh, const Condition& condition, int node) {
  if (const auto direction = condition.direction->at(mesh.point(node))) return *direction;
  throw InputError(condition.path + "/Along", "the node at " + placeText(mesh.point(node), mesh.dimension) +
                                                  " is on the axis, where neither Radius nor Circumference has a direction");
}

/// \param problems  gets the first place where an expression has no finite value, or that is on the axis of a direction
void addDisplacement(const Mesh& mesh, const std::vector<Condition>& conditions, int number, Rows& rows, Problems& problems) try {
  const Condition& condition = conditions[number];
  std::set<int> nodes;
  if (condition.node >= 0) nodes.insert(condition.node);
  for (const Side& side : sidesOf(mesh.sideGroups, condition.groups))
    for (const int node : mesh.nodesOf(side)) nodes.insert(node);
  for (const int node : nodes) {
    if (condition.direction) {
      const Row row{directionAt(mesh, condition, node), condition.data.at(0, mesh.point(node)), number, condition.factor};
      rows[node].push_back(row);
      continue;
    }
    for (std::size_t i = 0; i < condition.components.size(); ++i) {
      Row row;
      row.direction[condition.components[i]] = 1;
      row.value = condition.data.at(i, mesh.point(node));
      row.condition = number;
      row.factor = condition.factor;
      rows[node].push_back(row);
    }
  }
} catch (const InputError& error) {
  problems.add(error);
}

// Treats all conditions together: a round wall named in two pieces must not get two nearly parallel rows where the pieces meet.
void addBilateral(const Mesh& mesh, const std::vector<Condition>& conditions, Rows& rows) {
  struct Bundle {
    Point sum;  // sum of the normals, weighted by size
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

// u_r = 0 at r = 0, as if the scene prescribed it: the last of the conditions, but the first row of its nodes.
void addAxis(const Mesh& mesh, std::vector<Condition>& conditions, Rows& rows) {
  Condition axis;
  axis.name = "the axis of symmetry";
  axis.path = "Model";
  axis.type = Condition::Type::Displacement;
  for (int node = 0; node < mesh.nodes(); ++node)
    if (mesh.coordinates[std::size_t(node) * mesh.dimension] == 0.0) rows[node].push_back({{1, 0, 0}, 0.0, int(conditions.size())});
  conditions.push_back(axis);
}

/// Contradictory rows, reported once per pair of conditions.
class Contradictions {
 public:
  Contradictions(const Mesh& mesh, const std::vector<Condition>& conditions, bool haveFactors)
      : mesh_(mesh), conditions_(conditions), haveFactors_(haveFactors) {}

  void add(int node, const Row& kept, const Row& other) {
    Found& found = all_[std::minmax(kept.condition, other.condition)];
    if (found.nodes++ == 0) found.node = node, found.kept = kept, found.other = other;
  }

  void report(Problems& problems) const {
    for (const auto& [pair, found] : all_) {
      char text[300];
      std::snprintf(text, sizeof text, "at %s the displacement along %s should be %.6g, but '%s' makes it %.6g",
                    placeText(mesh_.point(found.node), mesh_.dimension).c_str(), placeText(found.other.direction, mesh_.dimension).c_str(),
                    found.other.value, conditions_[found.kept.condition].name.c_str(), found.kept.value);
      problems.add(conditions_[found.other.condition].path,
                   std::string(text) + (found.nodes > 1 ? " (likewise at " + std::to_string(found.nodes - 1) + " more nodes)" : "") +
                       "; where conditions meet, their values must agree" + (haveFactors_ ? ", and so must their Load Steps/Factors" : ""));
    }
  }

 private:
  struct Found {
    int nodes = 0, node = -1;
    Row kept, other;
  };
  const Mesh& mesh_;
  const std::vector<Condition>& conditions_;
  bool haveFactors_;
  std::map<std::pair<int, int>, Found> all_;
};

bool areParallel(const Row& a, const Row& b) { return norm(cross(a.direction, b.direction)) <= sameDirection; }

/// Rows of a node that determine its displacement, each the first whose direction is independent of the preceding ones, and the basis dual
/// to their directions.
struct Basis {
  std::vector<const Row*> rows;
  /// Directions of the rows, completed to three by unit vectors perpendicular to the rows' span. In 2D the last is out of plane.
  std::array<Point, 3> directions{};
  double det = 1.0;  ///< determinant of the three directions

  Basis(const std::vector<Row>& all, int dimension) {
    for (const Row& row : all)
      if (int(rows.size()) < dimension && isIndependent(row)) rows.push_back(&row);
    std::size_t known = 0;
    for (const Row* row : rows) directions[known++] = row->direction;
    if (known == 2) directions[2] = dimension == 2 ? Point{0, 0, 1} : across();
    if (known >= 2) det = dot(cross(directions[0], directions[1]), directions[2]);
  }

  /// det times the vector whose product with direction i is one, and with the others zero.
  Point adjugate(int i) const { return cross(directions[(i + 1) % 3], directions[(i + 2) % 3]); }
  /// Vector in the span of the rows whose product with direction i is one, and with those of the other rows zero.
  Point dual(int i) const {
    if (rows.size() == 1) return directions[0];
    const Point vector = adjugate(i);
    return {vector[0] / det, vector[1] / det, vector[2] / det};
  }
  /// Unit vector perpendicular to two rows.
  Point across() const {
    const Point normal = cross(rows[0]->direction, rows[1]->direction);
    return scaled(1 / norm(normal), normal);
  }

 private:
  bool isIndependent(const Row& row) const {
    if (rows.empty()) return true;
    if (rows.size() == 1) return !areParallel(*rows[0], row);
    return std::abs(dot(across(), row.direction)) > sameDirection;
  }
};

/// \param last  number of conditions in the scene; higher numbers are added automatically
void addSupports(int node, const Basis& basis, const std::vector<Row>& rows, const std::vector<Condition>& scene,
                 std::vector<Support>& supports) {
  const int last = int(scene.size());
  for (int i = 0; i < int(basis.rows.size()); ++i) {
    const Row& held = *basis.rows[i];
    std::set<int> conditions;
    for (const Row& row : rows)
      if (areParallel(held, row)) conditions.insert(row.condition);
    for (const int condition : conditions)
      if (condition < last)
        supports.push_back({node, condition, held.direction, scaled(1.0 / double(conditions.size()), basis.dual(i)),
                            scene[std::size_t(condition)].point.has_value()});
  }
}

/// Index of the only nonzero component; -1 if there are several.
int onlyComponent(const Point& direction) {
  int place = -1;
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0) continue;
    if (place >= 0) return -1;
    place = k;
  }
  return place;
}

/// Component k of the vector in the span of the rows whose products with their directions are their values.
double component(const Basis& basis, int k) {
  double sum = 0;
  for (std::size_t i = 0; i < basis.rows.size(); ++i) sum += basis.rows[i]->value * basis.adjugate(int(i))[k];
  return sum / basis.det + 0.0;  // no negative zero
}

/// Rule of one direction: along axis 0, or along a Cartesian axis if the direction is Cartesian.
void holdLine(const Row& row, int dimension, NodeRule& rule) {
  if (const int k = onlyComponent(row.direction); k >= 0) {
    rule.fixed[k] = true;
    rule.value[k] = row.value / row.direction[k];
    return;
  }
  const std::vector<Point> frame = pairFrame(row.direction, dimension);
  std::copy(frame.begin(), frame.end(), rule.axes.begin());
  rule.fixed[0] = true;
  rule.value[0] = row.value;
}

/// Rule of two directions in 3D: axis 0 along the first, axis 1 in their plane; Cartesian axes if they span that plane.
void holdPlane(const Basis& basis, NodeRule& rule) {
  const Row &first = *basis.rows[0], &second = *basis.rows[1];
  const Point normal = basis.directions[2];
  if (const int free = onlyComponent(normal); free >= 0) {
    for (int k = 0; k < 3; ++k)
      if (k != free) rule.fixed[k] = true, rule.value[k] = component(basis, k);
    return;
  }
  rule.axes = {first.direction, cross(normal, first.direction), normal};
  rule.fixed = {true, true, false};
  const double along = dot(second.direction, rule.axes[0]), aside = dot(second.direction, rule.axes[1]);
  rule.value = {first.value, (second.value - along * first.value) / aside, 0};
}

NodeRule ruleOf(int node, const Basis& basis, int dimension) {
  NodeRule rule;
  rule.node = node;
  if (int(basis.rows.size()) == dimension) {  // as many equations as components
    for (int k = 0; k < dimension; ++k) rule.fixed[k] = true, rule.value[k] = component(basis, k);
  } else if (basis.rows.size() == 1) {
    holdLine(*basis.rows[0], dimension, rule);
  } else {
    holdPlane(basis, rule);
  }
  return rule;
}

/// Compares the displacement that a rule gives along each row's direction with the value of the row.
void compare(const NodeRule& rule, const Basis& basis, const std::vector<Row>& rows, int dimension, Contradictions& contradictions) {
  double scale = 0;
  for (const Row& row : rows) scale = std::max(scale, std::abs(row.value));
  for (const Row& row : rows) {
    double along = 0;
    for (int k = 0; k < dimension; ++k)
      if (rule.fixed[k]) along += dot(rule.axes[k], row.direction) * rule.value[k];
    if (std::abs(along - row.value) <= sameValue * scale) continue;
    const auto like = std::find_if(basis.rows.begin(), basis.rows.end(), [&](const Row* held) { return areParallel(*held, row); });
    Row kept = like == basis.rows.end() ? *basis.rows.back() : **like;
    kept.value = along;
    contradictions.add(rule.node, kept, row);
  }
}

/// Rows with the values of one factor only.
std::vector<Row> partOf(std::vector<Row> rows, int factor) {
  for (Row& row : rows)
    if (row.factor != factor) row.value = 0.0;
  return rows;
}

}  // namespace

std::vector<NodeRule> nodalRules(const Mesh& mesh, const std::vector<Condition>& scene, Problems& problems, std::vector<Support>& supports,
                                 std::vector<std::vector<RuleValue>>& prescribed) {
  Rows rows;
  std::vector<Condition> conditions = scene;
  if (mesh.axisymmetric) addAxis(mesh, conditions, rows);
  for (int number = 0; number < static_cast<int>(conditions.size()); ++number)
    if (conditions[number].type == Condition::Type::Displacement) addDisplacement(mesh, conditions, number, rows, problems);
  addBilateral(mesh, conditions, rows);

  int factors = 1;
  for (const Condition& condition : conditions)
    if (condition.type == Condition::Type::Displacement) factors = std::max(factors, condition.factor + 1);
  prescribed.assign(factors > 1 ? factors : 0, {});
  Contradictions contradictions(mesh, conditions, factors > 1);
  std::vector<NodeRule> rules;
  for (const auto& [node, here] : rows) {
    const Basis basis(here, mesh.dimension);
    rules.push_back(ruleOf(node, basis, mesh.dimension));
    if (factors == 1) compare(rules.back(), basis, here, mesh.dimension, contradictions);
    for (int factor = 0; factors > 1 && factor < factors; ++factor) {
      const std::vector<Row> part = partOf(here, factor);
      const Basis same(part, mesh.dimension);
      const NodeRule rule = ruleOf(node, same, mesh.dimension);
      compare(rule, same, part, mesh.dimension, contradictions);
      if (rule.value != Point{0, 0, 0}) prescribed[factor].push_back({node, rule.value});
    }
    addSupports(node, basis, here, scene, supports);
  }
  contradictions.report(problems);
  return rules;
}

}  // namespace suture
