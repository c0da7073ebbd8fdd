#pragma once
#include <suture/adapt/Bisection.hpp>
#include <suture/adapt/SimplicialMesh.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/mesh/SideGeometry.hpp>
#include <suture/pairs/MatchingPairs.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <random>

/// Meshes and independent measures for tests of refinement.
namespace adapttesting {

using namespace suture;

constexpr double pi = 3.14159265358979323846;

inline Box box(const std::string& name, Cell cell, int n, double y0 = 0, double y1 = 1) {
  Box made;
  made.name = name;
  made.cell = cell;
  made.nx = made.ny = made.nz = n;
  (dimensionOf(cell) == 2 ? made.y0 : made.z0) = y0;
  (dimensionOf(cell) == 2 ? made.y1 : made.z1) = y1;
  return made;
}

/// Moves every node; mid-side nodes as well.
inline void move(Mesh& mesh, const std::function<Point(Point)>& to) {
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Point p = to(mesh.point(node));
    for (int k = 0; k < mesh.dimension; ++k) mesh.coordinates[std::size_t(node) * mesh.dimension + k] = p[k];
  }
}

/// Smooth, without symmetry; keeps the planes x, y, z = 0, 1, 2, and planes of equal height match across them.
inline Point waved(const Point& p) {
  const double s = 0.03 * std::sin(3.14159265358979 * p[0]) * std::sin(3.14159265358979 * p[1]);
  return {p[0] + s + 0.02 * std::sin(6.2831853071795865 * p[0]), p[1] + 1.7 * s, p[2]};
}

/// The same mesh with nodes and elements in random order, and elements rotated.
inline Mesh renumbered(const Mesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<int> node(mesh.nodes()), element(mesh.elements());
  std::iota(node.begin(), node.end(), 0);
  std::iota(element.begin(), element.end(), 0);
  std::shuffle(node.begin(), node.end(), random);
  std::shuffle(element.begin(), element.end(), random);
  Mesh made = mesh;
  std::vector<int> newElement(element.size());
  for (int n = 0; n < mesh.nodes(); ++n) {
    for (int k = 0; k < mesh.dimension; ++k)
      made.coordinates[std::size_t(node[n]) * mesh.dimension + k] = mesh.coordinates[std::size_t(n) * mesh.dimension + k];
    made.bodyOfNode[node[n]] = mesh.bodyOfNode[n];
  }
  made.connectivity.clear();
  made.offsets = {0};
  for (std::size_t i = 0; i < element.size(); ++i) {
    const int e = element[i];
    newElement[e] = static_cast<int>(i);
    made.cells[i] = mesh.cells[e];
    made.bodyOfElement[i] = mesh.bodyOfElement[e];
    for (const int n : mesh.nodesOf(e)) made.connectivity.push_back(node[n]);
    made.offsets.push_back(static_cast<int>(made.connectivity.size()));
  }
  for (auto& [name, members] : made.elementGroups)
    for (int& e : members) e = newElement[e];
  for (auto& [name, sides] : made.sideGroups)
    for (Side& side : sides) side.element = newElement[side.element];
  return made;
}

/// Area or volume of an element with straight sides, by its vertices.
inline double sizeOf(const Mesh& mesh, int e) {
  const Span<const int> n = mesh.nodesOf(e);
  const Point a = mesh.point(n[0]), u = minus(mesh.point(n[1]), a), v = minus(mesh.point(n[2]), a);
  if (mesh.dimension == 2) return cross(u, v)[2] / 2;
  return dot(cross(u, v), minus(mesh.point(n[3]), a)) / 6;
}

inline double sizeOfBody(const Mesh& mesh, int body) {
  double sum = 0;
  for (int e = 0; e < mesh.elements(); ++e)
    if (mesh.bodyOfElement[e] == body) sum += sizeOf(mesh, e);
  return sum;
}

/// Length or area of straight sides.
inline double sizeOf(const Mesh& mesh, const Side& side) {
  const std::vector<int> n = mesh.nodesOf(side);
  if (mesh.dimension == 2) return norm(minus(mesh.point(n[1]), mesh.point(n[0])));
  return norm(cross(minus(mesh.point(n[1]), mesh.point(n[0])), minus(mesh.point(n[2]), mesh.point(n[0])))) / 2;
}

inline double sizeOfGroup(const Mesh& mesh, const std::string& name) {
  double sum = 0;
  for (const Side& side : mesh.sideGroups.at(name)) sum += sizeOf(mesh, side);
  return sum;
}

/// Length or area of all sides that belong to one element only: that of the boundary of the bodies if, and only if, no node hangs.
inline double sizeOfOutline(const Mesh& mesh) {
  std::map<SideKey, std::pair<int, Side>> count;
  for (int e = 0; e < mesh.elements(); ++e)
    forEachSide(mesh, e, [&](const SideKey& key, const Side& side) {
      auto& entry = count[key];
      ++entry.first;
      entry.second = side;
    });
  double sum = 0;
  for (const auto& [key, entry] : count) {
    if (entry.first > 2) return std::numeric_limits<double>::quiet_NaN();
    if (entry.first == 1) sum += sizeOf(mesh, entry.second);
  }
  return sum;
}

/// Smallest ratio of the radii of the inscribed and circumscribed circle, times 2 (1 for equilateral triangles); of tetrahedra of
/// volume over the cube of the quadratic mean edge, times 6 sqrt(2) (1 for regular ones).
inline double worstShape(const Mesh& mesh) {
  double worst = 1;
  for (int e = 0; e < mesh.elements(); ++e) {
    double squares = 0;
    const CellInfo& cell = cellInfo(mesh.cells[e]);
    const Span<const int> n = mesh.nodesOf(e);
    for (const auto& [i, j] : cell.edges) {
      const Point d = minus(mesh.point(n[i]), mesh.point(n[j]));
      squares += dot(d, d);
    }
    const double shape = mesh.dimension == 2 ? 4 * std::sqrt(3.0) * sizeOf(mesh, e) / squares
                                             : 6 * std::sqrt(2.0) * sizeOf(mesh, e) / std::pow(squares / 6, 1.5);
    worst = std::min(worst, shape);
  }
  return worst;
}

/// Smallest angle of the triangles of a 2D mesh, in degrees.
inline double smallestAngle(const Mesh& mesh) {
  double least = 180;
  for (int e = 0; e < mesh.elements(); ++e)
    for (int k = 0; k < 3; ++k) {
      const Span<const int> n = mesh.nodesOf(e);
      const Point a = mesh.point(n[k]);
      least = std::min(least,
                       180 / 3.14159265358979 * angleBetween(minus(mesh.point(n[(k + 1) % 3]), a), minus(mesh.point(n[(k + 2) % 3]), a)));
    }
  return least;
}

/// Marks the elements near a point: those whose centre is closer than their diameter. In 2D its third component is ignored.
inline std::vector<char> near(const Mesh& mesh, Point place) {
  if (mesh.dimension == 2) place[2] = 0;
  std::vector<char> marked(mesh.elements(), 0);
  for (int e = 0; e < mesh.elements(); ++e) marked[e] = norm(minus(centreOf(mesh, e), place)) < diameterOf(mesh, e);
  return marked;
}

inline std::vector<char> atRandom(const Mesh& mesh, double share, std::mt19937& random) {
  std::vector<char> marked(mesh.elements(), 0);
  for (char& mark : marked) mark = std::uniform_real_distribution<double>()(random) < share;
  return marked;
}

inline std::vector<char> all(const Mesh& mesh) { return std::vector<char>(mesh.elements(), 1); }

/// Centres of all elements in ascending order, rounded to 1e-9: the same for the same mesh with other numbers.
inline std::vector<std::array<long long, 3>> centres(const Mesh& mesh) {
  std::vector<std::array<long long, 3>> found;
  for (int e = 0; e < mesh.elements(); ++e) {
    const Point c = centreOf(mesh, e);
    found.push_back({std::llround(c[0] * 1e9), std::llround(c[1] * 1e9), std::llround(c[2] * 1e9)});
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Largest distance of the mid-side nodes from the middles of their edges.
inline double largestBow(const Mesh& mesh) {
  double bow = 0;
  for (int e = 0; e < mesh.elements(); ++e) {
    const CellInfo& cell = cellInfo(mesh.cells[e]);
    const Span<const int> n = mesh.nodesOf(e);
    for (std::size_t k = 0; cell.order == 2 && k < cell.edges.size(); ++k) {
      const Point middle = scaled(0.5, plus(mesh.point(n[cell.edges[k][0]]), mesh.point(n[cell.edges[k][1]])));
      bow = std::max(bow, norm(minus(mesh.point(n[cell.vertices + k]), middle)));
    }
  }
  return bow;
}

/// The contact of two boxes on top of each other.
inline const std::vector<Contact>& contact() {
  static const std::vector<Contact> all{Contact::between("lower_top", "upper_bottom")};
  return all;
}

/// Number of nodes of the lower face of the contact without a partner above. \throws InputError  if the faces do not match
inline int unmatched(const Mesh& mesh, const Contact& between = contact().front()) {
  Problems problems;
  const std::vector<ContactSurface> surfaces = contactsOn(mesh, {between}, problems);
  problems.throwIfAny();
  const std::optional<PairedSurface> pairs = matchingPairs(mesh, surfaces.front(), &problems);
  problems.throwIfAny();
  return pairs ? static_cast<int>(surfaces.front().a.surface->nodes().size() - pairs->pairs.size()) : -1;
}

/// Moves the second body away from the first, by a gap that varies along the contact.
inline void openGap(Mesh& mesh) {
  const int up = mesh.dimension - 1;
  for (int node = 0; node < mesh.nodes(); ++node)
    if (mesh.bodyOfNode[node] == 1) mesh.coordinates[std::size_t(node) * mesh.dimension + up] += 0.05 + 0.04 * mesh.point(node)[0];
}

}  // namespace adapttesting
