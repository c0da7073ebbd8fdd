#pragma once
#include <suture/adapt/ContactTwins.hpp>
#include <suture/mesh/Mesh.hpp>

#include <optional>
#include <utility>
#include <vector>

namespace suture {

/// A circle in 2D, a sphere or a circular cylinder in 3D, through the nodes of some sides of a mesh.
struct RoundShape {
  Point centre{0, 0, 0};  ///< centre of the circle or sphere; a point on the axis of the cylinder [length]
  Point axis{0, 0, 0};    ///< unit axis of a cylinder; zero for circles and spheres
  double radius = 0.0;    ///< [length]

  /// Nearest point of the shape. Local.
  Point project(const Point& point) const;
  /// Nearest point of the shape on a line; nothing if the line misses the shape or grazes it. Local.
  std::optional<Point> along(const Point& from, const Point& direction) const;
};

/// Round shapes of side groups, and the sides that lie on them.
struct RoundSides {
  std::vector<RoundShape> shapes;
  std::vector<std::pair<Side, int>> sides;  ///< side, number of its shape
};

/// How new nodes on the boundary are placed. Nodes inside follow the map of their element in both cases.
enum class Boundary {
  Round,     ///< on circles, spheres and cylinders where side groups have these shapes (findRoundSides()); else as Polygonal
  Polygonal  ///< on the sides of the coarse mesh: straight ones, or the parabolas of curved elements; meshes of all levels are nested
};

/// Finds the connected parts of side groups whose nodes all lie on a circle, sphere or cylinder (to 1e-6 of its radius). Sides of first
/// order must turn by at most 15 degrees from one to the next: coarser polygons may be meant as polygons. Local (rank 0).
RoundSides findRoundSides(const Mesh& mesh);

/// Moves the new nodes of round sides onto their shapes, except where an element would become flat or inverted; a node of several shapes
/// goes to their intersection. Across an open contact nodes move along the line to their opposite nodes, so that these stay opposite; else
/// along the normal of the shape. Local (rank 0).
/// \param twins  opposite vertices \param first  number of the first new node
void placeOnShapes(Mesh& mesh, const RoundSides& round, const std::vector<NodePairs>& twins, int first);

/// Moves mid-side nodes of round sides along their shapes until they are opposite across open contacts, as placeOnShapes() places new ones.
/// Distances are of third order in the size of the sides. Local (rank 0).
void placeMiddlesOpposite(Mesh& mesh, const RoundSides& round, const std::vector<NodePairs>& twins);

}  // namespace suture
