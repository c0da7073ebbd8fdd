#pragma once
#include <Teuchos_Comm.hpp>
#include <Teuchos_DefaultComm.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/partition/Partition.hpp>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

// Meshes and parameters for the tests of partition. As in a run, only rank 0 has the mesh.
namespace partitiontesting {

using namespace suture;

inline Teuchos::RCP<const Comm> comm() { return Teuchos::DefaultComm<int>::getComm(); }
inline bool onRoot() { return comm()->getRank() == 0; }

Box box(const std::string& name, double x0, double x1, double y0, double y1, int nx, int ny, int blocksX = 1, int blocksY = 1);

Mesh mesh(const std::vector<Box>& all);

// Part of a mesh: the elements whose centres satisfy a predicate, as one body; element groups are kept, side groups are not.
template <typename Choice>
Mesh kept(const Mesh& whole, const Choice& choice) {
  Mesh made;
  if (!onRoot()) return made;
  std::vector<int> nodeOf(whole.nodes(), -1), elementOf(whole.elements(), -1);
  for (int e = 0; e < whole.elements(); ++e) {
    const Point centre = centreOf(whole, e);
    if (!choice(centre[0], centre[1])) continue;
    elementOf[e] = made.elements();
    made.cells.push_back(whole.cells[e]);
    for (int node : whole.nodesOf(e)) {
      if (nodeOf[node] < 0) {
        nodeOf[node] = made.nodes();
        made.coordinates.insert(made.coordinates.end(), {whole.point(node)[0], whole.point(node)[1]});
      }
      made.connectivity.push_back(nodeOf[node]);
    }
    made.offsets.push_back(static_cast<int>(made.connectivity.size()));
    made.elementGroups["all"].push_back(elementOf[e]);
  }
  for (const auto& [name, elements] : whole.elementGroups)
    for (int e : elements)
      if (elementOf[e] >= 0) made.elementGroups[name].push_back(elementOf[e]);
  assignBodies(made, {"all"});
  return made;
}

// The scene's list `Partition`, with "name=value" inside it.
struct PartitionParameters {
  SceneFile file;
  const Parameters& list() const { return file.parameters->sublist("Partition"); }
};
PartitionParameters parameters(std::vector<std::string> settings);
PartitionParameters metis(int subdomains, int seed = 1);
PartitionParameters named(const std::string& pattern);

// Pairs of the nodes of two side groups at the same place, as one piece each. (The search for pairs belongs to constraints.)
void addContact(const Mesh& mesh, const std::string& sideA, const std::string& sideB, Constraints& constraints);

// Components of one subdomain by brute force: two elements are neighbours when they have two nodes in common.
int connectedParts(const Mesh& mesh, const std::vector<int>& subdomainOfElement, int subdomain);

}  // namespace partitiontesting
