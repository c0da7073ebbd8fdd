#pragma once
#include <string>

namespace suture {

/// True if a name matches a pattern in which * matches any characters (or none) and ? exactly one. Case-sensitive.
bool matchesPattern(const std::string& name, const std::string& pattern);

}  // namespace suture
