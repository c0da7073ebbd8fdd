#pragma once
#include <suture/base/Monitor.hpp>

#include <string>
#include <vector>

namespace suture {

/// history.csv: a header line, then a row an outer iteration (none for a linear scene): the members of OuterRow by their names,
/// load_step in a scene with load steps alone.
/// Numbers are written so that reading gives the same double. Local.
/// \throws EnvironmentError
void writeHistory(const std::vector<OuterRow>& rows, const std::string& path);

}  // namespace suture
