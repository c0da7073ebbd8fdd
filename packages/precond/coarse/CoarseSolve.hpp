#pragma once
#include <suture/base/Types.hpp>

#include <string>

namespace suture {

/// Coarse solver of a preconditioner: a fixed symmetric positive definite linear operator, the exact or approximate inverse of the coarse
/// matrix.
class CoarseSolve {
 public:
  virtual ~CoarseSolve() = default;
  /// Number of coarse unknowns over all ranks.
  virtual int size() const = 0;
  /// Solution for the sum of `mine` over the ranks, valid until the next call. Both vectors hold the unknowns of this rank's elements, in
  /// the order of namesIn(). Collective.
  virtual const Vector& solve(const Vector& mine) const = 0;
  /// Number of local problems on the next level; 0 if the coarse problem is solved exactly.
  virtual int clusters() const { return 0; }
  /// A sentence for the user if a level is less accurate than requested, otherwise "". The same on all ranks.
  virtual std::string remark() const { return std::string(); }
};

}  // namespace suture
