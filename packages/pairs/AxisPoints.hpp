#pragma once
#include <suture/pairs/ContactPairs.hpp>

namespace suture {

/// Leaves out the pairs of an axisymmetric contact that have no tributary area and turns them into axis points. The end of a second-order
/// side on the axis is such a pair: the integral of its shape function over the circle is zero, or nearly zero if the side is curved. A
/// pressure there exerts no force, so no force decides whether the pair is closed. Local.
PairedSurface withoutWeightless(const PairedSurface& all);

}  // namespace suture
