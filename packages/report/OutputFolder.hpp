#pragma once
#include <suture/base/Types.hpp>

#include <string>

namespace suture {

/// Makes the output folder and checks that it can be written, before any work is done. Collective.
/// \throws EnvironmentError  names the folder and what the system says
void prepareFolder(const Comm& comm, const std::string& folder);

/// Writes a text file under a temporary name in the same folder and renames it, so that a reader never sees half of it. Local.
/// \throws EnvironmentError
void writeTextFile(const std::string& path, const std::string& text);

}  // namespace suture
