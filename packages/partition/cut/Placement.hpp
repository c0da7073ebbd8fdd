#pragma once
#include <vector>

namespace suture {

/// Places units of given weights on ranks. In their order, so that neighbours in number share a rank, where that balances: the largest load
/// is at most 1.01 times that of the other way, which takes the heaviest first and gives each to the rank that has least so far (the lower
/// number at a tie). Ranks may stay empty. Returns unit -> rank. Deterministic. Local.
std::vector<int> placeOnRanks(const std::vector<long long>& weights, int ranks);

}  // namespace suture
