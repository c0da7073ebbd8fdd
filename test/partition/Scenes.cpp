#include <partition/Scenes.hpp>

namespace partitiontesting {

Box box(const std::string& name, double x0, double x1, double y0, double y1, int nx, int ny, int blocksX, int blocksY) {
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

Mesh mesh(const std::vector<Box>& all) {
  if (!onRoot()) return {};
  std::vector<std::string> names;
  for (const Box& one : all) names.push_back(one.name);
  Mesh made = boxes(all);
  assignBodies(made, names);
  return made;
}

PartitionParameters parameters(std::vector<std::string> settings) {
  for (std::string& setting : settings) setting = "Partition/" + setting;
  return {parseScene("<ParameterList name=\"Suture\"/>", "test.xml", Schema().list("Partition", partitionSchema()), settings)};
}

PartitionParameters metis(int subdomains, int seed) {
  return parameters({"Type=METIS", "METIS/Subdomains=" + std::to_string(subdomains), "METIS/Seed=" + std::to_string(seed)});
}

PartitionParameters named(const std::string& pattern) { return parameters({"Type=Named Groups", "Named Groups/Pattern=" + pattern}); }

void addContact(const Mesh& mesh, const std::string& sideA, const std::string& sideB, Constraints& constraints) {
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

int connectedParts(const Mesh& mesh, const std::vector<int>& subdomainOfElement, int subdomain) {
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

}  // namespace partitiontesting
