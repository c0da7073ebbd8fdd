#pragma once
#include <suture/interface/InterfaceOperator.hpp>

#include <deque>

namespace suture {

/// Anderson acceleration of a fixed-point iteration U <- U + f(U), f = S^-1 r: the step with the smallest combined correction in the S
/// norm. Its inner products are products of corrections and residuals, so S is never applied. Collective.
class Anderson {
 public:
  explicit Anderson(int depth) : depth_(depth) {}

  /// Step to add to U, or null without history. Stores U, f and r.
  MultiVectorPtr accelerate(const MultiVector& u, const MultiVector& correction, const MultiVector& residual);
  /// Discards the history before the last point.
  void restart();

 private:
  struct Entry {
    MultiVectorPtr u, correction, residual;
  };
  int depth_;
  std::deque<Entry> history_;
};

}  // namespace suture
