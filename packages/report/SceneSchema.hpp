#pragma once
#include <suture/base/scene/Schema.hpp>

namespace suture {

/// Schema of the whole scene file, for the reader, suture_schema and --print-defaults; composed of the packages' schemas,
/// the strategies of plugins included that were loaded before. Local.
Schema sceneSchema();

/// Schema of the settings of a scene that is made in C++: as sceneSchema(), but nothing of the scene itself is demanded. Local.
Schema settingsSchema();

}  // namespace suture
