#pragma once
#include <suture/base/Errors.hpp>

#include <functional>
#include <string>
#include <vector>

namespace suture {

/// "Path/To/Parameter" of "Path / To/Parameter = value": blanks around names mean nothing. Local.
std::string overridePath(const std::string& assignment);

/// Adds an assignment to those that the reader is given, in place of an earlier one of the same parameter: the reader itself takes two of
/// one parameter for a slip. Local.
void setOverride(std::vector<std::string>& overrides, const std::string& assignment);

/// Number of the assignment that a problem of a scene is about, or on whose path it lies; -1: none, the file is to blame. Local.
int overrideOf(const Problem& problem, const std::vector<std::string>& overrides);

/// Runs `work`; problems of its InputError that are about an assignment of the command line say so: the file named above them does not
/// have it. Local.
ExitCode tellingOverrides(const std::vector<std::string>& overrides, const std::function<ExitCode()>& work);

}  // namespace suture
