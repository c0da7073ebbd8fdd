#pragma once
#include <suture/base/Types.hpp>

#include <optional>

namespace suture {

/// z >= 0 with w = m z + q >= 0 and z.w = 0, by Lemke's complementary pivots (Lemke 1965; Cottle, Pang and Stone 1992, algorithm 4.4.1).
/// Finds a solution if m is copositive and q.z >= 0 for all z >= 0 with m z >= 0 and z.m z = 0. Always terminates: degenerate steps do not
/// cycle. Entries of m and q should be of similar size. Local; the same arguments give the same result on all ranks.
/// \param m  square;  \param q  of the same size  \return empty: the pivots ended on a ray or at round-off
std::optional<Vector> linearComplementarity(const Matrix& m, const Vector& q);

}  // namespace suture
