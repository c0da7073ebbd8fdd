#include <suture/algebra/CostModel.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// Factor entries that a solve passes twice, per second: columns in 2D, dense blocks of factors in 3D.
constexpr double kSolveRate = 1.05e8, kSolveRateInSpace = 4e8;
constexpr double kProductRate = 8e9;      // bytes per second
constexpr double kEliminationRate = 5e9;  // operations per second
constexpr double kPackedBytes = 4.4;      // bytes of a packed matrix over the square of its size

}  // namespace

double CostModel::factorEntries(double unknowns) const {
  const double n = std::max(2.0, unknowns);
  return dimension_ == 2 ? 4.5 * n * std::log2(n) : 15.5 * std::pow(n, 4.0 / 3.0);
}

double CostModel::factorFlops(double unknowns) const {
  const double n = std::max(2.0, unknowns);
  return dimension_ == 2 ? 55.0 * std::pow(n, 1.5) : 17.5 * n * n;
}

double CostModel::solveSeconds(double unknowns) const {
  return factorEntries(unknowns) / (dimension_ == 2 ? kSolveRate : kSolveRateInSpace);
}

double CostModel::denseSeconds(double boundary) const { return 2.0 / 3.0 * boundary * boundary * boundary / kEliminationRate; }

double CostModel::denseBytes(double boundary) const { return kPackedBytes * boundary * boundary; }

double CostModel::productSeconds(double boundary) const { return denseBytes(boundary) / kProductRate; }

}  // namespace suture
