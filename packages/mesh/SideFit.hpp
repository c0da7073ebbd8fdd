#pragma once
#include <suture/base/Errors.hpp>
#include <suture/mesh/Mesh.hpp>

namespace suture {

/// Checks that a 3D mesh is conforming where several kinds of cells, or cells with triangles and quadrilaterals, may meet: sides with the
/// same vertices have the same nodes, and no triangle lies on a quadrilateral of another element (a pyramid is missing there). Other meshes
/// are not checked. Every problem goes to `problems`, with its location. Local (rank 0).
void checkSidesFit(const Mesh& mesh, Problems& problems);

}  // namespace suture
