#pragma once
#include <support/Blocks.hpp>
#include <suture/precond/coarse/CoarseElement.hpp>

#include <set>

namespace suture::blocks {

/// A body's stiffness used as a coarse matrix, with its subdomains' matrices as elements: the inverse of the coarse solves is then known
/// independently (Dense).
CoarseElements coarseElementsOf(const Blocks& all, const Dense& whole);

/// Conversion between a vector of all coarse unknowns and its parts on the ranks, in the order of namesIn(). Collective.
struct CoarseParts {
  CommPtr comm;
  std::vector<int> names;
  int size;

  /// Parts that add up to it.
  Vector partOf(const Vector& all) const;
  /// The sum of parts.
  Vector sum(const Vector& mine) const;
  /// Values known on all ranks, from one of them.
  Vector joined(const Vector& mine) const;
};

}  // namespace suture::blocks
