#pragma once
#include <cmath>
#include <string>

namespace suture {

/// Monitors the pivots of a Cholesky factorisation: a singular matrix gives round-off of either sign instead of a zero pivot, and the
/// factorisation itself stops only for a negative sign. Local.
class PivotCheck {
 public:
  /// \param size      unknowns of the matrix
  /// \param trailing  number of unknowns ordered last, for messages
  PivotCheck(int size, int trailing) : size_(size), trailing_(trailing) {}

  /// \param pivot  l_jj^2
  void see(int unknown, double pivot, double diagonal) {
    const double ratio = pivot / diagonal;
    if (ratio >= smallest_ || std::isnan(smallest_)) return;  // a NaN is kept
    smallest_ = ratio;
    unknown_ = unknown;
  }
  /// Smallest ratio of pivot to diagonal entry, and its unknown.
  double smallest() const { return smallest_; }
  int unknown() const { return unknown_; }

  /// \throws NumericalError  if the smallest pivot is only round-off
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
