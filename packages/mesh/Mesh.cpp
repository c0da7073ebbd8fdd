#include <suture/base/Errors.hpp>
#include <suture/base/Hash.hpp>
#include <suture/mesh/Mesh.hpp>

#include <cstdint>

namespace suture {

namespace {

template <typename Map>
std::vector<std::string> keys(const Map& map) {
  std::vector<std::string> names;
  for (const auto& entry : map) names.push_back(entry.first);
  return names;
}

}  // namespace

std::vector<std::string> Mesh::elementGroupNames() const { return keys(elementGroups); }
std::vector<std::string> Mesh::sideGroupNames() const { return keys(sideGroups); }

std::string sideGroupProblem(const Mesh& mesh, const std::string& group) {
  const auto found = mesh.sideGroups.find(group);
  if (found == mesh.sideGroups.end())
    return "in the mesh " + mesh.source + ": " + unknownName(mesh.sideGroupKind(), group, mesh.sideGroupNames());
  if (found->second.empty()) return "the " + mesh.sideGroupKind() + " '" + group + "' of the mesh " + mesh.source + " is empty";
  return "";
}

std::string Mesh::hash() const {
  Hash hash;
  hash.number(std::int64_t(dimension));
  hash.numbers(coordinates);
  hash.numbers(cells);  // determine the number of nodes of each element
  hash.numbers(connectivity);
  for (const auto& [name, members] : elementGroups) {
    hash.text(name);
    hash.numbers(members);
  }
  for (const auto& [name, sides] : sideGroups) {
    hash.text(name);
    hash.number(std::int64_t(sides.size()));
    for (const Side& side : sides) {
      hash.number(std::int64_t(side.element));
      hash.number(std::int64_t(side.side));
    }
  }
  return hash.hexadecimal();
}

}  // namespace suture
