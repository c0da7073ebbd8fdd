#pragma once
#include <suture/base/scene/Schema.hpp>

namespace suture {

/// The whole scene file: what its reader accepts, suture_schema prints and --print-defaults fills in; composed of the packages' schemas,
/// the strategies of plugins included that were loaded before. Local.
Schema sceneSchema();

}  // namespace suture
