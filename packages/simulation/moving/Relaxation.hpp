#pragma once
#include <suture/base/Types.hpp>

namespace suture {

/// Length of the next step of a fixed-point iteration x <- G(x), as a part of G(x) - x: 1 as long as it contracts quickly. Where it
/// oscillates about its end, as where a corner passes the end of the other side, the step is shorter, by Aitken's method for vectors:
/// between the last two steps the iteration is as on a line. Source: U. Kuettler, W. A. Wall, Computational Mechanics 43 (2008) 61. Local.
class Relaxation {
 public:
  /// \param change  G(x) - x
  double factorAfter(const Vector& change);

 private:
  Vector last_;
  double factor_ = 1.0;
  int slow_ = 0;  // successive steps that did not contract quickly
};

}  // namespace suture
