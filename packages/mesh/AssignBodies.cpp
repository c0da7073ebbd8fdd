#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/mesh/SideFit.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace suture {

namespace {

constexpr double kLeastJacobian = 1e-12;  // relative to the element's own size; a sliver of aspect ratio 1e8 is accepted

/// Smallest accepted Jacobian determinant of an element of this diameter.
double smallest(const Mesh& mesh, double diameter) { return kLeastJacobian * std::pow(diameter, mesh.dimension); }

// The columns of the Jacobian in 3D are weighted means of the edges along each direction, with weights that add up to one, plus, for curved
// edges, terms with the distances of mid-edge nodes from the straight edges' middles. If the edges of each direction are nearly equal, each
// column is close to their mean, and so is the determinant. A million straight-sided hexahedra take .3 s instead of 4.
bool isSurelySound(const Mesh& mesh, int e) {
  const Cell cell = mesh.cells[e];
  const CellInfo& info = cellInfo(cell);
  const Span<const int> nodes = mesh.nodesOf(e);
  static const std::vector<std::array<int, 2>> tetrahedron[] = {{{0, 1}}, {{0, 2}}, {{0, 3}}};
  static const std::vector<std::array<int, 2>> cube[] = {
      {{0, 1}, {3, 2}, {4, 5}, {7, 6}}, {{0, 3}, {1, 2}, {4, 7}, {5, 6}}, {{0, 4}, {1, 5}, {2, 6}, {3, 7}}};
  if (cell == Cell::Wedge6 || cell == Cell::Pyramid5) return false;
  const bool simplex = isSimplex(cell);
  Point mean[3];
  double away[3], diameter = 0, bow = 0;
  for (int k = 0; k < 3; ++k) {
    const auto& edges = simplex ? tetrahedron[k] : cube[k];
    mean[k] = {0, 0, 0};
    std::array<Point, 4> all;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      all[i] = minus(mesh.point(nodes[edges[i][1]]), mesh.point(nodes[edges[i][0]]));
      mean[k] = plus(mean[k], scaled(1.0 / static_cast<double>(edges.size()), all[i]));
    }
    away[k] = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) away[k] = std::max(away[k], norm(minus(all[i], mean[k])));
    diameter += norm(mean[k]) + away[k];
  }
  for (int i = info.vertices; i < info.nodes; ++i) {
    Point straight{0, 0, 0};  // position in the element with straight sides
    ShapeJet jets[kMostCellNodes];
    shapeJets(simplex ? Cell::Tetrahedron4 : Cell::Hexahedron8, referencePoint(cell, i), jets);
    for (int v = 0; v < info.vertices; ++v) straight = plus(straight, scaled(jets[v].value, mesh.point(nodes[v])));
    bow += norm(minus(mesh.point(nodes[i]), straight));
  }
  const double most =
      4.0 * bow;  // 4 bounds the gradient of a mid-edge shape function; in cubes the bound is 2, for columns of half an edge
  double bound = 1, whole = 1;
  for (int k = 0; k < 3; ++k) bound *= norm(mean[k]) + away[k] + most, whole *= norm(mean[k]);
  return dot(mean[0], cross(mean[1], mean[2])) - (bound - whole) > 8 * kLeastJacobian * std::pow(diameter, 3);
}

// Accepts most elements of most large meshes without a call: the determinant of a bilinear map is smallest at a corner, where it is a
// quarter of the product of the two edges. 935,000 triangles or 500,000 quadrilaterals take about 0.03 s instead of 0.1 and 0.25 s.
bool isSound(const Mesh& mesh, int e) {
  const Cell cell = mesh.cells[e];
  if (mesh.dimension == 3) return isSurelySound(mesh, e);
  if (cell != Cell::Triangle3 && cell != Cell::Quadrilateral4) return false;
  const Span<const int> nodes = mesh.nodesOf(e);
  const int corners = cell == Cell::Triangle3 ? 3 : 4;
  const auto at = [&](int k) { return mesh.coordinates.data() + std::size_t(nodes[k]) * 2; };
  double least = std::numeric_limits<double>::max(), square = 0;
  for (int k = 0; k < corners; ++k) {
    const double *a = at(k), *b = at(k + 1 < corners ? k + 1 : 0), *c = at(k > 0 ? k - 1 : corners - 1);
    const double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - a[0], vy = c[1] - a[1];
    least = std::min(least, ux * vy - uy * vx);
    square = std::max({square, ux * ux + uy * uy, (vx - ux) * (vx - ux) + (vy - uy) * (vy - uy)});
  }
  return least > (corners == 3 ? 1 : 4) * kLeastJacobian * square;
}

void checkShapes(const Mesh& mesh, Problems& problems) {
  std::vector<int> inverted, flat, folded;
  for (int e = 0; e < mesh.elements(); ++e) {
    if (isSound(mesh, e)) continue;
    const double diameter = diameterOf(mesh, e);
    const double jacobian = smallestJacobian(mesh, e);
    const double least = smallest(mesh, diameter);
    if (jacobian > least) continue;
    const double size = signedSize(mesh, e);
    (size > least ? folded : size < -least ? inverted : flat).push_back(e);
  }
  const auto report = [&](const std::vector<int>& bad, const std::string& what, const std::string& more = "") {
    if (bad.empty()) return;
    char size[40];
    std::snprintf(size, sizeof size, "%.6g", signedSize(mesh, bad[0]));
    problems.add("Mesh", mesh.source + ": " + countAt(bad.size(), what, placeText(centreOf(mesh, bad[0]), mesh.dimension), more) +
                             "; element " + std::to_string(bad[0]) + " has the " + (mesh.dimension == 2 ? "area " : "volume ") + size +
                             ", expected a positive one");
  };
  report(inverted, "inverted element");
  report(flat, "element", mesh.dimension == 2 ? " without area" : " without volume");
  if (folded.empty()) return;
  Point place{0, 0, 0};
  const double jacobian = smallestJacobian(mesh, folded[0], &place);
  const CellInfo& shape = cellInfo(mesh.cells[folded[0]]);
  char text[200];
  std::snprintf(text, sizeof text,
                "; in element %d (%s) the determinant of the map from the reference element is %.3g there, expected a positive one ",
                folded[0], shape.name.c_str(), jacobian);
  problems.add("Mesh",
               mesh.source + ": " + countAt(folded.size(), "tangled element", placeText(place, mesh.dimension)) + text +
                   (shape.nodes > shape.vertices
                        ? "everywhere: sides cross, or a node of a side is too far from its middle; refine there, or mesh straight sides"
                    : mesh.dimension == 2 ? "everywhere: the quadrilateral is not convex"
                                          : "everywhere: its vertices are too far from those of a convex cell"));
}

// Reports nodes of no element. If every node has a body there are none; a node without a body may still belong to an element without one.
void checkNodes(const Mesh& mesh, Problems& problems) {
  if (std::find(mesh.bodyOfNode.begin(), mesh.bodyOfNode.end(), -1) == mesh.bodyOfNode.end()) return;
  std::vector<char> used(mesh.nodes(), 0);
  for (const int node : mesh.connectivity) used[node] = 1;
  const std::size_t orphans = std::count(used.begin(), used.end(), 0);
  if (orphans == 0) return;
  const int first = static_cast<int>(std::find(used.begin(), used.end(), 0) - used.begin());
  problems.add("Mesh", mesh.source + ": " + countAt(orphans, "node", placeText(mesh.point(first), mesh.dimension)) +
                           " in no element, and so in no body");
}

}  // namespace

void assignBodies(Mesh& mesh, const std::vector<std::string>& names) {
  Problems problems;
  mesh.bodies = names;
  mesh.bodyOfElement.assign(mesh.elements(), -1);
  mesh.bodyOfNode.assign(mesh.nodes(), -1);

  bool allKnown = true;
  for (int body = 0; body < static_cast<int>(names.size()); ++body) {
    const auto group = mesh.elementGroups.find(names[body]);
    if (group == mesh.elementGroups.end()) {
      allKnown = false;
      problems.add("Bodies/" + names[body],
                   "in the mesh " + mesh.source + ": " + unknownName(mesh.elementGroupKind(), names[body], mesh.elementGroupNames()));
      continue;
    }
    std::map<int, std::vector<int>> twice;  // other body -> elements
    for (const int e : group->second) {
      if (mesh.bodyOfElement[e] >= 0 && mesh.bodyOfElement[e] != body) twice[mesh.bodyOfElement[e]].push_back(e);
      mesh.bodyOfElement[e] = body;
    }
    for (const auto& [other, elements] : twice)
      problems.add("Bodies/" + names[body], countAt(elements.size(), "element", placeText(centreOf(mesh, elements[0]), mesh.dimension)) +
                                                " also in the body '" + names[other] + "'; an element belongs to one body");
  }

  // If a body is missing, its elements and nodes would only repeat that error.
  if (allKnown) {
    std::vector<int> homeless;
    std::map<std::pair<int, int>, std::vector<int>> shared;  // bodies -> nodes
    for (int e = 0; e < mesh.elements(); ++e) {
      const int body = mesh.bodyOfElement[e];
      if (body < 0) {
        homeless.push_back(e);
        continue;
      }
      for (const int node : mesh.nodesOf(e)) {
        int& owner = mesh.bodyOfNode[node];
        if (owner >= 0 && owner != body) {
          std::vector<int>& nodes = shared[std::minmax(owner, body)];
          if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
        } else {
          owner = body;
        }
      }
    }
    if (!homeless.empty())
      problems.add("Bodies", "the mesh " + mesh.source + " has " +
                                 countAt(homeless.size(), "element", placeText(centreOf(mesh, homeless[0]), mesh.dimension)) +
                                 " in none of the bodies (" + joinNames(names) +
                                 (mesh.dimension == 2 ? "). Surface groups: " : "). Volume groups: ") +
                                 joinNames(mesh.elementGroupNames()));
    for (const auto& [pair, nodes] : shared)
      problems.add("Bodies/" + names[pair.first],
                   "shares " + countAt(nodes.size(), "node", placeText(mesh.point(nodes[0]), mesh.dimension)) + " with the body '" +
                       names[pair.second] +
                       "'; bodies must not share nodes: mesh each as a separate shape (in Gmsh: no BooleanFragments across bodies)");
  }
  checkNodes(mesh, problems);
  checkShapes(mesh, problems);
  checkSidesFit(mesh, problems);
  problems.throwIfAny();
}

void makeAxisymmetric(Mesh& mesh) {
  double extent = 0.0;
  for (const double x : mesh.coordinates) extent = std::max(extent, std::abs(x));
  std::vector<int> beyond;
  for (int node = 0; node < mesh.nodes(); ++node) {
    double& radius = mesh.coordinates[std::size_t(node) * mesh.dimension];
    if (std::abs(radius) <= 1e-10 * extent) radius = 0.0;
    if (radius < 0.0) beyond.push_back(node);
  }
  if (!beyond.empty())
    throw InputError("Mesh", mesh.source + ": " + countAt(beyond.size(), "node", placeText(mesh.point(beyond[0]), mesh.dimension)) +
                                 " with negative x, but in an axisymmetric scene x is the radius; mesh the half plane x >= 0");
  mesh.axisymmetric = true;
}

}  // namespace suture
