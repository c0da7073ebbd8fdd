#include <suture/base/Errors.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/Mesh.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace suture {

namespace {

constexpr double leastJacobian = 1e-12;  // relative to the element's own size; a sliver of aspect ratio 1e8 still passes

// Most elements of most large meshes, without a call: the determinant of a bilinear map is least in a corner, where it is a quarter of the
// product of the two edges. 935,000 triangles or 500,000 quadrilaterals take about 0.03 s instead of 0.1 and 0.25 s.
bool isSound(const Mesh& mesh, int e) {
  const Cell cell = mesh.cells[e];
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
  return least > (corners == 3 ? 1 : 4) * leastJacobian * square;
}

void checkShapes(const Mesh& mesh, Problems& problems) {
  std::vector<int> inverted, flat, folded;
  for (int e = 0; e < mesh.elements(); ++e) {
    if (isSound(mesh, e)) continue;
    const double diameter = diameterOf(mesh, e);
    const double jacobian = smallestJacobian(mesh, e);
    if (jacobian > leastJacobian * diameter * diameter) continue;
    const double area = signedArea(mesh, e);
    (area > leastJacobian * diameter * diameter ? folded : area < -leastJacobian * diameter * diameter ? inverted : flat).push_back(e);
  }
  const auto report = [&](const std::vector<int>& bad, const std::string& what) {
    if (bad.empty()) return;
    char area[40];
    std::snprintf(area, sizeof area, "%.6g", signedArea(mesh, bad[0]));
    problems.add("Mesh", mesh.source + ": " + countAt(bad.size(), what, placeText(centreOf(mesh, bad[0]), mesh.dimension)) + "; element " +
                             std::to_string(bad[0]) + " has the area " + area + ", expected a positive one");
  };
  report(inverted, "inverted element");
  report(flat, "element without area");
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
                        : "everywhere: the quadrilateral is not convex"));
}

// Nodes of no element. There are none where every node has a body; one without may still be of an element that has none either.
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
                   "in the mesh " + mesh.source + ": " + unknownName("surface group", names[body], mesh.elementGroupNames()));
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

  // With a body missing, its elements and nodes would only repeat that error.
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
                                 "). Surface groups: " + joinNames(mesh.elementGroupNames()));
    for (const auto& [pair, nodes] : shared)
      problems.add("Bodies/" + names[pair.first],
                   "shares " + countAt(nodes.size(), "node", placeText(mesh.point(nodes[0]), mesh.dimension)) + " with the body '" +
                       names[pair.second] +
                       "'; bodies share no nodes: mesh each as a shape of its own (in Gmsh: no BooleanFragments across)");
  }
  checkNodes(mesh, problems);
  checkShapes(mesh, problems);
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
