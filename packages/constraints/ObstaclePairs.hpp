#pragma once
#include <suture/constraints/ContactLine.hpp>
#include <suture/constraints/ContactPairs.hpp>

namespace suture {

/// Pairs of a line whose partner is a rigid obstacle: one for each node of side A, with the obstacle's normal and distance there. Local.
/// \param problems  gets nodes where the obstacle is not in front of the side
PairedLine obstacleLine(const Mesh& mesh, const ContactLine& line, Problems& problems);

}  // namespace suture
