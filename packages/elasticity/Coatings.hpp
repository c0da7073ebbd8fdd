#pragma once
#include <suture/elasticity/ElementForces.hpp>

#include <functional>

namespace suture {

/// Stiffness of a coating in Cartesian components, node-major, the inner nodes first: integral over its side of the products of jumps,
/// outer minus inner, with normal n n^T + tangential (1 - n n^T), n the outward normal at each point; per unit thickness in 2D, of the
/// whole circle in axisymmetric blocks. Exact energies: no thickness, no stiffness along the side. Local.
Matrix coatingStiffness(const CellBlock& block, const Coating& coating);

/// Calls take(elements + i, K) for every coating i of a block: their matrices, numbered after those of the elements (CoatedBlock). Local.
void coatingStiffnesses(const CellBlock& block, const std::function<void(int element, ConstLocalView stiffness)>& take);

/// Adds the forces of the coatings to those of the elements. Local. \param displacement  node-major, Cartesian
void addCoatingForces(const CellBlock& block, const Vector& displacement, ElementForces& forces);

}  // namespace suture
