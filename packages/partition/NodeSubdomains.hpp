#pragma once
#include <suture/base/Types.hpp>
#include <suture/mesh/CellBlock.hpp>

#include <vector>

namespace suture {

/// Subdomains that hold each node of a mesh. Compressed rows, ascending.
struct NodeSubdomains {
  std::vector<int> offsets{0};  ///< nodes + 1
  std::vector<int> subdomains;

  Span<const int> of(int node) const { return {subdomains.data() + offsets[node], std::size_t(offsets[node + 1] - offsets[node])}; }
};

/// Local.
NodeSubdomains nodeSubdomains(const CellBlock& block, const std::vector<int>& subdomainOfElement);

}  // namespace suture
