#pragma once
#include <suture/answer/Solution.hpp>
#include <suture/base/Types.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/report/MovedBodies.hpp>
#include <suture/report/Steps.hpp>
#include <suture/solver/Method.hpp>

#include <memory>
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

  /// Force on a node of the mesh by which parts removed at a time held the others, if it is not yet released in full.
  struct Released {
    double removal;
    GlobalId node;
    Point force;
  };
  /// Part of the gap of a pair by which a placed body fits to a deformed side. [length]
  struct Fit {
    int pair;
    double gap;
  };
  std::string changes{};             ///< parts removed and placed so far, as a text; empty: unknown (earlier files). The same on all ranks
  std::vector<Released> released{};  ///< written from rank 0, read on all ranks
  std::vector<Fit> fits{};           ///< likewise
  double since = 0.0;                ///< time of `Output/Displacements Since`; 0: not reached
  std::vector<Vector> reference{};   ///< displacements at that time, by subdomain of this rank
  /// Bodies that move far: not null on all ranks, written from rank 0, read on all ranks. Null: they do not move far.
  std::shared_ptr<const MovedBodies> moved{};

  bool empty() const { return rows.empty(); }
};

/// Writes a checkpoint (HDF5), first under a temporary name: displacements of all nodes and the status of all contact pairs, in mesh
/// numbering, such that a run with any number of ranks and any partition can continue from it. Collective. \throws EnvironmentError
/// \param meshHash  on rank 0; a checkpoint is valid for one mesh only
/// \param steps  load steps up to the solution
void writeCheckpoint(const Comm& comm, const std::string& path, const std::string& meshHash, const std::vector<SubdomainMesh>& meshes,
                     const Solution& solution, const PathState& steps = {});

/// Reads the load steps of a checkpoint, without displacements, before its mesh is known. Collective.
/// \throws InputError  no checkpoint, damaged, or without load steps
PathState readPath(const Comm& comm, const std::string& path);

/// Reads a checkpoint for this rank's subdomains, with the status of all pairs. Collective.
/// \param steps  if not null, receives the load steps of the run that wrote it; empty if there were none
/// \throws InputError  no checkpoint, damaged, or of another mesh
Start readCheckpoint(const Comm& comm, const std::string& path, const std::string& meshHash, const std::vector<SubdomainMesh>& meshes,
                     PathState* steps = nullptr);

}  // namespace suture
