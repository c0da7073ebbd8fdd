#pragma once
#include <suture/base/Timers.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/report/Invocation.hpp>
#include <suture/report/RunMonitor.hpp>
#include <suture/report/Steps.hpp>
#include <suture/solver/ProblemSize.hpp>
#include <suture/solver/Solution.hpp>

#include <string>
#include <vector>

namespace suture {

/// Everything a report needs of a run; all references outlive it.
struct Run {
  const Comm& comm;
  const SceneFile& scene;
  const ElasticModel& model;
  const std::vector<ContactPiece>& pieces;       ///< on rank 0; not used on the others
  const std::vector<SubdomainMesh>& subdomains;  ///< subdomains of this rank
  const ProblemSize& size;
  const Solution& solution;
  const RunMonitor& monitor;
  Timers& timers;
  std::string meshHash;  ///< on rank 0
  Invocation invocation;
  std::string folder;                     ///< output folder
  std::vector<std::string> conditions{};  ///< names of boundary conditions as Support::condition numbers them, on rank 0
  std::vector<std::string> contacts{};    ///< names of contact lines
  std::vector<StepRow> steps{};           ///< load steps so far; empty for a scene without
};

/// The run's number of space dimensions (a rank without subdomains does not see it alone). Collective.
int dimensionOf(const Run& run);

}  // namespace suture
