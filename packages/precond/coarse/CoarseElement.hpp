#pragma once
#include <suture/algebra/SparseMatrix.hpp>
#include <suture/base/Types.hpp>
#include <suture/interface/InterfaceLayout.hpp>

#include <vector>

namespace suture {

class Packer;
class Unpacker;

/// Element matrix of one local problem in the coarse matrix. Local.
struct CoarseElement {
  int id;                     ///< id of the local problem
  std::vector<int> unknowns;  ///< coarse unknowns, ascending
  Matrix matrix;              ///< symmetric positive semidefinite; only the lower triangle is used
};

/// Contribution of one rank to a coarse matrix, the sum of elements over all ranks.
struct CoarseElements {
  int dimension = 2;
  int size = 0;                                    ///< coarse unknowns, over all ranks
  std::vector<CoarseElement> elements;             ///< elements of this rank's local problems
  std::vector<InterfaceLayout::Unknown> unknowns;  ///< with their motions, for a further level; each at least once over all ranks
};

/// Sorted unique coarse unknowns of the elements: the order of a rank's values in CoarseSolve::solve. Local.
std::vector<int> namesIn(const std::vector<CoarseElement>& elements);
/// Positions of `numbers` in `names`, which must contain all of them. Local.
std::vector<int> placesAmong(const std::vector<int>& names, const std::vector<int>& numbers);

/// Serialisation for messages.
void pack(const CoarseElement& element, Packer& packer);
CoarseElement unpackCoarseElement(Unpacker& unpacker);

/// Coarse elements of all ranks, sorted by id, so that sums do not depend on the distribution: on every rank, or on rank 0 only (empty
/// elsewhere). Collective.
std::vector<CoarseElement> gatherCoarseElements(const Comm& comm, std::vector<CoarseElement> mine, bool everywhere);

/// Sum of the elements, both triangles; `size` is the number of unknowns. Unknowns need not be ascending within an element. Local.
SparseMatrix assembleCoarseElements(int size, const std::vector<CoarseElement>& elements);

}  // namespace suture
