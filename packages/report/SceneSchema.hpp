#pragma once
#include <suture/base/scene/Schema.hpp>

namespace suture {

/// Schema of the whole scene file, for the reader, suture_schema and --print-defaults; composed of the packages' schemas,
/// the strategies of plugins included that were loaded before. Local.
Schema sceneSchema();

}  // namespace suture
