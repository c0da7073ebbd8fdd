#pragma once
#include <suture/quality/PairResult.hpp>

#include <vector>

namespace suture {

/// Of each piece: how far nodal pressures alternate from pair to pair about what a finer mesh would give [stress]. Over four neighbouring
/// closed pairs (and the closed ones beside them) whose second differences d_j = p_(j-1) - 2 p_j + p_(j+1) change their sign each time, it
/// is the smallest |d_j| / 4: of p_j = mean + (-1)^j a this is a. A smooth pressure has none, nor has one that peaks or jumps at a pair.
/// \param pairs  of all pieces, as in Solution;  \param pieces  their number. Local
std::vector<double> pressureOscillations(const std::vector<PairResult>& pairs, int pieces);

}  // namespace suture
