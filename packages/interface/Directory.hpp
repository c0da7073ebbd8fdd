#pragma once
#include <suture/interface/InterfaceLayout.hpp>
#include <suture/interface/TpetraTypes.hpp>

#include <vector>

namespace suture {

/// Ids in any order, perhaps repeated, as a Tpetra map: ascending, each once on a rank; several ranks may have the same. Collective.
MapPtr mapOf(const CommPtr& comm, std::vector<GlobalId> ids);

/// For each id of `seen`, in its order: the numbers that all ranks which see it give for it, ascending, each once. Memory and messages in
/// proportion to what a rank sees. Collective.
/// \param owned  the ids of `seen`, each on one rank
/// \param mine   numbers of this rank, not negative; for each id of `seen`
std::vector<std::vector<int>> joinNumbers(const MapPtr& seen, const MapPtr& owned, const std::vector<std::vector<int>>& mine);

/// For each id of `seen`, in its order: the unknown as a rank knows it. Collective.
/// \param owned  the ids of `seen`, each on one rank
/// \param known  those that this rank knows; each id of `seen` at least once over all ranks, in any order
std::vector<InterfaceLayout::Unknown> joinUnknowns(const MapPtr& seen, const MapPtr& owned,
                                                   const std::vector<InterfaceLayout::Unknown>& known);

/// Numbers 0, 1, ... for distinct keys that several ranks may use: number of each of this rank's keys, and how many there are over all
/// ranks. Which key gets which number depends on the ranks. Collective.
std::vector<int> numberKeys(const CommPtr& comm, const std::vector<GlobalId>& keys, int& count);

}  // namespace suture
