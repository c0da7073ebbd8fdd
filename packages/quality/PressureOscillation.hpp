#pragma once
#include <suture/quality/PairResult.hpp>

#include <vector>

namespace suture {

/// Amplitude by which nodal pressures alternate from pair to pair, the largest of each piece. Four neighbouring closed pairs (with closed
/// ones beside them) whose second differences d_j = p_(j-1) - 2 p_j + p_(j+1) change their sign each time give the smallest |d_j| / 4:
/// p_j = mean + (-1)^j a gives a. A smooth pressure has none, nor has one that peaks or jumps at a pair. Local.
/// \param pairs   of all pieces, as in Solution, with pressures in [stress]
/// \param pieces  their number
/// \returns one amplitude a piece [stress]
std::vector<double> pressureOscillations(const std::vector<PairResult>& pairs, int pieces);

}  // namespace suture
