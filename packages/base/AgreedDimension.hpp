#pragma once
#include <suture/base/Types.hpp>

#include <type_traits>

namespace suture {

/// The dimension of the scene on all ranks: a rank that owns no subdomain cannot know it by itself, and a default there would decide on
/// collectives in another way than the other ranks do. Collective.
/// \param mine  2 or 3; 0: this rank does not know
/// \return 2 or 3, the same on all ranks; 0: none knows
/// \throws InternalError  on all ranks, if two know different ones
int agreedDimension(const Comm& comm, int mine);

/// The same of what a rank has: subdomains, or pointers to them, with a member `dimension`.
template <typename Meshes>
int agreedDimensionOf(const Comm& comm, const Meshes& meshes) {
  int mine = 0;
  if constexpr (std::is_pointer_v<typename Meshes::value_type>)
    mine = meshes.empty() ? 0 : meshes.front()->dimension;
  else
    mine = meshes.empty() ? 0 : meshes.front().dimension;
  return agreedDimension(comm, mine);
}

}  // namespace suture
