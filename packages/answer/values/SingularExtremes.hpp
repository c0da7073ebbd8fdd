#pragma once
#include <suture/answer/Solution.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// The largest contact pressure, including points on the axis; null without pairs. On rank 0.
const PairResult* largestPressure(const Solution& solution);

/// Extremes of a solution, by their keys in summary.json, whose exact value is unbounded, with the reason: at a node that a condition at a
/// point holds or loads, at a re-entrant corner, or at the end of a contact side whose partner continues. Finite ones are missing. The same
/// on all ranks. Collective. \param keys  among "von_mises", "tension", "compression", "pressure"
std::map<std::string, std::string> singularExtremes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                                    const Solution& solution, const std::vector<std::string>& keys);

}  // namespace suture
