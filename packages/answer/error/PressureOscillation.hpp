#pragma once
#include <suture/answer/PairResult.hpp>

#include <vector>

namespace suture {

/// Largest amplitude, per piece, by which nodal pressures alternate from pair to pair. The second difference at a closed pair with closed
/// neighbours on all sides is d_j = 2 (mean of the neighbours' pressures - p_j). Four or more neighbouring pairs with d of alternating
/// signs and at least |d| give the amplitude |d| / 4: p_j = mean + (-1)^j a gives a. Zero for a smooth pressure and for one that peaks or
/// jumps at a pair. Local.
/// \param pairs   of all pieces, by id, with pressures in [stress]
/// \returns one amplitude per piece [stress]
std::vector<double> pressureOscillations(const std::vector<PairResult>& pairs, const std::vector<ContactPiece>& pieces);

}  // namespace suture
