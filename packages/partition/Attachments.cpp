#include <suture/constraints/ContactRows.hpp>
#include <suture/partition/Attachments.hpp>
#include <suture/partition/PairHolders.hpp>

#include <algorithm>

namespace suture {

namespace {

/// Distribution of contact rows: every row of a cluster goes to all subdomains that hold a node of any pair in it.
struct SharedRows {
  std::vector<std::vector<int>> holders;  ///< subdomains by cluster (its lowest pair), ascending
  std::vector<std::vector<int>> pairs;    ///< by subdomain, ascending
};

SharedRows shareRows(const std::vector<ContactRow>& rows, const PairHolders& holdersOfNodes, int subdomains) {
  SharedRows shared{std::vector<std::vector<int>>(rows.size()), std::vector<std::vector<int>>(subdomains)};
  std::vector<std::vector<int>> members(rows.size());
  for (std::size_t p = 0; p < rows.size(); ++p) {
    const int cluster = rows[p].cluster;
    members[cluster].push_back(static_cast<int>(p));
    for (const PairEnd& end : rows[p].pair.ends) {
      const auto own = holdersOfNodes.of(end.node);
      shared.holders[cluster].insert(shared.holders[cluster].end(), own.begin(), own.end());
    }
  }
  for (std::size_t cluster = 0; cluster < rows.size(); ++cluster) {
    std::vector<int>& all = shared.holders[cluster];
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (int s : all) shared.pairs[s].insert(shared.pairs[s].end(), members[cluster].begin(), members[cluster].end());
  }
  for (std::vector<int>& own : shared.pairs) std::sort(own.begin(), own.end());
  return shared;
}

/// Subdomains that have the row of a pair of a cell, ascending: all subdomains that share its unknown must see the same cells around it. A
/// subdomain without a node of the cell may share an unknown of it through another pair of the cluster.
std::vector<int> holdersOf(const std::vector<int>& cell, const std::vector<ContactRow>& rows, const SharedRows& shared) {
  std::vector<int> all;
  for (const int pair : cell) {
    const std::vector<int>& own = shared.holders[rows[pair].cluster];
    all.insert(all.end(), own.begin(), own.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

std::vector<Attachments> attachmentsOf(const Mesh& mesh, const Constraints& constraints, const Partition& partition, const MeshShare& share,
                                       int ranks, const NodeSubdomains& contactHolders) {
  std::vector<Attachments> all(ranks);
  const auto rankOf = [&](const std::vector<int>& bodies, int i) { return bodies.empty() ? 0 : share.rankOfBody(bodies[i]); };
  const auto ofElement = [&](int e) -> Attachments& { return all[rankOf(mesh.bodyOfElement, e)]; };
  const auto ofNode = [&](int node) -> Attachments& { return all[rankOf(mesh.bodyOfNode, node)]; };
  for (const auto& [name, sides] : mesh.sideGroups)
    for (const Side& side : sides) ofElement(side.element).sideGroups[name].push_back(side);
  for (const NodeRule& rule : constraints.rules) ofNode(rule.node).rules.push_back(rule);
  for (const Support& support : constraints.supports) ofNode(support.node).supports.push_back(support);
  for (const RigidGroup& group : constraints.rigidGroups) ofNode(group.nodes.front()).rigidGroups.push_back(group);
  for (const SpringDirection& spring : constraints.springs) ofElement(spring.element).springs.push_back(spring);
  for (const ContactPair& pair : constraints.pairs)
    for (std::size_t end = 0; end < pair.ends.size(); ++end) {
      const int node = pair.ends[end].node;
      ofNode(node).contactEnds.push_back({pair.id, static_cast<int>(end), node});
    }

  const std::vector<ContactRow> rows = contactRows(mesh, constraints);
  const SharedRows shared = shareRows(rows, PairHolders(constraints, contactHolders), partition.subdomains());
  std::vector<std::map<int, int>> placeOf(ranks);  // pair -> index in the rank's rows
  for (int s = 0; s < partition.subdomains(); ++s) {
    if (shared.pairs[s].empty()) continue;
    const int rank = share.rankOfBody(partition.bodyOf[s]);
    std::vector<int>& places = all[rank].rowsOf[s];
    for (const int pair : shared.pairs[s]) {
      const auto [at, isNew] = placeOf[rank].emplace(pair, static_cast<int>(all[rank].rows.size()));
      if (isNew) all[rank].rows.push_back(rows[pair]);
      places.push_back(at->second);
    }
  }
  if (mesh.dimension == 2) return all;  // along a line the numbers of pairs define the neighbours
  for (const ContactPiece& piece : constraints.pieces)
    for (const std::vector<int>& cell : piece.cells) {
      std::map<int, int> placeAt;  // by rank
      for (const int s : holdersOf(cell, rows, shared)) {
        Attachments& own = all[share.rankOfBody(partition.bodyOf[s])];
        const auto [at, isNew] = placeAt.emplace(share.rankOfBody(partition.bodyOf[s]), static_cast<int>(own.cells.size()));
        if (isNew) own.cells.push_back(cell);
        own.cellsOf[s].push_back(at->second);
      }
    }
  return all;
}

}  // namespace suture
