#pragma once
#include <suture/base/scene/Schema.hpp>

#include "SceneTree.hpp"

namespace suture {

/// Checks a tree against a schema and fills `resolved` with all values and defaults; all errors go to `problems`. Local.
/// \return a note for each parameter that differs from its default but belongs to a choice that is not taken; none if there are problems
std::vector<std::string> resolve(const RawList& tree, const Schema& schema, Parameters& resolved, Problems& problems);

}  // namespace suture
