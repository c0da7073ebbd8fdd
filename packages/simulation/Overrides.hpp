#pragma once
#include <string>
#include <vector>

namespace suture {

/// "Path/To/Parameter" of "Path / To/Parameter = value"; blanks around names are ignored. Local.
std::string overridePath(const std::string& assignment);

/// Adds an assignment, replacing an earlier one of the same parameter: the reader would reject two assignments of one parameter as a
/// mistake. Local.
void setOverride(std::vector<std::string>& overrides, const std::string& assignment);

}  // namespace suture
