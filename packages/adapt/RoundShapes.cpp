#include <suture/adapt/RoundShapes.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/SideGeometry.hpp>
#include <suture/mesh/Surface.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

namespace suture {

namespace {

constexpr double kFit = 1e-6;  // distance from the shape over its radius, or over the extent of the nodes
constexpr double kLargestTurn = 15.001 * 3.14159265358979 / 180;  // between neighbouring sides of first order
constexpr double kFlattest = 1e3;                                 // radius over the extent of the nodes
constexpr int kNewtonSteps = 20;
constexpr double kOpen = 1e-9;               // smallest gap over the radius that gives a direction
constexpr double kLongestWay = 4.0;          // way along a line to a shape over the distance from it
constexpr double kSmallestPart = 1e-2;       // smallest Jacobian of an element with a moved node over the largest
constexpr int kAlternatingProjections = 50;  // onto the shapes that meet at an edge

struct Cloud {
  std::vector<Point> points;
  Point centre{0, 0, 0};
  double extent = 0.0;
};

Cloud cloudOf(const Surface& surface, const std::set<int>& nodes) {
  Cloud cloud;
  for (const int node : nodes) cloud.points.push_back(surface.at(node).position);
  for (const Point& p : cloud.points) cloud.centre = plus(cloud.centre, scaled(1.0 / static_cast<double>(cloud.points.size()), p));
  for (const Point& p : cloud.points) cloud.extent = std::max(cloud.extent, norm(minus(p, cloud.centre)));
  return cloud;
}

bool fits(const RoundShape& shape, const Cloud& cloud) {
  if (!(shape.radius > 0) || shape.radius > kFlattest * cloud.extent) return false;
  return std::all_of(cloud.points.begin(), cloud.points.end(),
                     [&](const Point& p) { return norm(minus(p, shape.project(p))) <= kFit * std::min(shape.radius, cloud.extent); });
}

/// Circle or sphere by |x|^2 - 2 c.x = r^2 - c^2, linear in c and the right-hand side, with coordinates relative to the extent.
std::optional<RoundShape> ball(const Cloud& cloud, int dimension) {
  const auto rows = static_cast<Eigen::Index>(cloud.points.size());
  if (rows < dimension + 2) return std::nullopt;
  Matrix a(rows, dimension + 1);
  Vector b(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Point x = scaled(1.0 / cloud.extent, minus(cloud.points[static_cast<std::size_t>(i)], cloud.centre));
    for (int k = 0; k < dimension; ++k) a(i, k) = 2 * x[k];
    a(i, dimension) = 1;
    b[i] = dot(x, x);
  }
  const Eigen::ColPivHouseholderQR<Matrix> qr(a);
  if (qr.rank() < dimension + 1) return std::nullopt;
  const Vector c = qr.solve(b);
  RoundShape shape;
  double square = c[dimension];
  for (int k = 0; k < dimension; ++k) {
    shape.centre[k] = cloud.centre[k] + cloud.extent * c[k];
    square += c[k] * c[k];
  }
  shape.radius = cloud.extent * std::sqrt(std::max(0.0, square));
  return fits(shape, cloud) ? std::optional<RoundShape>(shape) : std::nullopt;
}

/// Two unit vectors normal to a unit vector and to each other.
std::pair<Point, Point> across(const Point& axis) {
  const Point other = std::abs(axis[0]) < 0.7 ? Point{1, 0, 0} : Point{0, 1, 0};
  Point u = cross(axis, other);
  u = scaled(1.0 / norm(u), u);
  return {u, cross(axis, u)};
}

/// Axis to which the side normals are most nearly perpendicular.
Point axisOfNormals(const Surface& surface, const std::set<int>& nodes) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const int node : nodes)
    for (const Point& n : surface.at(node).sideNormals) {
      const Eigen::Vector3d v(n[0], n[1], n[2]);
      sum += v * v.transpose();
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(sum);
  const Eigen::Vector3d v = eigen.eigenvectors().col(0);
  return {v[0], v[1], v[2]};
}

/// Cylinder by Gauss-Newton steps for the distances to the axis: two tilts, two shifts, the radius.
std::optional<RoundShape> cylinder(const Cloud& cloud, Point axis) {
  const auto rows = static_cast<Eigen::Index>(cloud.points.size());
  if (rows < 7) return std::nullopt;
  RoundShape shape;
  shape.centre = cloud.centre;
  for (int step = 0; step < kNewtonSteps; ++step) {
    const auto [u, v] = across(axis);
    Matrix a(rows, 5);
    Vector b(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const Point x = scaled(1.0 / cloud.extent, minus(cloud.points[static_cast<std::size_t>(i)], shape.centre));
      const double p = dot(x, u), q = dot(x, v), along = dot(x, axis), r = std::hypot(p, q);
      // First step: a circle through the projections, linear as in ball(); then distances.
      if (step == 0) {
        a.row(i) << 2 * p, 2 * q, 0, 0, 1;
        b[i] = p * p + q * q;
      } else {
        if (r == 0) return std::nullopt;
        a.row(i) << p / r, q / r, along * p / r, along * q / r, 1;
        b[i] = r;
      }
    }
    const Vector c = Eigen::ColPivHouseholderQR<Matrix>(a).solve(b);
    shape.centre = plus(shape.centre, scaled(cloud.extent, plus(scaled(c[0], u), scaled(c[1], v))));
    shape.radius = cloud.extent * (step == 0 ? std::sqrt(std::max(0.0, c[4] + c[0] * c[0] + c[1] * c[1])) : c[4]);
    if (step > 0) axis = plus(axis, plus(scaled(c[2], u), scaled(c[3], v)));
    axis = scaled(1.0 / norm(axis), axis);
    if (!std::isfinite(shape.radius) || norm(minus(shape.centre, cloud.centre)) > kFlattest * cloud.extent) return std::nullopt;
  }
  shape.axis = axis;
  return fits(shape, cloud) ? std::optional<RoundShape>(shape) : std::nullopt;
}

bool isSecondOrder(const Surface& surface, int side) { return static_cast<int>(surface.nodesOf(side).size()) > surface.facets(side); }

/// True if the sides at each node differ little in direction, so that first-order sides are meant as a curve.
bool turnsGently(const Surface& surface, const std::set<int>& nodes) {
  for (const int node : nodes) {
    const std::vector<Point>& normals = surface.at(node).sideNormals;
    for (const Point& a : normals)
      if (angleBetween(a, normals.front()) > kLargestTurn) return false;
  }
  return true;
}

std::optional<RoundShape> shapeOf(const Surface& surface, const std::vector<int>& sides) {
  std::set<int> nodes;
  for (const int side : sides) nodes.insert(surface.nodesOf(side).begin(), surface.nodesOf(side).end());
  const bool second = isSecondOrder(surface, sides.front());
  if (sides.size() < (second ? 2u : 4u) || (!second && !turnsGently(surface, nodes))) return std::nullopt;
  const Cloud cloud = cloudOf(surface, nodes);
  if (!(cloud.extent > 0)) return std::nullopt;
  std::optional<RoundShape> shape = ball(cloud, surface.dimension());
  if (!shape && surface.dimension() == 3) shape = cylinder(cloud, axisOfNormals(surface, nodes));
  return shape;
}

}  // namespace

namespace {

/// Elements with one of these nodes.
std::vector<int> elementsWith(const Mesh& mesh, const std::map<int, Point>& nodes) {
  std::vector<char> among(static_cast<std::size_t>(mesh.nodes()), 0);
  for (const auto& entry : nodes) among[static_cast<std::size_t>(entry.first)] = 1;
  std::vector<int> elements;
  for (int e = 0; e < mesh.elements(); ++e) {
    const Span<const int> own = mesh.nodesOf(e);
    if (std::any_of(own.begin(), own.end(), [&](int node) { return among[static_cast<std::size_t>(node)] != 0; })) elements.push_back(e);
  }
  return elements;
}

void setPoint(Mesh& mesh, int node, const Point& at) {
  for (int k = 0; k < mesh.dimension; ++k) mesh.coordinates[static_cast<std::size_t>(node) * mesh.dimension + k] = at[k];
}

/// Moves nodes back until no element is flat.
void moveBack(Mesh& mesh, const std::map<int, Point>& before) {
  const double whole = mesh.dimension == 2 ? 2 : 6;  // determinant over size
  const std::vector<int> elements = elementsWith(mesh, before);
  for (bool changes = true; changes;) {
    changes = false;
    for (const int e : elements) {
      if (smallestJacobian(mesh, e) > kSmallestPart * whole * std::abs(signedSize(mesh, e))) continue;
      for (const int node : mesh.nodesOf(e)) {
        const auto found = before.find(node);
        if (found == before.end() || mesh.point(node) == found->second) continue;
        setPoint(mesh, node, found->second);
        changes = true;
      }
    }
  }
}

/// Place of a node on the straight side, and the way to its opposite node.
struct Opposite {
  Point straight, away;
};

/// Nodes of round sides that have an opposite node across an open contact. \param middlesOnly  without vertices
std::map<int, Opposite> oppositesOf(const Mesh& mesh, const RoundSides& round, const std::vector<NodePairs>& twins, bool middlesOnly) {
  std::unordered_map<int, Point> away;
  for (const NodePairs& pairs : twins)
    for (const auto& [a, b] : pairs) {
      const Point d = minus(mesh.point(b), mesh.point(a));
      away.emplace(a, d);
      away.emplace(b, scaled(-1.0, d));
    }
  std::map<int, Opposite> found;
  for (const auto& [side, shape] : round.sides) {
    const double least = kOpen * round.shapes[static_cast<std::size_t>(shape)].radius;
    const std::vector<int> nodes = mesh.nodesOf(side);
    const int vertices = sideVertices(static_cast<int>(nodes.size()), mesh.dimension);
    const auto put = [&](int node, const Point& straight, const Point& d) {
      if (norm(d) > least) found.emplace(node, Opposite{straight, d});
    };
    for (int k = 0; k < static_cast<int>(nodes.size()); ++k) {
      const int p = nodes[k % vertices], q = nodes[(k + 1) % vertices];
      if (away.count(p) == 0 || (k >= vertices && away.count(q) == 0)) continue;
      if (k >= vertices)
        put(nodes[k], scaled(0.5, plus(mesh.point(p), mesh.point(q))), scaled(0.5, plus(away.at(p), away.at(q))));
      else if (!middlesOnly)
        put(p, mesh.point(p), away.at(p));
    }
  }
  return found;
}

/// Shapes of some nodes.
using ShapesOfNodes = std::map<int, std::vector<int>>;

template <typename Wanted>
ShapesOfNodes shapesOfNodes(const Mesh& mesh, const RoundSides& round, const Wanted& wanted) {
  ShapesOfNodes shapes;
  for (const auto& [side, shape] : round.sides)
    for (const int node : mesh.nodesOf(side)) {
      if (!wanted(node)) continue;
      std::vector<int>& own = shapes[node];
      if (std::find(own.begin(), own.end(), shape) == own.end()) own.push_back(shape);
    }
  return shapes;
}

Point placeOf(Point at, const RoundSides& round, const std::vector<int>& shapes, const Opposite* opposite) {
  if (opposite != nullptr && shapes.size() == 1)
    if (const auto place = round.shapes[static_cast<std::size_t>(shapes[0])].along(opposite->straight, opposite->away)) return *place;
  for (int k = 0; k < (shapes.size() > 1 ? kAlternatingProjections : 1); ++k)
    for (const int shape : shapes) at = round.shapes[static_cast<std::size_t>(shape)].project(at);
  return at;
}

void place(Mesh& mesh, const RoundSides& round, const ShapesOfNodes& shapesOf, const std::map<int, Opposite>& opposites) {
  std::map<int, Point> before;
  for (const auto& [node, shapes] : shapesOf) {
    const auto opposite = opposites.find(node);
    before[node] = mesh.point(node);
    setPoint(mesh, node, placeOf(before[node], round, shapes, opposite == opposites.end() ? nullptr : &opposite->second));
  }
  if (!before.empty()) moveBack(mesh, before);
}

}  // namespace

void placeOnShapes(Mesh& mesh, const RoundSides& round, const std::vector<NodePairs>& twins, int first) {
  const ShapesOfNodes shapes = shapesOfNodes(mesh, round, [&](int node) { return node >= first; });
  if (!shapes.empty()) place(mesh, round, shapes, oppositesOf(mesh, round, twins, false));
}

void placeMiddlesOpposite(Mesh& mesh, const RoundSides& round, const std::vector<NodePairs>& twins) {
  const std::map<int, Opposite> opposites = oppositesOf(mesh, round, twins, true);
  place(mesh, round, shapesOfNodes(mesh, round, [&](int node) { return opposites.count(node) > 0; }), opposites);
}

std::optional<Point> RoundShape::along(const Point& from, const Point& direction) const {
  const Point way = minus(direction, scaled(dot(direction, axis), axis));
  Point w = minus(from, centre);
  w = minus(w, scaled(dot(w, axis), axis));
  const double a = dot(way, way), b = dot(w, way), c = dot(w, w) - radius * radius, square = b * b - a * c;
  if (!(a > 0) || !(square > 0)) return std::nullopt;
  const double q = -(b + std::copysign(std::sqrt(square), b));
  const double step = c / q;  // the root of smaller magnitude
  const Point move = scaled(step, direction);
  if (norm(move) > kLongestWay * std::abs(norm(w) - radius) + unitRoundoff * radius) return std::nullopt;
  return plus(from, move);
}

Point RoundShape::project(const Point& point) const {
  Point away = minus(point, centre);
  away = minus(away, scaled(dot(away, axis), axis));
  const double distance = norm(away);
  return distance > 0 ? plus(point, scaled(radius / distance - 1, away)) : point;
}

RoundSides findRoundSides(const Mesh& mesh) {
  RoundSides found;
  std::set<std::pair<int, int>> taken;
  for (const auto& [name, group] : mesh.sideGroups) {
    if (group.empty()) continue;
    const Surface surface(mesh, group);
    const std::vector<int> partOfSide = surface.parts();
    std::vector<std::vector<int>> parts;
    for (int side = 0; side < surface.sides(); ++side) {
      const auto part = static_cast<std::size_t>(partOfSide[side]);
      if (part >= parts.size()) parts.resize(part + 1);
      parts[part].push_back(side);
    }
    for (const std::vector<int>& part : parts) {
      const std::optional<RoundShape> shape = shapeOf(surface, part);
      if (!shape) continue;
      for (const int side : part)
        if (const Side& own = group[static_cast<std::size_t>(side)]; taken.insert({own.element, own.side}).second)
          found.sides.emplace_back(own, static_cast<int>(found.shapes.size()));
      found.shapes.push_back(*shape);
    }
  }
  return found;
}

}  // namespace suture
