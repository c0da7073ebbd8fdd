#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/partition/NodeSubdomains.hpp>

#include <map>
#include <vector>

namespace suture {

/// Subdomains that hold the unknowns of a node in contact: those of the node, and for a node of a rigid group those of all its nodes, which
/// hold its masters. Local; the arguments must outlive it.
class PairHolders {
 public:
  /// \param holders  subdomains of the nodes that nodesInContact() lists
  PairHolders(const Constraints& constraints, const NodeSubdomains& holders);

  Span<const int> of(int node) const;

 private:
  const NodeSubdomains& holders_;
  std::map<int, std::vector<int>> ofGroups_;  // by group
  std::map<int, int> groupOf_;                // node -> group, only of groups that move
};

/// All nodes of pairs, and of the rigid groups to which they belong, some repeatedly. Local.
std::vector<int> nodesInContact(const Constraints& constraints);

}  // namespace suture
