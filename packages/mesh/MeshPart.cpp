#include <suture/mesh/MeshPart.hpp>

namespace suture {

MeshPart partOf(const Mesh& whole, const std::vector<char>& keeps) {
  MeshPart part;
  Mesh& mesh = part.mesh;
  mesh.dimension = whole.dimension;
  mesh.source = whole.source;
  std::vector<int> node(static_cast<std::size_t>(whole.nodes()), -1), element(static_cast<std::size_t>(whole.elements()), -1);
  for (int e = 0; e < whole.elements(); ++e)
    if (keeps[static_cast<std::size_t>(e)])
      for (const int n : whole.nodesOf(e)) node[static_cast<std::size_t>(n)] = 0;
  for (int n = 0; n < whole.nodes(); ++n) {
    if (node[static_cast<std::size_t>(n)] < 0) continue;
    node[static_cast<std::size_t>(n)] = static_cast<int>(part.nodeOfWhole.size());
    part.nodeOfWhole.push_back(n);
    for (int k = 0; k < whole.dimension; ++k)
      mesh.coordinates.push_back(
          whole.coordinates[static_cast<std::size_t>(n) * static_cast<std::size_t>(whole.dimension) + static_cast<std::size_t>(k)]);
  }
  for (int e = 0; e < whole.elements(); ++e) {
    if (!keeps[static_cast<std::size_t>(e)]) continue;
    element[static_cast<std::size_t>(e)] = mesh.elements();
    mesh.cells.push_back(whole.cells[static_cast<std::size_t>(e)]);
    for (const int n : whole.nodesOf(e)) mesh.connectivity.push_back(node[static_cast<std::size_t>(n)]);
    mesh.offsets.push_back(static_cast<int>(mesh.connectivity.size()));
  }
  for (const auto& [name, members] : whole.elementGroups) {
    std::vector<int>& own = mesh.elementGroups[name];
    for (const int e : members)
      if (element[static_cast<std::size_t>(e)] >= 0) own.push_back(element[static_cast<std::size_t>(e)]);
  }
  for (const auto& [name, sides] : whole.sideGroups) {
    std::vector<Side>& own = mesh.sideGroups[name];
    for (const Side& side : sides)
      if (element[static_cast<std::size_t>(side.element)] >= 0) own.push_back({element[static_cast<std::size_t>(side.element)], side.side});
  }
  return part;
}

}  // namespace suture
