#pragma once
#include <suture/report/Run.hpp>

#include <string>

namespace suture {

/// The contact surfaces as a VTKHDF grid: points are the undeformed nodes that carry pairs, in the order of the pairs; cells are lines in
/// 2D, triangles and quadrilaterals in 3D (ContactPiece::cells). Point data: Gap, InitialGap, ContactPressure, ContactForce,
/// Active, ArcLength, Displacement (of the carrying node), Normal (A to B), Pair, Line, Piece; with friction TangentialTraction,
/// FrictionBound, Slip, Stick, DissipatedWork; `unit` and `meaning` as in Fields.hpp.
/// /Record with the names of the pieces. Collective.
/// \throws EnvironmentError
void writeContactFields(const Run& run, const std::string& path);

}  // namespace suture
