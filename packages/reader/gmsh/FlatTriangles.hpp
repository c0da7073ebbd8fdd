#pragma once
#include <suture/reader/gmsh/GmshMesh.hpp>

namespace suture {

/// Replaces triangles whose three vertices are on a line up to round-off: such a triangle and its neighbour at its longest edge become two
/// others, by a swap of that edge. The mid-side node of a second-order edge moves to the middle of the new one. A 2D mesh only; nothing
/// else changes. Local (rank 0).
/// Triangles without such a neighbour, in the same surface, stay.
/// \return  number of swapped edges
int swapFlatTriangles(GmshMesh& mesh);

}  // namespace suture
