#include <suture/algebra/DisjointSets.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/RigidFrame.hpp>
#include <suture/base/RigidValues.hpp>
#include <suture/motion/RigidMotion.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace suture {

namespace {

/// Largest ratio of rotation to translation that is called a shift: the axis is then more than twenty radii of the part away, too far to
/// describe the motion as a turn about it.
constexpr double kShift = 0.05;

std::string number(double value, double scale) {
  std::ostringstream text;
  text.precision(4);
  text << (std::abs(value) < 1e-6 * scale ? 0.0 : value);
  return text.str();
}

// Connected components of the nodes, numbered in the order of their first nodes.
std::vector<int> components(const CellBlock& block, const std::vector<RigidGroup>& rigidGroups) {
  DisjointSets sets(block.nodes());
  for (int e = 0; e < block.elements(); ++e) {
    const Span<const int> nodes = block.nodesOf(e);
    int lowest = nodes[0];
    for (const int node : nodes) lowest = sets.join(lowest, node);
  }
  for (const RigidGroup& group : rigidGroups)
    for (const int node : group.nodes) sets.join(group.nodes.front(), node);
  for (const auto& [outer, inner] : nodesUnderCoatings(block)) sets.join(outer, inner);
  std::vector<int> number(block.nodes(), -1), part(block.nodes());
  int parts = 0;
  for (int i = 0; i < block.nodes(); ++i) {
    const int r = sets.lowest(i);
    if (number[r] < 0) number[r] = parts++;
    part[i] = number[r];
  }
  return part;
}

}  // namespace

Matrix RigidPart::at(const Point& point, int dimension) const { return RigidFrame{centre, radius}.at(point, dimension); }

Point RigidPart::displacement(const Point& point, const Vector& amplitudes, int dimension) const {
  Point translation, rotation;
  splitAmplitudes(amplitudes, dimension, translation, rotation);
  return rigidDisplacement(translation, rotation, RigidFrame{centre, radius}.arm(point));
}

std::string inWords(const RigidPart& part, const Vector& amplitudes, int dimension) {
  const Vector translation = amplitudes.head(dimension), rotation = amplitudes.tail(amplitudes.size() - dimension);
  if (rotation.norm() < kShift * translation.norm()) {
    const Vector direction = translation.normalized();
    std::string text = "move";
    if (std::abs(direction[dimension - 1]) > 1 - 1e-6) text += direction[dimension - 1] > 0 ? " upwards" : " downwards";
    if (std::abs(direction[0]) > 1 - 1e-6) text += direction[0] > 0 ? " to the right" : " to the left";
    text += " (";
    for (int k = 0; k < dimension; ++k) text += (k > 0 ? ", " : "") + number(direction[k], 1.0);
    return text + (rotation.norm() < 1e-6 * translation.norm() ? ")" : "), turning slightly");
  }
  if (dimension == 2) {
    // The centre of the rotation, where the displacement t + w x arm vanishes: arm = w x t / w^2.
    const double x = part.centre[0] - part.radius * translation[1] / rotation[0],
                 y = part.centre[1] + part.radius * translation[0] / rotation[0];
    return "turn about (" + number(x, part.radius) + ", " + number(y, part.radius) + "), " +
           (rotation[0] > 0 ? "counterclockwise" : "clockwise");
  }
  const Vector axis = rotation.normalized();
  // The point of the axis that is nearest to the centre, from the displacement of the centre perpendicular to the axis.
  const Point spin{rotation[0], rotation[1], rotation[2]}, shift{translation[0], translation[1], translation[2]};
  const Point arm = scaled(part.radius / rotation.squaredNorm(), cross(spin, shift)), through = plus(part.centre, arm);
  return "turn about the axis (" + number(axis[0], 1.0) + ", " + number(axis[1], 1.0) + ", " + number(axis[2], 1.0) + ") through (" +
         number(through[0], part.radius) + ", " + number(through[1], part.radius) + ", " + number(through[2], part.radius) + ")";
}

RigidParts freeRigidMotions(const Mesh& mesh, const Constraints& constraints, bool bodiesAreConnected) {
  const int dimension = mesh.dimension, amplitudes = rigidMotions(dimension);
  RigidParts all;
  all.partOfNode = bodiesAreConnected ? mesh.bodyOfNode : components(mesh, constraints.rigidGroups);
  const int count = all.partOfNode.empty() ? 0 : 1 + *std::max_element(all.partOfNode.begin(), all.partOfNode.end());
  all.parts.resize(count);

  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<Point> low(count, {infinity, infinity, infinity}), high(count, {-infinity, -infinity, -infinity});
  for (int i = 0; i < mesh.nodes(); ++i) {
    const int part = all.partOfNode[i];
    all.parts[part].body = mesh.bodyOfNode[i];
    const Point p = mesh.point(i);
    for (int k = 0; k < dimension; ++k) {
      low[part][k] = std::min(low[part][k], p[k]);
      high[part][k] = std::max(high[part][k], p[k]);
    }
  }
  for (int part = 0; part < count; ++part) {
    double square = 0;
    for (int k = 0; k < dimension; ++k) {
      all.parts[part].centre[k] = (low[part][k] + high[part][k]) / 2;
      square += std::pow(high[part][k] - low[part][k], 2);
    }
    all.parts[part].radius = std::sqrt(square) / 2;
  }

  std::vector<int> rowsOf(count, 0);
  for (const NodeRule& rule : constraints.rules)
    for (int k = 0; k < dimension; ++k) rowsOf[all.partOfNode[rule.node]] += rule.fixed[k];
  for (const SpringDirection& spring : constraints.springs) ++rowsOf[all.partOfNode[spring.node]];
  std::vector<Matrix> rows(count);
  // A body of revolution cannot turn in its meridian plane or shift away from the axis.
  const int excluded = mesh.axisymmetric ? 2 : 0;
  for (int part = 0; part < count; ++part) {
    rows[part] = Matrix::Zero(rowsOf[part] + excluded, amplitudes);
    if (mesh.axisymmetric) rows[part](rowsOf[part], 0) = rows[part](rowsOf[part] + 1, 2) = 1.0;
  }
  std::fill(rowsOf.begin(), rowsOf.end(), 0);
  const auto addRow = [&](int node, const Point& direction) {
    const int part = all.partOfNode[node];
    const Matrix motion = all.parts[part].at(mesh.point(node), dimension);
    rows[part].row(rowsOf[part]++) = Eigen::Map<const Vector>(direction.data(), dimension).transpose() * motion;
  };
  const RigidGroupNodes rigid(constraints.rigidGroups, dimension);
  for (const NodeRule& rule : constraints.rules)
    for (int k = 0; k < dimension; ++k) {
      if (!rule.fixed[k]) continue;
      addRow(rule.node, rule.axes[k]);
      const int part = all.partOfNode[rule.node];
      rigid.forEachMaster(rule.node, k, [&](int node, int component, double coefficient) {
        const Eigen::Map<const Vector> axis(rigid.axis(node, component).data(), dimension);
        rows[part].row(rowsOf[part] - 1) -= coefficient * axis.transpose() * all.parts[part].at(mesh.point(node), dimension);
      });
    }
  for (const SpringDirection& spring : constraints.springs) addRow(spring.node, spring.direction);
  for (int part = 0; part < count; ++part) all.parts[part].free = nullSpace(rows[part]);
  return all;
}

}  // namespace suture
