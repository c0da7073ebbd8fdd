#pragma once
#include <string>

namespace suture {

/// True if a name matches a pattern in which * stands for any characters (none, too) and ? for exactly one. Case matters.
bool matchesPattern(const std::string& name, const std::string& pattern);

}  // namespace suture
