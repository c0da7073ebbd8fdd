#pragma once
#include <suture/base/scene/Schema.hpp>

#include "SceneTree.hpp"

namespace suture {

/// Checks a tree against a schema and fills `resolved` with every value and default; all that is wrong goes to `problems`. Local.
void resolve(const RawList& tree, const Schema& schema, Parameters& resolved, Problems& problems);

}  // namespace suture
