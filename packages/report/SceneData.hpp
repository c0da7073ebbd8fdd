#pragma once
#include <suture/base/scene/SceneReader.hpp>
#include <suture/mesh/Mesh.hpp>

#include <string>

namespace suture {

/// Writes a scene before it is solved, as input of a drawing (suture_plot --scene): a VTKHDF file whose cells are the elements in 2D, and
/// the outer faces of the bodies in 3D, with the cell data Body and the point data NodeId. /Record has the texts Scene (JSON: the resolved
/// parameters), InputPath and Bodies (JSON), the attribute `dimension`, and for each side group of the mesh a dataset
/// `/Record/SideGroups/<name>` as in fields, in 3D also `/Record/GroupCells/<name>`: the numbers of its cells. The file is complete or does
/// not exist. Collective. \param mesh  with its bodies, on rank 0  \throws EnvironmentError  the file cannot be written
void writeSceneData(const Comm& comm, const Mesh& mesh, const SceneFile& scene, const std::string& path);

}  // namespace suture
