#pragma once
#include <vector>

namespace suture {

/// Places units on ranks in runs of consecutive units: rank 0 gets the first ones. The largest load is the least possible for runs, at most
/// the mean plus one unit; within this limit each rank gets its share of what is left. No rank is empty if there are enough units; if
/// there are not, the last ranks are empty. Returns unit -> rank, ascending. Local.
/// \param weights  of the units, not negative
std::vector<int> placeInRuns(const std::vector<long long>& weights, int ranks);

/// Places units of given weights on ranks. Placement in order, which keeps neighbours in number on one rank, is used if its largest load is
/// at most 1.01 times that of the alternative: heaviest unit first, each on the rank with the least load so far (the lower number at a
/// tie). Ranks may stay empty. Returns unit -> rank. Deterministic. Local.
std::vector<int> placeOnRanks(const std::vector<long long>& weights, int ranks);

}  // namespace suture
