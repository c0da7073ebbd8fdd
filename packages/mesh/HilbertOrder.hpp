#pragma once
#include <suture/mesh/Mesh.hpp>

namespace suture {

/// Numbers elements along a Hilbert curve through their centres, and nodes in the order in which these elements meet them: what is near in
/// the plane is near in memory. Groups, bodies and regions keep their members. Local (rank 0).
///
/// Source: D. Hilbert, Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck, Math. Ann. 38 (1891) 459-460.
void numberAlongHilbertCurve(Mesh& mesh);

}  // namespace suture
