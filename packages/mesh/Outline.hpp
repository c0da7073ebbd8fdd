#pragma once
#include <suture/mesh/CellBlock.hpp>

#include <vector>

namespace suture {

/// Sides of a sound mesh that belong to one element only, in ascending order of elements. One pass over all elements without a table: at
/// nodes inside, the signed sums over the sides that meet there cancel. Local.
std::vector<Side> outline(const CellBlock& block);

}  // namespace suture
