#pragma once
#include <suture/adapt/ContactTwins.hpp>
#include <suture/mesh/Mesh.hpp>

#include <vector>

namespace suture {

/// Arranges each triangle or tetrahedron of a mesh so that its refinement edge, the longest, comes first, and returns the marks of
/// tetrahedra: the marked edge of a face is its longest. Edges of equal length (to 1e-9) are ordered by the places of their middles, and
/// edges opposite across a contact have the same rank, so that the marks of opposite faces agree. Side groups follow. Local (rank 0).
std::vector<unsigned char> markLongestEdges(Mesh& mesh, const std::vector<NodePairs>& twins);

}  // namespace suture
