#pragma once
#include <suture/base/Types.hpp>

#include <type_traits>

namespace suture {

/// Returns the dimension of the scene on all ranks. A rank without subdomains does not know it, and a default on such a rank would send it
/// into other collectives than the other ranks. Collective.
/// \param mine  2 or 3; 0: this rank does not know
/// \return 2 or 3, the same on all ranks; 0: no rank knows
/// \throws InternalError  on all ranks, if two ranks disagree
int agreedDimension(const Comm& comm, int mine);

/// The same, from subdomains, or pointers to subdomains, that have a member `dimension`.
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
