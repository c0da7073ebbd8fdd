#pragma once
#include <suture/mesh/CellBlock.hpp>

#include <vector>

namespace suture {

/// Sides of a valid mesh that belong to one element only, in ascending order of elements. One pass over all elements without a table: at
/// interior nodes, the signed sums over adjacent sides cancel. Local.
std::vector<Side> outline(const CellBlock& block);

}  // namespace suture
