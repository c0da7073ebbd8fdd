#pragma once
#include <suture/base/Errors.hpp>
#include <suture/mesh/Mesh.hpp>

namespace suture {

/// Checks that the elements of a mesh in space fit each other where several kinds of cells, or cells with triangles and quadrilaterals,
/// may meet: sides with the same vertices have the same nodes, and no triangle lies on a quadrilateral of another element, where a pyramid
/// is missing. Other meshes are not looked at. Every finding goes to `problems`, with its place. Local (rank 0).
void checkSidesFit(const Mesh& mesh, Problems& problems);

}  // namespace suture
