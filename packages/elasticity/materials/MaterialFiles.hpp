#pragma once
#include <suture/base/scene/SceneCompletion.hpp>
#include <suture/base/scene/Schema.hpp>

#include <memory>
#include <string>

namespace suture {

/// Materials that a scene names but does not define: they come from its `Material Files`, then from the built-in file, in this order; an
/// entry of the scene wins. Completes the scene's list `Materials` by their entries in the scene's units, with `Source`; also entries
/// `Based On` a material, and entries of which only --set gives values. Unknown names are errors with the nearest name.
std::shared_ptr<const SceneCompletion> materialFiles();

/// Adds the parameter `Material Files` to the schema of a scene.
void addMaterialFilesParameter(Schema& scene);

/// Schema of a material file: `Units`, and a list per material as in a scene. Whole files are checked by the tests; of a scene's own files
/// every entry is checked when the scene is read.
Schema materialFileSchema();

/// Path of the built-in material file, share/suture/materials.xml next to the library's folder; the file may be missing. Local.
std::string builtInMaterialFile();

/// Names of the built-in materials in the order of the file, known without reading it. Local.
const std::vector<std::string>& builtInMaterials();

}  // namespace suture
