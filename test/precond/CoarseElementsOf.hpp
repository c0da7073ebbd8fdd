#pragma once
#include <support/Blocks.hpp>
#include <suture/precond/coarse/CoarseElement.hpp>

#include <set>

namespace suture::blocks {

/// A body's stiffness as if it were a coarse matrix, its subdomains' matrices the elements: what the coarse solves have to invert is then
/// known from elsewhere (Dense).
CoarseElements coarseElementsOf(const Blocks& all, const Dense& whole);

/// A vector of all coarse unknowns against its parts on the ranks, in the order of namesIn(). Collective.
struct CoarseParts {
  CommPtr comm;
  std::vector<int> names;
  int size;

  /// Parts that add up to it.
  Vector partOf(const Vector& all) const;
  /// The sum of parts.
  Vector sum(const Vector& mine) const;
  /// Values that all ranks know alike, from one of them.
  Vector joined(const Vector& mine) const;
};

}  // namespace suture::blocks
