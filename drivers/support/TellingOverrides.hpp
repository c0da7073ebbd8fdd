#pragma once
#include <suture/base/Errors.hpp>

#include <functional>
#include <string>
#include <vector>

namespace suture {

/// Index of the override that caused a problem of a scene, by its path; -1: none, i.e. the file is wrong. Local.
int overrideOf(const Problem& problem, const std::vector<std::string>& overrides);

/// Runs `work` and marks problems of its InputError that are caused by overrides from the command line, since the scene file named in the
/// message does not contain them. Local.
ExitCode tellingOverrides(const std::vector<std::string>& overrides, const std::function<ExitCode()>& work);

}  // namespace suture
