#pragma once
#include <suture/adapt/ContactTwins.hpp>
#include <suture/adapt/NodeOrigin.hpp>
#include <suture/adapt/RoundShapes.hpp>
#include <suture/mesh/Mesh.hpp>

#include <vector>

namespace suture {

/// A mesh cut into triangles or tetrahedra.
struct SimplicialMesh {
  Mesh mesh;                        ///< with the bodies, groups and regions of the given mesh
  std::vector<int> parent;          ///< element of the given mesh, by element; ascending
  std::vector<int> nodeOfWhole;     ///< node of the given mesh, by node; ascending, then -1 for new nodes
  std::vector<NodeOrigin> origins;  ///< places of the new nodes in the given mesh
};

/// Cuts all cells of a mesh into simplices: quadrilaterals in 2D along the shorter diagonal, cells in 3D from their lowest vertex, and
/// their quadrilateral sides from the lowest vertex of the side, so that neighbours fit. Vertices are ordered by their coordinates,
/// opposite ones of a contact alike, so that matching faces stay matching. A hexahedron becomes six tetrahedra, a wedge three, a pyramid
/// two. New mid-side nodes lie on the given cells if these are of second order, else in the middle of the edge or on round sides. Simplices
/// stay as they are. Local (rank 0). \param mesh   without coatings \param order  1 or 2; 0: 2 if any cell is of second order \param twins
/// contactTwins(); used in 3D only \throws InputError  cells so warped that a tetrahedron would be inverted: number and place \throws
/// InternalError  coatings
SimplicialMesh simplicialMesh(const Mesh& mesh, int order = 0, const std::vector<NodePairs>& twins = {},
                              Boundary boundary = Boundary::Round);

/// Moves the mid-side nodes of second-order simplices to the middles of their edges: the polygon or polyhedron of the vertices. Local.
void straightenEdges(Mesh& mesh);

}  // namespace suture
