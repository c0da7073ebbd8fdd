#pragma once
#include <suture/answer/bound/BoundParts.hpp>

#include <array>
#include <vector>

namespace suture {

/// A plane side with four vertices of a cell, of which a contact side is a triangle; without nodes: none.
struct WholeSide {
  std::vector<GlobalId> nodes;  ///< 4 or 9
  /// For each node integrals over the side of its function, and of it times the place relative to the mean of the vertices: in the cell,
  /// and on the triangles. [area, area x length]
  std::vector<double> ofCell, ofTriangles;

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.nodes), each(self.ofCell), each(self.ofTriangles);
  }
};

/// Values that vary linearly: at the mean of the vertices, then derivatives along x, y and z.
using LinearTraction = std::array<Point, 4>;

/// Local.
WholeSide wholeSide(const SubdomainMesh& mesh, const BoundParts<3>& parts, const PlaceOfSide& place);

/// Replaces the forces of a linear traction on the nodes of a cell by those on the nodes of its triangles: opposite sides of a contact have
/// the same triangles. Only for the first triangle of a whole side. Local.
void replaceLinearTraction(const BoundedSolution& solution, const PlaceOfSide& place, const LinearTraction& traction, BoundParts<3>& parts);

}  // namespace suture
