#pragma once
#include <suture/mesh/CellBlock.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// Side groups by name: "curve groups" in the plane, "surface groups" in space.
using SideGroups = std::map<std::string, std::vector<Side>>;

/// The names under a parameter that holds several, as {left, right}, or a single one; none where it is left out. Local.
std::vector<std::string> groupNames(const Parameters& list, const std::string& parameter);

/// The sides of several groups together, in the order of the names, each once. Groups that do not exist have none. Local.
std::vector<Side> sidesOf(const SideGroups& groups, const std::vector<std::string>& names);

/// "'left' + 'right'": several groups in a message. Local.
std::string quoted(const std::vector<std::string>& names);

}  // namespace suture
