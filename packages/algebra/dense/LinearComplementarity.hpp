#pragma once
#include <suture/base/Types.hpp>

#include <optional>

namespace suture {

/// z >= 0 with w = m z + q >= 0 and z.w = 0, by Lemke's complementary pivots (Lemke 1965; Cottle, Pang and Stone 1992, algorithm 4.4.1).
/// Finds one where m is copositive and all z >= 0 with m z >= 0 and z.m z = 0 have q.z >= 0. It always ends: steps of zero length do not
/// make it go round. Entries of m and q should be of one size. Local; the same arguments give the same answer on all ranks.
/// \param m  square;  \param q  as long  \return empty: the pivots ended on a ray, or in rounding
std::optional<Vector> linearComplementarity(const Matrix& m, const Vector& q);

}  // namespace suture
