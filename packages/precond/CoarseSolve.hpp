#pragma once
#include <suture/base/Types.hpp>
#include <suture/interface/InterfaceLayout.hpp>

#include <vector>

namespace suture {

/// What a preconditioner does with its coarse residual: a fixed symmetric positive definite linear operator, the inverse of the coarse
/// matrix or near to it.
class CoarseSolve {
 public:
  virtual ~CoarseSolve() = default;
  /// Number of coarse unknowns, the same on all ranks.
  virtual int size() const = 0;
  /// Answer to the sum over ranks of `mine`, on all ranks; it is kept until the next call. Collective.
  virtual const Vector& solve(const Vector& mine) const = 0;
  /// Local problems that the coarse unknowns are shared by on the next level; 0 where they are solved exactly.
  virtual int clusters() const { return 0; }
};

/// The term of the coarse matrix that comes from one local problem. Local.
struct CoarseElement {
  int id;                     ///< of the local problem
  std::vector<int> unknowns;  ///< coarse unknowns, ascending
  Matrix matrix;              ///< between them; symmetric, positive semidefinite
};

/// What one rank knows of a coarse matrix: the sum of elements over all ranks.
struct CoarseElements {
  int size = 0;                                    ///< coarse unknowns, over all ranks
  std::vector<CoarseElement> elements;             ///< of this rank's local problems
  std::vector<InterfaceLayout::Unknown> unknowns;  ///< all that `elements` name, once; `id` is the number of the coarse unknown
};

}  // namespace suture
