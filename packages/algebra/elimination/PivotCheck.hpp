#pragma once
#include <cmath>
#include <string>

namespace suture {

/// Watches the pivots of a Cholesky factorisation: a singular matrix leaves rounding instead of a zero, of either sign, and a factorisation
/// stops at the negative half only. Local.
class PivotCheck {
 public:
  /// \param size      unknowns of the matrix
  /// \param trailing  number of those that are ordered last, for messages
  PivotCheck(int size, int trailing) : size_(size), trailing_(trailing) {}

  /// \param pivot  l_jj^2
  void see(int unknown, double pivot, double diagonal) {
    const double ratio = pivot / diagonal;
    if (ratio >= smallest_ || std::isnan(smallest_)) return;  // a NaN is kept
    smallest_ = ratio;
    unknown_ = unknown;
  }
  /// Smallest pivot by its diagonal entry, and where.
  double smallest() const { return smallest_; }
  int unknown() const { return unknown_; }

  /// \throws NumericalError  the smallest pivot is nothing but rounding
  void judge() const;
  /// \throws NumericalError  always: a pivot that is not positive
  [[noreturn]] void notPositive(int unknown, int step) const;

 private:
  std::string brokeDown() const;

  int size_, trailing_;
  double smallest_ = 1.0;
  int unknown_ = -1;
};

}  // namespace suture
