#include <suture/partition/PairHolders.hpp>

#include <algorithm>
#include <set>

namespace suture {

namespace {

std::map<int, int> groupOfNode(const Constraints& constraints) {
  std::map<int, int> all;
  for (std::size_t g = 0; g < constraints.rigidGroups.size(); ++g)
    if (constraints.rigidGroups[g].masters() > 0)
      for (const int node : constraints.rigidGroups[g].nodes) all.emplace(node, static_cast<int>(g));
  return all;
}

}  // namespace

PairHolders::PairHolders(const Constraints& constraints, const NodeSubdomains& holders)
    : holders_(holders), groupOf_(groupOfNode(constraints)) {
  for (const ContactPair& pair : constraints.pairs) {
    if (groupOf_.empty()) return;
    for (const PairEnd& end : pair.ends) {
      const auto found = groupOf_.find(end.node);
      if (found == groupOf_.end() || ofGroups_.count(found->second)) continue;
      std::set<int> subdomains;
      for (const int node : constraints.rigidGroups[static_cast<std::size_t>(found->second)].nodes)
        for (const int s : holders.of(node)) subdomains.insert(s);
      ofGroups_.emplace(found->second, std::vector<int>(subdomains.begin(), subdomains.end()));
    }
  }
}

Span<const int> PairHolders::of(int node) const {
  if (!groupOf_.empty())
    if (const auto found = groupOf_.find(node); found != groupOf_.end()) {
      const std::vector<int>& all = ofGroups_.at(found->second);
      return {all.data(), all.size()};
    }
  return holders_.of(node);
}

std::vector<int> nodesInContact(const Constraints& constraints) {
  const std::map<int, int> groupOf = groupOfNode(constraints);
  std::set<int> groups;
  std::vector<int> nodes;
  for (const ContactPair& pair : constraints.pairs)
    for (const PairEnd& end : pair.ends) {
      nodes.push_back(end.node);
      if (const auto found = groupOf.find(end.node); found != groupOf.end()) groups.insert(found->second);
    }
  for (const int group : groups) {
    const std::vector<int>& all = constraints.rigidGroups[static_cast<std::size_t>(group)].nodes;
    nodes.insert(nodes.end(), all.begin(), all.end());
  }
  return nodes;
}

}  // namespace suture
