#pragma once
#include <suture/answer/Solution.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <string>
#include <vector>

namespace suture {

/// Notes on singularities: one each for the largest von Mises stress and the largest pressure if it is at a node that a condition at a
/// point holds or loads, at a re-entrant corner, or at the end of a contact side whose partner continues. The exact value there is
/// unbounded. The same on all ranks. Collective.
std::vector<std::string> singularNotes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                       const Solution& solution);

}  // namespace suture
