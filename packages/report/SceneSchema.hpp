#pragma once
#include <suture/base/scene/Schema.hpp>

namespace suture {

/// Schema of the whole scene file, for the reader, suture_schema and --print-defaults. Composed of the packages' schemas,
/// including the strategies of plugins loaded before. Local.
Schema sceneSchema();

/// Schema of the settings of a scene created in C++: as sceneSchema(), but without required entries for the scene itself. Local.
Schema settingsSchema();

}  // namespace suture
