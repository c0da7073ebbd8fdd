#pragma once
#include <string>
#include <vector>

namespace suture {

/// "Path/To/Parameter" of "Path / To/Parameter = value": blanks around names mean nothing. Local.
std::string overridePath(const std::string& assignment);

/// Adds an assignment to those that the reader is given, in place of an earlier one of the same parameter: the reader itself takes two of
/// one parameter for a slip. Local.
void setOverride(std::vector<std::string>& overrides, const std::string& assignment);

}  // namespace suture
