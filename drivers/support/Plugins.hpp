#pragma once
#include <string>
#include <vector>

namespace suture {

/// Loads users' libraries, whose static objects add strategies to the registries; they stay loaded. Before the schema is built. Local.
/// \throws CommandLineError  for one that cannot be loaded, with the reason of the system
void loadPlugins(const std::vector<std::string>& paths);

}  // namespace suture
