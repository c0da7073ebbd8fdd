#include <suture/base/Errors.hpp>
#include <suture/constraints/BoundaryParts.hpp>
#include <suture/constraints/Conditions.hpp>
#include <suture/mesh/SideInterpolation.hpp>
#include <suture/pairs/ContactSurface.hpp>

namespace suture {

namespace {

/// True if the shape functions of the sides represent the data.
bool isPolynomialOn(const Mesh& mesh, const std::vector<std::string>& groups, const std::vector<Expression>& expressions) {
  if (expressions.empty()) return true;
  for (const Side& side : sidesOf(mesh.sideGroups, groups)) {
    std::vector<Point> points;
    for (const int node : mesh.nodesOf(side)) points.push_back(mesh.point(node));
    try {
      for (const Expression& expression : expressions)
        if (!isInterpolated(points, mesh.dimension, [&](const Point& point) { return expression.at(point); })) return false;
    } catch (const InputError&) {  // not finite: reported where the nodes take their values
      return false;
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
    if (condition.type == Type::RigidGroup) append(parts.rigid, condition.groups);
    if (condition.type == Type::MeanDisplacement) append(parts.onMean, condition.groups);
    if (condition.holds() && !condition.groups.empty()) parts.held.push_back(heldSides(mesh, condition));
  }
  for (const ContactSurface& contact : contacts) {
    TouchingSides& own = parts.touching.emplace_back();
    own = {contact.name, contact.number, contact.groupsA, contact.groupsB, contact.overclosure.has_value()};
    if (!contact.initialGap) continue;
    own.isInterpolated = !isPolynomialOn(mesh, contact.groupsA, {*contact.initialGap});
    if (own.isInterpolated) continue;
    for (const Side& side : sidesOf(mesh.sideGroups, contact.groupsA))
      for (const int node : mesh.nodesOf(side)) own.gaps[node] = contact.initialGap->at(mesh.point(node));
  }
  return parts;
}

}  // namespace suture
