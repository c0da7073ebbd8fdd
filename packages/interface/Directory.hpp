#pragma once
#include <suture/interface/InterfaceLayout.hpp>
#include <suture/interface/TpetraTypes.hpp>

#include <vector>

namespace suture {

/// Tpetra map of ids in any order, possibly repeated: ascending, each once per rank; several ranks may have the same id. Collective.
MapPtr mapOf(const CommPtr& comm, std::vector<GlobalId> ids);

/// For each id of `seen`, in its order: the numbers that all ranks which see the id give for it, ascending, each once. Memory and messages
/// are proportional to what a rank sees. Collective.
/// \param owned  the ids of `seen`, each on one rank
/// \param mine   numbers of this rank for each id of `seen`, not negative
std::vector<std::vector<int>> joinNumbers(const MapPtr& seen, const MapPtr& owned, const std::vector<std::vector<int>>& mine);

/// For each id of `seen`, in its order: the unknown as described by a rank that knows it. Collective.
/// \param owned  the ids of `seen`, each on one rank
/// \param known  unknowns that this rank knows; over all ranks each id of `seen` at least once, in any order
std::vector<InterfaceLayout::Unknown> joinUnknowns(const MapPtr& seen, const MapPtr& owned,
                                                   const std::vector<InterfaceLayout::Unknown>& known);

/// Numbers 0, 1, ... for distinct keys that several ranks may use. Returns the number of each of this rank's keys; `count`: keys over all
/// ranks. Which key gets which number depends on the ranks. Collective.
std::vector<int> numberKeys(const CommPtr& comm, const std::vector<GlobalId>& keys, int& count);

}  // namespace suture
