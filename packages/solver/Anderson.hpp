#pragma once
#include <suture/interface/InterfaceOperator.hpp>

#include <deque>

namespace suture {

/// Anderson acceleration of a fixed-point iteration U <- U + f(U), f = S^-1 r: the step that makes the combined correction smallest in the
/// S norm, whose inner products are products of corrections with residuals, so that S is never applied. Collective.
class Anderson {
 public:
  explicit Anderson(int depth) : depth_(depth) {}

  /// Step to add to U, or null when there is no history yet. Remembers U, f and r.
  MultiVectorPtr accelerate(const MultiVector& u, const MultiVector& correction, const MultiVector& residual);
  /// Forgets the history before the point last given.
  void restart();

 private:
  struct Entry {
    MultiVectorPtr u, correction, residual;
  };
  int depth_;
  std::deque<Entry> history_;
};

}  // namespace suture
