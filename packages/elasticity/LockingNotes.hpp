#pragma once
#include <suture/elasticity/ElasticModel.hpp>

namespace suture {

/// Warnings on materials above kLockingPoisson with displacement elements, which are there by the scene's word only (Element =
/// Displacement, Allow Locking): one sentence a material. None in plane stress. Local.
std::vector<std::string> lockingNotes(const ElasticModel& model);

}  // namespace suture
