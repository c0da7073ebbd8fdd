#pragma once
#include <vector>

namespace suture {

/// Places units of given weights on ranks. Placement in order, which keeps neighbours in number on one rank, is used if its largest load is
/// at most 1.01 times that of the alternative: heaviest unit first, each on the rank with the least load so far (the lower number at a
/// tie). Ranks may stay empty. Returns unit -> rank. Deterministic. Local.
std::vector<int> placeOnRanks(const std::vector<long long>& weights, int ranks);

}  // namespace suture
