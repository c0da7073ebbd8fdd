#pragma once
#include <suture/answer/Solution.hpp>
#include <suture/base/Timers.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/report/AccuracyRequest.hpp>
#include <suture/report/Invocation.hpp>
#include <suture/report/RunMonitor.hpp>
#include <suture/report/Steps.hpp>
#include <suture/solver/ProblemSize.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Everything that a report needs of a run; all references must outlive it.
struct Run {
  const Comm& comm;
  const SceneFile& scene;
  const ElasticModel& model;
  const std::vector<ContactPiece>& pieces;       ///< on rank 0; unused on other ranks
  const std::vector<SubdomainMesh>& subdomains;  ///< subdomains of this rank
  const ProblemSize& size;
  const Solution& solution;
  const RunMonitor& monitor;
  Timers& timers;
  std::string meshHash;  ///< on rank 0
  Invocation invocation;
  std::string folder;                     ///< output folder
  std::vector<std::string> conditions{};  ///< names of boundary conditions in the numbering of Support::condition, on rank 0
  std::vector<std::string> contacts{};    ///< names of contact lines
  std::vector<StepRow> steps{};           ///< load steps so far; empty without load steps
  /// Names of all contacts of the load steps (StepRow::forceOnB), of which a scene whose bodies are removed or placed may now have only
  /// some.
  std::vector<std::string> contactsOfPath{};
  std::optional<AccuracyReached> accuracy{};  ///< result of a request for accuracy (list `Accuracy`)
  std::shared_ptr<const void> owned{};        ///< holder of referenced objects that nothing else holds
};

/// The number of space dimensions of the run, also on ranks without subdomains. Collective.
int dimensionOf(const Run& run);

}  // namespace suture
