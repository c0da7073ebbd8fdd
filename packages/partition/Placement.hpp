#pragma once
#include <vector>

namespace suture {

/// Places units of given weights on ranks: the heaviest first, each on the rank that has least so far (the lower number at a tie). Ranks
/// may stay empty. Returns unit -> rank. Deterministic. Local.
std::vector<int> placeOnRanks(const std::vector<long long>& weights, int ranks);

}  // namespace suture
