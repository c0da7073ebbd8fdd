#pragma once
#include <suture/mesh/Mesh.hpp>

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

}  // namespace suture
