#pragma once
#include <suture/base/Monitor.hpp>

#include <string>
#include <vector>

namespace suture {

/// history.csv: a header line, then one row per outer iteration (none for a linear scene). Columns are the members of OuterRow;
/// load_step only in a scene with load steps.
/// Numbers are written with enough digits to recover the same double. Local.
/// \throws EnvironmentError
void writeHistory(const std::vector<OuterRow>& rows, const std::string& path);

}  // namespace suture
