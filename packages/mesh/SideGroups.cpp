#include <suture/mesh/SideGroups.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include <set>

namespace suture {

std::vector<std::string> groupNames(const Parameters& list, const std::string& parameter) {
  if (!list.isParameter(parameter)) return {};
  if (list.isType<std::string>(parameter)) return {list.get<std::string>(parameter)};
  return list.get<Teuchos::Array<std::string>>(parameter).toVector();
}

std::vector<Side> sidesOf(const SideGroups& groups, const std::vector<std::string>& names) {
  std::vector<Side> all;
  std::set<std::pair<int, int>> taken;
  for (const std::string& name : names) {
    const auto found = groups.find(name);
    if (found == groups.end()) continue;
    if (names.size() == 1) return found->second;
    for (const Side& side : found->second)
      if (taken.insert({side.element, side.side}).second) all.push_back(side);
  }
  return all;
}

std::string quoted(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : " + '") + name + "'";
  return text;
}

}  // namespace suture
