#pragma once
#include <vector>

#include "StudyBands.hpp"

namespace suture {

/// Fits the order of every line of every entry of Orders: the slope of log y over log x by least squares over its runs, or the last few of
/// them in the order of x. A run that counts but has no positive values misses it. Local.
std::vector<StudyVerdict> judgeOrders(const Study& study, const std::vector<StudyRow>& rows);

}  // namespace suture
