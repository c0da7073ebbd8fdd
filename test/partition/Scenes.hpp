#pragma once
#include <Teuchos_Comm.hpp>
#include <Teuchos_DefaultComm.hpp>
#include <suture/base/SceneReader.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/partition/Partition.hpp>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

// Meshes and parameters for the tests of partition. As in a run, only rank 0 has the mesh.
namespace scenes {

using namespace suture;

inline Teuchos::RCP<const Comm> comm() { return Teuchos::DefaultComm<int>::getComm(); }
inline bool onRoot() { return comm()->getRank() == 0; }

inline Box box(const std::string& name, double x0, double x1, double y0, double y1, int nx, int ny, int blocksX = 1, int blocksY = 1) {
  Box one;
  one.name = name;
  one.x0 = x0;
  one.x1 = x1;
  one.y0 = y0;
  one.y1 = y1;
  one.nx = nx;
  one.ny = ny;
  one.blocksX = blocksX;
  one.blocksY = blocksY;
  return one;
}

inline Mesh mesh(const std::vector<Box>& all) {
  if (!onRoot()) return {};
  std::vector<std::string> names;
  for (const Box& one : all) names.push_back(one.name);
  Mesh made = boxes(all);
  assignBodies(made, names);
  return made;
}

// What is left of a mesh when only the elements whose centres a predicate chooses stay, as one body; element groups come along, side groups
// do not.
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
inline PartitionParameters parameters(std::vector<std::string> settings) {
  for (std::string& setting : settings) setting = "Partition/" + setting;
  return {parseScene("<ParameterList name=\"Suture\"/>", "test.xml", Schema().list("Partition", partitionSchema()), settings)};
}
inline PartitionParameters metis(int subdomains, int seed = 1) {
  return parameters({"Type=METIS", "METIS/Subdomains=" + std::to_string(subdomains), "METIS/Seed=" + std::to_string(seed)});
}
inline PartitionParameters named(const std::string& pattern) {
  return parameters({"Type=Named Groups", "Named Groups/Pattern=" + pattern});
}

// Pairs of the nodes of two side groups that lie in the same place, as one piece each. (The search for pairs belongs to constraints.)
inline void addContact(const Mesh& mesh, const std::string& sideA, const std::string& sideB, Constraints& constraints) {
  if (!onRoot()) return;
  const auto nodesOf = [&](const std::string& group) {
    std::map<std::pair<double, double>, int> nodes;
    for (const Side& side : mesh.sideGroups.at(group))
      for (int node : mesh.nodesOf(side)) nodes[{mesh.point(node)[0], mesh.point(node)[1]}] = node;
    return nodes;
  };
  const auto a = nodesOf(sideA), b = nodesOf(sideB);
  ContactPiece piece;
  piece.name = sideA;
  for (const auto& [place, node] : a) {
    const auto other = b.find(place);
    if (other == b.end()) continue;
    ContactPair pair;
    pair.id = static_cast<int>(constraints.pairs.size());
    pair.piece = static_cast<int>(constraints.pieces.size());
    pair.ends = matchingEnds(node, other->second);
    constraints.pairs.push_back(pair);
    piece.pairs.push_back(pair.id);
  }
  constraints.pieces.push_back(piece);
}

// Components of one subdomain by brute force: two elements are neighbours when they have two nodes in common.
inline int connectedParts(const Mesh& mesh, const std::vector<int>& subdomainOfElement, int subdomain) {
  std::map<std::pair<int, int>, std::vector<int>> bySide;
  std::map<int, int> parent;
  for (int e = 0; e < mesh.elements(); ++e) {
    if (subdomainOfElement[e] != subdomain) continue;
    parent[e] = e;
    const auto nodes = mesh.nodesOf(e);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = i + 1; j < nodes.size(); ++j) bySide[std::minmax(nodes[i], nodes[j])].push_back(e);
  }
  const auto root = [&](int e) {
    while (parent[e] != e) e = parent[e];
    return e;
  };
  for (const auto& [side, elements] : bySide)
    for (int e : elements) parent[root(e)] = root(elements.front());
  return static_cast<int>(std::count_if(parent.begin(), parent.end(), [](const auto& entry) { return entry.first == entry.second; }));
}

}  // namespace scenes
