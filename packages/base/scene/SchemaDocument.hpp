#pragma once
#include <suture/base/scene/Schema.hpp>

#include <map>
#include <string>

namespace suture {

/// Values of a scene, as in XML, by path: "Bodies/block/Material" -> "steel".
using SceneExample = std::map<std::string, std::string>;

/// The whole schema, documented. `format`: "text", "xml" (a scene with all defaults, except where the example gives values), "markdown".
/// Local. \throws CommandLineError  for another format.
std::string documentOf(const Schema& schema, const std::string& format, const SceneExample& example = {});

}  // namespace suture
