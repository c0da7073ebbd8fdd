#pragma once
#include <vector>

namespace suture {

/// Shares `total` seats among parties in proportion to their sizes: at least one each, at most its size, largest remainders first (the
/// lower number at a tie), in sum exactly `total`. Needs sizes >= 1 and parties <= total <= sum of sizes. Local.
std::vector<int> apportion(const std::vector<int>& sizes, int total);

}  // namespace suture
