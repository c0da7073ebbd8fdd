#pragma once
#include <suture/base/Errors.hpp>

#include <functional>
#include <string>
#include <vector>

namespace suture {

/// Number of the assignment that a problem of a scene is about, or on whose path it lies; -1: none, the file is to blame. Local.
int overrideOf(const Problem& problem, const std::vector<std::string>& overrides);

/// Runs `work`; problems of its InputError that are about an assignment of the command line say so: the file named above them does not
/// have it. Local.
ExitCode tellingOverrides(const std::vector<std::string>& overrides, const std::function<ExitCode()>& work);

}  // namespace suture
