#pragma once
#include <support/Blocks.hpp>
#include <suture/precond/coarse/CoarseElement.hpp>

#include <set>

namespace suture::blocks {

/// A body's stiffness as if it were a coarse matrix, its subdomains' matrices the elements: what the coarse solves have to invert is then
/// known from elsewhere (Dense).
CoarseElements coarseElementsOf(const Blocks& all, const Dense& whole);

}  // namespace suture::blocks
