#pragma once
#include <suture/quality/PairResult.hpp>

#include <vector>

namespace suture {

/// Amplitude by which nodal pressures alternate from pair to pair, the largest of each piece. The second difference at a closed pair with
/// closed ones on all sides is d_j = 2 (mean of the pressures beside it - p_j). Four neighbouring pairs or more with d of alternating
/// signs, of at least |d|, give |d| / 4: p_j = mean + (-1)^j a gives a. A smooth pressure has none, nor has one that peaks or jumps at a
/// pair. Local.
/// \param pairs   of all pieces, by id, with pressures in [stress]
/// \returns one amplitude a piece [stress]
std::vector<double> pressureOscillations(const std::vector<PairResult>& pairs, const std::vector<ContactPiece>& pieces);

}  // namespace suture
