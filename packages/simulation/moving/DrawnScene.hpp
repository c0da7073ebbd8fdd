#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Mesh.hpp>

namespace suture {

/// A scene whose bodies move far, as drawn.
struct DrawnScene {
  Mesh mesh;                ///< on rank 0
  Constraints constraints;  ///< likewise
  ElasticModel model;       ///< with loads that have no place on the mesh yet
};

}  // namespace suture
