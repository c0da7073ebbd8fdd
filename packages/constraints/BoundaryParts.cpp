#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/constraints/BoundaryParts.hpp>
#include <suture/constraints/Conditions.hpp>
#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/mesh/SideGeometry.hpp>
#include <suture/pairs/ContactSurface.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// Deviation of values between nodes from their interpolation, relative to the largest value, up to which it is round-off.
constexpr double kSamePolynomial = 1e-10;

/// Shape functions of a side's nodes at some points between the nodes.
std::vector<std::vector<double>> shapesBetweenNodes(int nodes, int dimension) {
  std::vector<std::vector<double>> all;
  if (dimension == 2) {
    for (const double xi : {-0.6, -0.2, 0.3, 0.7}) {
      const SideShape shape = sideShape(nodes, xi);
      all.emplace_back(shape.value.begin(), shape.value.begin() + nodes);
    }
    return all;
  }
  const Cell cell = sideCell(nodes);
  ShapeJet jets[kMostCellNodes];
  for (const ReferencePoint& at : {ReferencePoint{0.2, 0.2, 0}, ReferencePoint{0.6, 0.1, 0}, ReferencePoint{0.1, 0.7, 0}}) {
    shapeJets(cell, at, jets);
    all.emplace_back();
    for (int a = 0; a < nodes; ++a) all.back().push_back(jets[a].value);
  }
  return all;
}

/// True if the shape functions of the sides represent the data.
bool isPolynomialOn(const Mesh& mesh, const std::vector<std::string>& groups, const std::vector<Expression>& expressions) {
  if (expressions.empty()) return true;
  for (const Side& side : sidesOf(mesh.sideGroups, groups)) {
    std::vector<Point> points;
    for (const int node : mesh.nodesOf(side)) points.push_back(mesh.point(node));
    for (const std::vector<double>& shapes : shapesBetweenNodes(static_cast<int>(points.size()), mesh.dimension)) {
      Point place{0, 0, 0};
      for (std::size_t a = 0; a < points.size(); ++a) place = plus(place, scaled(shapes[a], points[a]));
      for (const Expression& expression : expressions) {
        double interpolated = 0.0, size = 0.0, between = 0.0;
        try {
          for (std::size_t a = 0; a < points.size(); ++a) {
            const double value = expression.at(points[a]);
            interpolated += shapes[a] * value;
            size = std::max(size, std::abs(value));
          }
          between = expression.at(place);
        } catch (const InputError&) {  // not finite: reported where the nodes take their values
          return false;
        }
        if (std::abs(interpolated - between) > kSamePolynomial * size) return false;
      }
    }
  }
  return true;
}

HeldSides heldSides(const Mesh& mesh, const Condition& condition) {
  HeldSides held;
  held.groups = condition.groups;
  held.alongNormal = condition.type == Condition::Type::Bilateral;
  held.alongOther = condition.direction.has_value();
  if (!held.alongNormal && !held.alongOther)
    for (const int k : condition.components) held.components[k] = true;
  held.isPolynomial = isPolynomialOn(mesh, condition.groups, condition.data.expressions);
  return held;
}

}  // namespace

BoundaryParts boundaryParts(const Mesh& mesh, const std::vector<Condition>& conditions, const std::vector<ContactSurface>& contacts) {
  using Type = Condition::Type;
  BoundaryParts parts;
  parts.isKnown = true;
  const auto append = [](std::vector<std::string>& to, const std::vector<std::string>& groups) {
    to.insert(to.end(), groups.begin(), groups.end());
  };
  for (const Condition& condition : conditions) {
    if (condition.type == Type::ElasticSupport) append(parts.onSprings, condition.groups);
    if (condition.type == Type::RigidGroup) append(parts.rigid, condition.groups);
    if (condition.type == Type::MeanDisplacement) append(parts.onMean, condition.groups);
    if (condition.holds() && !condition.groups.empty()) parts.held.push_back(heldSides(mesh, condition));
  }
  for (const ContactSurface& contact : contacts) {
    const bool isGiven = contact.initialGap.has_value();
    parts.touching.push_back({contact.name, contact.number, contact.groupsA, contact.groupsB, contact.overclosure.has_value(),
                              isGiven && !isPolynomialOn(mesh, contact.groupsA, {*contact.initialGap})});
  }
  return parts;
}

}  // namespace suture
