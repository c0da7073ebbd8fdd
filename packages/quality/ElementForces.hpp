#pragma once
#include <suture/elasticity/ElasticModel.hpp>

#include <functional>

namespace suture {

/// Sums over the elements at each node of a block, of given displacements.
struct ElementForces {
  Vector internal;   ///< K u: nodes x dimension, node-major, Cartesian [force]
  Vector rounding;   ///< effect at each node that rounding u to double precision may have on K u, eps |K| |u| [force]
  Vector stiffness;  ///< force of each node when it alone moves by one, the order of its diagonal entry [force / length]
};

/// Internal forces from stresses at quadrature points: the same integrals as elementStiffnesses(), without any matrix.
/// Displacements enter as differences within an element wherever a translation costs nothing: only their own rounding is left.
/// Local. \param displacement  node-major, Cartesian. \throws InputError  an element is folded
ElementForces elementForces(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                            const Vector& displacement);

}  // namespace suture
