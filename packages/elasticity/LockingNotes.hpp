#pragma once
#include <suture/elasticity/ElasticModel.hpp>

namespace suture {

/// Warnings on materials above kLockingPoisson with displacement elements, which occur only if the scene requests them (Element =
/// Displacement, Allow Locking): one sentence per material. None in plane stress. Local.
std::vector<std::string> lockingNotes(const ElasticModel& model);

}  // namespace suture
