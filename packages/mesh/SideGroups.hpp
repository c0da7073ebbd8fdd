#pragma once
#include <suture/mesh/CellBlock.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// Side groups by name: "curve groups" in 2D, "surface groups" in 3D.
using SideGroups = std::map<std::string, std::vector<Side>>;

/// The names in a parameter that holds several, as {left, right}, or a single name; empty if the parameter is absent. Local.
std::vector<std::string> groupNames(const Parameters& list, const std::string& parameter);

/// Union of the sides of several groups, in the order of the names, without duplicates. Groups that do not exist contribute none. Local.
std::vector<Side> sidesOf(const SideGroups& groups, const std::vector<std::string>& names);

/// "'left' + 'right'": several groups in a message. Local.
std::string quoted(const std::vector<std::string>& names);

}  // namespace suture
