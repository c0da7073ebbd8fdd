#pragma once
#include <suture/mesh/ShapeFunctions.hpp>

#include <array>

namespace suture {

/// Values of shape functions at a point of a side.
using ShapeValues = std::array<double, kMostSideNodes>;

/// Shape functions of a side with this number of nodes. Local.
ShapeValues sideValues(int nodes, int dimension, const ReferencePoint& at);

/// Multiplier functions of a side with this number of functions: its shape functions; for six and eight nodes in 3D, whose vertex functions
/// have zero and negative integrals, combinations with positive integrals: phi_c + alpha sum of the adjacent phi_m, (1 - 2 alpha) phi_m,
/// alpha = 1/5 (Popp, Wohlmuth, Gee and Wall 2012). Local.
ShapeValues multiplierValues(int functions, int dimension, const ReferencePoint& at);

}  // namespace suture
