#pragma once
#include <suture/mesh/Mesh.hpp>

#include <vector>

namespace suture {

/// Element groups of a mesh whose elements are parts of those of another mesh. Local. \param first  first part of each element, and the
/// number of all parts
inline void passOnElementGroups(const Mesh& from, const std::vector<int>& first, Mesh& to) {
  for (const auto& [name, members] : from.elementGroups) {
    std::vector<int>& own = to.elementGroups[name];
    for (const int e : members)
      for (int part = first[e]; part < first[e + 1]; ++part) own.push_back(part);
  }
}

}  // namespace suture
