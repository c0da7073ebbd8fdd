#pragma once
#include <vector>

#include "Bands.hpp"

namespace suture::study {

/// Fits the order of every line of every entry of Orders: the slope of log y over log x by least squares over its runs, or the last few of
/// them in the order of x. A run that counts but has no positive values misses it. Local.
std::vector<Verdict> judgeOrders(const Study& study, const std::vector<Row>& rows);

}  // namespace suture::study
