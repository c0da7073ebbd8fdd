#pragma once
#include <suture/pairing/ContactPairs.hpp>

namespace suture {

/// Leaves out the pairs of an axisymmetric contact that have no tributary area, and makes axis points of them. The end of a second-order
/// side on the axis is one: the integral of its shape function over the circle is zero, or nearly so if the side is curved. No pressure has
/// a force there, and no force decides whether it is closed. Local.
PairedSurface withoutWeightless(const PairedSurface& all);

}  // namespace suture
