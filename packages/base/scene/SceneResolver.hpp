#pragma once
#include <suture/base/scene/Schema.hpp>

#include "SceneTree.hpp"

namespace suture {

/// Checks a tree against a schema and fills `resolved` with every value and default; all that is wrong goes to `problems`. Local.
/// \return a note for each parameter that has another value than its default and belongs to a choice that is not taken; none where there
/// are problems
std::vector<std::string> resolve(const RawList& tree, const Schema& schema, Parameters& resolved, Problems& problems);

}  // namespace suture
