#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Mesh.hpp>

namespace suture {

/// Nodal forces of all loads: nodes x dimension, node-major, Cartesian [force]. Local.
Vector nodalLoads(const Mesh& mesh, const ElasticModel& model);

}  // namespace suture
