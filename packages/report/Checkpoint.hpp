#pragma once
#include <suture/answer/Solution.hpp>
#include <suture/base/Types.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/report/Steps.hpp>
#include <suture/solver/Method.hpp>

#include <string>
#include <vector>

namespace suture {

/// State of a path of load steps.
struct PathState {
  /// A pair at the end of the last step.
  struct Pair {
    int id;
    ContactPair::Past past;  ///< at the beginning of the next step
    double force;            ///< along the normal, on B [force]
    Point tangential;        ///< on B [force]
  };
  std::vector<StepRow> rows;
  double length = 0.0;                ///< length of the next step
  std::vector<Pair> pairs{};          ///< written from rank 0, read on all ranks
  std::vector<BodyForces> carried{};  ///< largest forces on each body so far; empty: unknown (earlier files)
  std::vector<LeastSafety> safety{};  ///< least safety factors over the steps; written from rank 0, read on all ranks

  bool empty() const { return rows.empty(); }
};

/// Writes a checkpoint (HDF5), first under a temporary name: displacements of all nodes and the status of all contact pairs, in mesh
/// numbering, such that a run with any number of ranks and any partition can continue from it. Collective. \throws EnvironmentError
/// \param meshHash  on rank 0; a checkpoint is valid for one mesh only
/// \param steps  load steps up to the solution
void writeCheckpoint(const Comm& comm, const std::string& path, const std::string& meshHash, const std::vector<SubdomainMesh>& meshes,
                     const Solution& solution, const PathState& steps = {});

/// Reads a checkpoint for this rank's subdomains, with the status of all pairs. Collective.
/// \param steps  if not null, receives the load steps of the run that wrote it; empty if there were none
/// \throws InputError  no checkpoint, damaged, or of another mesh
Start readCheckpoint(const Comm& comm, const std::string& path, const std::string& meshHash, const std::vector<SubdomainMesh>& meshes,
                     PathState* steps = nullptr);

}  // namespace suture
