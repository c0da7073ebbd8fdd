#pragma once
#include <suture/base/Types.hpp>

namespace suture {

/// Solve of a preconditioner's coarse problem: a fixed symmetric positive definite linear operator, the inverse of the coarse
/// matrix or near to it.
class CoarseSolve {
 public:
  virtual ~CoarseSolve() = default;
  /// Number of coarse unknowns over all ranks.
  virtual int size() const = 0;
  /// Answer to the sum over ranks of `mine`; it is kept until the next call. Both at the unknowns that this rank's elements name, in the
  /// order of namesIn(). Collective.
  virtual const Vector& solve(const Vector& mine) const = 0;
  /// Local problems that the coarse unknowns are shared by on the next level; 0 where they are solved exactly.
  virtual int clusters() const { return 0; }
};

}  // namespace suture
