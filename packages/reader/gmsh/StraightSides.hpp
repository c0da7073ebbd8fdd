#pragma once
#include <suture/mesh/Mesh.hpp>

#include <string>
#include <vector>

namespace suture {

/// Elements whose sides became straighter.
struct Straightened {
  int elements = 0;
  double distance = 0.0;  ///< largest distance by which a mid-side node moved [length]
  Point place{0, 0, 0};   ///< where that node was
};

/// Moves the mid-side nodes of tangled second-order triangles and tetrahedra towards the middle of their straight edges, in quarters of the
/// way, until no element is tangled: curved sides may turn an element inside out where the element is large compared with the radius of the
/// side, or thin. Vertices stay where they are. Elements that are tangled with straight sides, too, are left for assignBodies() to refuse.
/// Local (rank 0).
Straightened straightenTangled(Mesh& mesh);

/// Moves the mid-side nodes of all second-order triangles and tetrahedra into the middle of their edges, except those on the sides of some
/// groups. Local (rank 0). \param kept  names of side groups \return the largest distance by which a node moved [length]
double straightenSides(Mesh& mesh, const std::vector<std::string>& kept);

}  // namespace suture
