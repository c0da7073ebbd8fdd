#pragma once
#include <suture/base/scene/SceneReader.hpp>
#include <suture/base/scene/Schema.hpp>

#include <string>

namespace suture {

/// The scene's list `Output`.
Schema outputSchema();

/// Output folder of a run: `Output/Folder`, or the name of the scene file with "_out" in the current folder. Local.
std::string outputFolder(const SceneFile& scene);

}  // namespace suture
