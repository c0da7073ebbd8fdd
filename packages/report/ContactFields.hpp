#pragma once
#include <suture/report/Run.hpp>

#include <string>

namespace suture {

/// The contact lines as a VTKHDF grid of line cells: nodes of side A, undeformed, in the order of the pairs; a cell joins two successive
/// pairs of the same line and piece. Point data: Gap, InitialGap, ContactPressure, ContactForce, Active, ArcLength, Displacement (of A),
/// Normal (A to B), Pair, Line, Piece; `unit` and `meaning` as in Fields.hpp. /Record with the names of the pieces. Collective.
/// \throws EnvironmentError
void writeContactFields(const Run& run, const std::string& path);

}  // namespace suture
