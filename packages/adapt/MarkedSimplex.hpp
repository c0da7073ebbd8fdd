#pragma once
#include <array>
#include <utility>

namespace suture {

/// A triangle (D = 2) or tetrahedron (D = 3), positive, with the edge at whose middle it is bisected: from vertex 0 to vertex 1.
///
/// Triangles: newest-vertex bisection; the refinement edge of a child is opposite to the new vertex. Tetrahedra: Arnold, Mukherjee and
/// Pouly, Locally adapted tetrahedral meshes using bisection, SIAM J. Sci. Comput. 22 (2000): each face has a marked edge, the same for
/// both of its tetrahedra. Faces are then bisected like triangles, whatever the tetrahedra on their two sides. From any conforming mesh
/// with such marks the closure ends, and each initial tetrahedron has descendants of finitely many shapes.
template <int D>
struct MarkedSimplex {
  std::array<int, D + 1> vertices{};
  std::array<int, D + 1> tags{};  ///< tag of the side opposite to each vertex, inherited by its parts; 0: none, as on new sides
  unsigned char marks = 0;        ///< tetrahedra: marked edges of the faces opposite to vertices 0 and 1, and the flag; see faceMarks()
};

/// Marks of a tetrahedron a b c d with the refinement edge a b. \param oppositeA, oppositeB  marked edge of the face b c d and of a c d:
/// 0: to c, 1: to d, 2: c d \param flag  set where the parent had the type P_u. Local.
constexpr unsigned char faceMarks(int oppositeA, int oppositeB, bool flag) {
  return static_cast<unsigned char>(oppositeA + 3 * oppositeB + (flag ? 9 : 0));
}

/// The two parts of a simplex: the first keeps vertex 0, the second vertex 1. Local. \param middle  node at the middle of edge 0 1
template <int D>
std::pair<MarkedSimplex<D>, MarkedSimplex<D>> bisected(const MarkedSimplex<D>& parent, int middle);

/// A positive tetrahedron arranged so that its refinement edge comes first. Local.
/// \param edge  local ends of the refinement edge \param faceEdge  local ends of the marked edge of the face opposite to each vertex
MarkedSimplex<3> arranged(const MarkedSimplex<3>& given, const std::array<int, 2>& edge, const std::array<std::array<int, 2>, 4>& faceEdge,
                          bool flag);

}  // namespace suture
