#pragma once
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/solver/Solution.hpp>

#include <string>
#include <vector>

namespace suture {

/// A note each for the largest von Mises stress and the largest pressure where they sit at a place that is singular by geometry: a
/// re-entrant corner, the end of a contact side on a partner that goes on. There the exact value has no bound. The same on all ranks.
/// Collective.
std::vector<std::string> singularNotes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Solution& solution);

}  // namespace suture
