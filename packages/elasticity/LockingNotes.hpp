#pragma once
#include <suture/elasticity/ElasticModel.hpp>

namespace suture {

/// What a user should know of materials above kLockingPoisson with Element = Displacement: one sentence a material. None in plane stress,
/// nor where `Allow Locking` says that it is known. (3-node triangles are refused, see checkElements().) Local.
std::vector<std::string> lockingNotes(const ElasticModel& model);

}  // namespace suture
