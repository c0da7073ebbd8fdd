#pragma once
#include <suture/answer/PairResult.hpp>

#include <vector>

namespace suture {

/// Length of the next load step in which `most` pairs open, close or begin to slip, if the forces and gaps of all pairs continue to change
/// as in the last step. Exact up to the first change, where the loads change linearly. Infinite: fewer pairs change. Local, on rank 0.
/// \param before, now  pairs at both ends of the last step
/// \param length       length of the last step
/// \param most         at least one
double predictedLength(const std::vector<PairResult>& before, const std::vector<PairResult>& now, double length, int most);

}  // namespace suture
