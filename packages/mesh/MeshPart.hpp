#pragma once
#include <suture/mesh/Mesh.hpp>

#include <vector>

namespace suture {

/// Some elements of a mesh with their nodes, as a mesh. Groups keep their names and lose the elements and sides that are missing. Nodes and
/// elements keep their order.
struct MeshPart {
  Mesh mesh;
  std::vector<int> nodeOfWhole;  ///< node of the part -> node of the whole mesh, ascending
};

/// The part of a mesh with marked elements; without bodies and regions (assignBodies(), assignRegions()). A side group may then lie where
/// the missing elements were. Local (rank 0). \param keeps  by element
MeshPart partOf(const Mesh& whole, const std::vector<char>& keeps);

}  // namespace suture
