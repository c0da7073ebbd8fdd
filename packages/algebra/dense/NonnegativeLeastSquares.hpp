#pragma once
#include <suture/base/Types.hpp>

namespace suture {

/// p >= 0 that minimises |a p - b| (Lawson and Hanson). a: few rows, any number of columns. Local.
Vector nonnegativeLeastSquares(const Matrix& a, const Vector& b);

/// The x of least norm with a x >= b (Lawson and Hanson's LDP, by nonnegative least squares); zero if there is none. Local.
Vector leastDistance(const Matrix& a, const Vector& b);

}  // namespace suture
