#pragma once
#include <vector>

namespace suture {

/// Distributes `total` seats among parties in proportion to their sizes: at least one each, at most the size each, largest remainders first
/// (the lower number at a tie), in total exactly `total`. Needs sizes >= 1 and parties <= total <= sum of sizes. Local.
std::vector<int> apportion(const std::vector<int>& sizes, int total);

}  // namespace suture
