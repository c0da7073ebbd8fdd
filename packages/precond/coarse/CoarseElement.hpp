#pragma once
#include <suture/algebra/SparseMatrix.hpp>
#include <suture/base/Types.hpp>
#include <suture/interface/InterfaceLayout.hpp>

#include <vector>

namespace suture {

class Packer;
class Unpacker;

/// The term of the coarse matrix that comes from one local problem. Local.
struct CoarseElement {
  int id;                     ///< id of the local problem
  std::vector<int> unknowns;  ///< coarse unknowns, ascending
  Matrix matrix;              ///< between them; symmetric, positive semidefinite: its lower triangle counts
};

/// Contribution of one rank to a coarse matrix, the sum of elements over all ranks.
struct CoarseElements {
  int dimension = 2;
  int size = 0;                                    ///< coarse unknowns, over all ranks
  std::vector<CoarseElement> elements;             ///< elements of this rank's local problems
  std::vector<InterfaceLayout::Unknown> unknowns;  ///< as they move, for a further level; each at least once over all ranks
};

/// The coarse unknowns that elements name, ascending, each once: the order of a rank's values in CoarseSolve::solve. Local.
std::vector<int> namesIn(const std::vector<CoarseElement>& elements);
/// Places of numbers among names that hold them all. Local.
std::vector<int> placesAmong(const std::vector<int>& names, const std::vector<int>& numbers);

/// Into a message, and out of it.
void pack(const CoarseElement& element, Packer& packer);
CoarseElement unpackCoarseElement(Unpacker& unpacker);

/// Coarse elements of all ranks, by id, so that sums do not depend on where elements come from: on every rank, or on rank 0 alone and
/// nothing elsewhere. Collective.
std::vector<CoarseElement> gatherCoarseElements(const Comm& comm, std::vector<CoarseElement> mine, bool everywhere);

/// Their sum, both triangles, of so many unknowns. They need not be ascending within an element. Local.
SparseMatrix assembleCoarseElements(int size, const std::vector<CoarseElement>& elements);

}  // namespace suture
