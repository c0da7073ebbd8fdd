#pragma once
#include <suture/base/Types.hpp>
#include <suture/mesh/Mesh.hpp>

#include <vector>

namespace suture {

/// Numbers elements along a Hilbert curve through their centres, and nodes in the order in which these elements meet them: entities that
/// are close in the mesh are close in memory. Groups, bodies and regions keep their members. Local (rank 0).
///
/// Sources: D. Hilbert, Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck, Math. Ann. 38 (1891) 459-460; J. Skilling,
/// Programming the Hilbert curve, AIP Conf. Proc. 707 (2004) 381-387.
void numberAlongHilbertCurve(Mesh& mesh);

/// Order of points along one continuous curve through their bounding box: element k of the result is the number of the k-th point. Runs of
/// consecutive points are compact whatever the shape of the box is: the box is divided along its longest axis into cubes (squares), each of
/// them is traversed by a Hilbert curve, and each curve begins where the last one ends. Axes along which the points extend less than a
/// third of the second longest extent are ignored, except between points at the same place. Points at the same place keep their order;
/// round-off of the coordinates does not change the order of points on a regular grid. Local.
/// \param dimension  2: the third coordinate is ignored
std::vector<int> orderAlongHilbertCurve(const std::vector<Point>& points, int dimension);

}  // namespace suture
