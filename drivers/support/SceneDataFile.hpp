#pragma once
#include <suture/simulation/Stages.hpp>

#include "SolveOptions.hpp"

namespace suture {

/// --scene-data: reads the mesh of a scene, checks the names that the scene uses, and writes both as the data of a drawing. Contacts need
/// not be valid: a drawing shows why they are not. Collective. \throws InputError  EnvironmentError
RunResult writeSceneDataFile(const Comm& comm, const Scene& scene, const SolveOptions& options);

}  // namespace suture
