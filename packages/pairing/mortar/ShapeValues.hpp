#pragma once
#include <suture/mesh/ShapeFunctions.hpp>

#include <array>

namespace suture {

/// Values of shape functions at a place on a side.
using ShapeValues = std::array<double, 9>;

/// Shape functions of a side of so many nodes. Local.
ShapeValues sideValues(int nodes, int dimension, const ReferencePoint& at);

/// Functions of the multiplier where a side has so many: its shape functions; of six and eight nodes in space, whose integrals at the
/// vertices are zero and negative, combinations with positive ones: phi_c + alpha sum of phi_m beside it, (1 - 2 alpha) phi_m, alpha = 1/5
/// (Popp, Wohlmuth, Gee and Wall 2012). Local.
ShapeValues multiplierValues(int functions, int dimension, const ReferencePoint& at);

}  // namespace suture
