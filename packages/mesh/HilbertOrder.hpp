#pragma once
#include <suture/mesh/Mesh.hpp>

namespace suture {

/// Numbers elements along a Hilbert curve through their centres, and nodes in the order in which these elements meet them: entities that
/// are close in the mesh are close in memory. Groups, bodies and regions keep their members. Local (rank 0).
///
/// Sources: D. Hilbert, Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck, Math. Ann. 38 (1891) 459-460; J. Skilling,
/// Programming the Hilbert curve, AIP Conf. Proc. 707 (2004) 381-387.
void numberAlongHilbertCurve(Mesh& mesh);

}  // namespace suture
