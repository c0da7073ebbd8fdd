#pragma once
#include <suture/base/Types.hpp>

#include <functional>
#include <vector>

namespace suture {

/// True if the shape functions of a side represent a function, that is if the interpolation of its nodal values equals it between the
/// nodes, up to round-off. Local. \param points  of the side's nodes, in the order of SideGeometry.hpp \throws what `value` throws
bool isInterpolated(const std::vector<Point>& points, int dimension, const std::function<double(const Point&)>& value);

}  // namespace suture
