#pragma once
#include <suture/adapt/ContactTwins.hpp>
#include <suture/adapt/NodeOrigin.hpp>
#include <suture/adapt/RoundShapes.hpp>
#include <suture/mesh/Mesh.hpp>

#include <vector>

namespace suture {

/// A mesh of triangles or of tetrahedra, of first or second order, with what bisection remembers from level to level.
struct RefinableMesh {
  Mesh mesh;                         ///< the refinement edge of each element is its first, from vertex 0 to vertex 1
  std::vector<unsigned char> marks;  ///< tetrahedra: marked edges of their faces (MarkedSimplex); empty in 2D
  std::vector<NodePairs> twins;      ///< opposite vertices of each contact, carried on by bisect(): their edges are bisected together
  RoundSides round;                  ///< curved boundary that new nodes are placed on
};

/// Prepares a mesh for bisection: finds a refinement edge for each element, its longest; between edges of equal length (to 1e-9) the place
/// decides, so that the result does not depend on the numbering. Edges opposite across a contact count as one. Mid-side nodes on
/// round sides may move a little: placeMiddlesOpposite(). Local (rank 0).
/// \param mesh  with bodies (assignBodies()), of simplices (simplicialMesh()), without coatings \param twins  contactTwins(); pairs of
/// mid-side nodes are ignored \throws InternalError  other cells, coatings
RefinableMesh refinable(Mesh mesh, std::vector<NodePairs> twins, Boundary boundary = Boundary::Round);

/// One level of refinement. Nodes of the coarse mesh keep their numbers and places; parts of an element follow each other, in the order of
/// the coarse elements.
struct Refinement {
  RefinableMesh fine;
  std::vector<int> parent;          ///< element of the coarse mesh, by element of the fine one; ascending
  std::vector<NodeOrigin> origins;  ///< places of the new nodes: origins[i] belongs to node coarse.nodes() + i

  /// Field of the coarse mesh at the nodes of the fine one. Local. \param values  coarse nodes x components
  Matrix interpolated(const Mesh& coarse, const Matrix& values) const;
};

/// Bisects the marked elements D times, into 2^D parts of half the size, and further elements until the mesh is conforming and opposite
/// edges of contacts are bisected alike. Bodies, groups, regions, axisymmetry and twins go to the fine mesh. Local (rank 0).
/// \param marked  by element
Refinement bisect(const RefinableMesh& coarse, const std::vector<char>& marked);

}  // namespace suture
