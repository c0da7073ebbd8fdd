#include <suture/base/Dense.hpp>
#include <suture/base/DisjointSets.hpp>
#include <suture/constraints/RigidMotion.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace suture {

namespace {

std::string number(double value, double scale) {
  std::ostringstream text;
  text.precision(4);
  text << (std::abs(value) < 1e-6 * scale ? 0.0 : value);
  return text.str();
}

// Connected components of the nodes, numbered in the order of their first nodes.
std::vector<int> components(const CellBlock& block) {
  DisjointSets sets(block.nodes());
  for (int e = 0; e < block.elements(); ++e) {
    const Span<const int> nodes = block.nodesOf(e);
    int lowest = nodes[0];
    for (const int node : nodes) lowest = sets.join(lowest, node);
  }
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

Matrix RigidPart::at(const Point& point, int dimension) const {
  Matrix motion = Matrix::Zero(dimension, dimension == 2 ? 3 : 6);
  motion.leftCols(dimension).setIdentity();
  Point arm{0, 0, 0};
  for (int k = 0; k < dimension; ++k) arm[k] = (point[k] - centre[k]) / radius;
  if (dimension == 2) {
    motion(0, 2) = -arm[1];
    motion(1, 2) = arm[0];
  } else {
    for (int r = 0; r < 3; ++r) {  // e_r x arm
      const int s = (r + 1) % 3, t = (r + 2) % 3;
      motion(s, 3 + r) = -arm[t];
      motion(t, 3 + r) = arm[s];
    }
  }
  return motion;
}

Point RigidPart::displacement(const Point& point, const Vector& amplitudes, int dimension) const {
  Point arm{0, 0, 0}, moved{0, 0, 0}, turn{0, 0, 0};
  for (int k = 0; k < dimension; ++k) {
    arm[k] = (point[k] - centre[k]) / radius;
    moved[k] = amplitudes(k);
  }
  if (dimension == 2)
    turn[2] = amplitudes(2);
  else
    for (int k = 0; k < 3; ++k) turn[k] = amplitudes(3 + k);
  for (int k = 0; k < dimension; ++k) moved[k] += turn[(k + 1) % 3] * arm[(k + 2) % 3] - turn[(k + 2) % 3] * arm[(k + 1) % 3];
  return moved;
}

std::string inWords(const RigidPart& part, const Vector& amplitudes, int dimension) {
  const Vector translation = amplitudes.head(dimension), rotation = amplitudes.tail(amplitudes.size() - dimension);
  if (rotation.norm() < 1e-6 * translation.norm()) {
    const Vector direction = translation.normalized();
    std::string text = "move";
    if (std::abs(direction[dimension - 1]) > 1 - 1e-6) text += direction[dimension - 1] > 0 ? " upwards" : " downwards";
    if (std::abs(direction[0]) > 1 - 1e-6) text += direction[0] > 0 ? " to the right" : " to the left";
    text += " (";
    for (int k = 0; k < dimension; ++k) text += (k > 0 ? ", " : "") + number(direction[k], 1.0);
    return text + ")";
  }
  if (dimension == 2) {
    // u = t + r (-y, x) / radius vanishes at the centre of the rotation
    const double x = part.centre[0] - part.radius * translation[1] / rotation[0],
                 y = part.centre[1] + part.radius * translation[0] / rotation[0];
    return "turn about (" + number(x, part.radius) + ", " + number(y, part.radius) + "), " +
           (rotation[0] > 0 ? "counterclockwise" : "clockwise");
  }
  const Vector axis = rotation.normalized();
  return "turn about the axis (" + number(axis[0], 1.0) + ", " + number(axis[1], 1.0) + ", " + number(axis[2], 1.0) + ")";
}

RigidParts freeRigidMotions(const Mesh& mesh, const Constraints& constraints, bool bodiesAreConnected) {
  const int dimension = mesh.dimension, amplitudes = dimension == 2 ? 3 : 6;
  RigidParts all;
  all.partOfNode = bodiesAreConnected ? mesh.bodyOfNode : components(mesh);
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
  std::vector<Matrix> rows(count);
  // A body of revolution cannot turn in its meridian plane or shift away from the axis.
  const int excluded = mesh.axisymmetric ? 2 : 0;
  for (int part = 0; part < count; ++part) {
    rows[part] = Matrix::Zero(rowsOf[part] + excluded, amplitudes);
    if (mesh.axisymmetric) rows[part](rowsOf[part], 0) = rows[part](rowsOf[part] + 1, 2) = 1.0;
  }
  std::fill(rowsOf.begin(), rowsOf.end(), 0);
  for (const NodeRule& rule : constraints.rules) {
    const int part = all.partOfNode[rule.node];
    const Matrix motion = all.parts[part].at(mesh.point(rule.node), dimension);
    for (int k = 0; k < dimension; ++k) {
      if (!rule.fixed[k]) continue;
      rows[part].row(rowsOf[part]++) = Eigen::Map<const Vector>(rule.axes[k].data(), dimension).transpose() * motion;
    }
  }
  for (int part = 0; part < count; ++part) all.parts[part].free = nullSpace(rows[part]);
  return all;
}

}  // namespace suture
