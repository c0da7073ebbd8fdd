#pragma once
#include <suture/elasticity/ElasticModel.hpp>

#include <functional>

namespace suture {

/// Sums over the elements at each node of a block, for given displacements.
struct ElementForces {
  Vector internal;   ///< K u: nodes x dimension, node-major, Cartesian [force]
  Vector rounding;   ///< bound for the effect of round-off of u on K u at each node, eps |K| |u| [force]
  Vector stiffness;  ///< force of each node for a unit displacement of this node alone, of the order of its diagonal entry [force / length]
};

/// Internal forces from stresses at quadrature points: the same integrals as elementStiffnesses(), without any matrix. Along directions in
/// which translations need no energy, displacements enter as differences within an element, so only the round-off of these differences is
/// left.
/// Includes the forces of the coatings. Local. \param displacement  node-major, Cartesian. \throws InputError  if an element is folded
ElementForces elementForces(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                            const Vector& displacement);

}  // namespace suture
