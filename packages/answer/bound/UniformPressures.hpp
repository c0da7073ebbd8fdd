#pragma once
#include <suture/answer/bound/BoundParts.hpp>

#include <vector>

namespace suture {

/// A plane side with four vertices of a cell of order 1, of which a contact side is a triangle; without vertices: none.
struct WholeSide {
  std::vector<GlobalId> vertices;
  /// Integrals over the side of the functions of its vertices, in the cell and on the triangles. [area]
  std::vector<double> ofCell, ofTriangles;

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.vertices), each(self.ofCell), each(self.ofTriangles);
  }
};

/// Local.
WholeSide wholeSide(const SubdomainMesh& mesh, const BoundParts<3>& parts, const PlaceOfSide& place);

/// The forces of a uniform pressure on the nodes of a cell become those on the nodes of its triangles, which are different: opposite sides
/// of a contact have the same. Only for the first triangle of a whole side. Local.
void replaceUniformPressure(const BoundedSolution& solution, const PlaceOfSide& place, double pressure, BoundParts<3>& parts);

}  // namespace suture
