#pragma once
#include <suture/mesh/CellBlock.hpp>

#include <vector>

namespace suture {

/// Stiffness of springs on a side, for the displacements of its nodes (node-major, Cartesian): the integral of
/// N_a N_b (normal n n^T + tangential (1 - n n^T)), N the shape functions of the side, n its normal at each point. Per unit thickness in
/// 2D, for the whole circle in axisymmetric blocks; zero for a side on the axis. [force / length] Local. \param points  nodes of the side,
/// vertices first  \param block  gives the dimension, and whether it is axisymmetric \param normal, tangential  stiffness per area [stress
/// / length]
Matrix sideSprings(const std::vector<Point>& points, const CellBlock& block, double normal, double tangential);

}  // namespace suture
