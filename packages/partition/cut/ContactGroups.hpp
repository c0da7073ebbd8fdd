#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/partition/NodeSubdomains.hpp>

#include <vector>

namespace suture {

/// Contact groups: a group consists of all subdomains that hold a node of a contact piece; pieces whose groups share a subdomain make one
/// group.
struct ContactGroups {
  std::vector<int> groupOf;                ///< subdomain -> group, or -1
  std::vector<std::vector<int>> groups;    ///< group -> its subdomains, ascending; groups in the order of their first pieces
  std::vector<std::vector<int>> piecesOf;  ///< group -> its pieces, ascending
};

/// Local (rank 0).
ContactGroups contactGroups(const Constraints& constraints, const NodeSubdomains& holders, int subdomains);

}  // namespace suture
