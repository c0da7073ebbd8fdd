#pragma once
#include <string>
#include <vector>

namespace suture {

/// Loads user libraries, whose static objects register strategies; they stay loaded. Call before the schema is built. Local.
/// \throws CommandLineError  a library cannot be loaded; contains the system's reason
void loadPlugins(const std::vector<std::string>& paths);

}  // namespace suture
