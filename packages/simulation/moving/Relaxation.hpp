#pragma once
#include <suture/base/Types.hpp>

namespace suture {

/// Relaxation factor of a fixed-point iteration: x <- x + factor (G(x) - x). It is 1 as long as the iteration contracts quickly. If the
/// iteration oscillates, for example where a corner passes the end of the other side, the factor follows from the last two changes by
/// Aitken's method for vectors. Source: U. Kuettler, W. A. Wall, Computational Mechanics 43 (2008) 61. Local.
class Relaxation {
 public:
  /// Factor of the next step, in (0, 1]. \param change  G(x) - x
  double factorAfter(const Vector& change);

 private:
  Vector last_;
  double factor_ = 1.0;
  int slow_ = 0;  // successive steps that did not contract quickly
};

}  // namespace suture
