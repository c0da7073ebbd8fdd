#pragma once
#include <vector>

#include "Bands.hpp"

namespace suture::study {

/// Fits the order for every line of every entry of Orders: the least-squares slope of log y over log x over its runs, or over those with
/// the smallest x. A run that counts but has no positive values violates the order. Local.
std::vector<Verdict> judgeOrders(const Study& study, const std::vector<Row>& rows);

}  // namespace suture::study
