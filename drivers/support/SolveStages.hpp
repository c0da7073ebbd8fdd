#pragma once
#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/partition/PartitionFile.hpp>
#include <suture/quality/ExactErrors.hpp>
#include <suture/report/Report.hpp>
#include <suture/report/SceneSchema.hpp>
#include <suture/solver/Decomposition.hpp>
#include <suture/solver/MemoryEstimate.hpp>

#include "SolveOptions.hpp"
#include "SolveScene.hpp"
#include "Stages.hpp"

namespace suture {

/// --print-defaults: the resolved scene as XML on standard output.
RunResult printDefaults(const Comm& comm, const SceneFile& file);

/// The mesh with its bodies, on rank 0. \throws InputError  Collective.
Mesh meshStage(const Comm& comm, const SceneFile& file);

/// Rules, pairs and pieces, on rank 0. \throws InputError  Collective.
Constraints constraintsStage(const Comm& comm, const Mesh& mesh, const Parameters& scene);

/// Checks that elements go with their materials, in the whole mesh on rank 0 or in each rank's own. \throws InputError  names material and
/// body. Collective.
void elementsStage(const Comm& comm, const Mesh& mesh, const ElasticModel& model);
void elementsStage(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model);

/// Checks that the scene has a solution. \throws InputError  names the body and where it can move. Collective.
/// \param partition  of the mesh: whether its bodies are known to be connected
void solvabilityStage(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const ElasticModel& model,
                      const Partition& partition);

/// Properties of the whole scene that later stages need.
struct Whole {
  ProblemSize size;                  ///< on all ranks; without the interface
  std::vector<ContactPiece> pieces;  ///< on rank 0
  std::string hash;                  ///< of the mesh, on rank 0
};

/// Collective.
Whole wholeStage(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const Partition& partition);

/// The bodies in subdomains, each rank with its own.
struct CutMesh {
  Partition partition;
  std::vector<SubdomainMesh> meshes;
  Whole whole;
};

/// True if rank 0 needs the whole mesh; not, where it is in the file in pieces (Partition/Type = Partitioned Mesh). Local.
bool needsWholeMesh(const Parameters& scene);

/// Cuts mesh and constraints of rank 0, or reads what suture_partition has cut. \throws InputError  Collective.
CutMesh cutStage(const Comm& comm, const SceneFile& file, const Mesh& mesh, const Constraints& constraints);

/// For suture_partition: adds the cut of the scene to its mesh file. On rank 0.
void addCut(Hdf5File& file, const Mesh& mesh, const Constraints& constraints, const Partition& partition, const Whole& whole,
            const Parameters& scene);

/// Frees what rank 0 holds in proportion to the whole mesh: after distribute() and the checks only Monolithic needs it. Local.
void forget(Mesh& mesh, Constraints& constraints, Partition& partition);

/// Subdomains of the kinds that the scene names, assembled; none for the outer solver Monolithic, which must do without. Collective.
Subdomains subdomainsStage(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const Parameters& scene);

/// The interface problem of the scene's formulation; null for the outer solver Monolithic, which has none. Collective.
std::unique_ptr<InterfaceProblem> problemStage(const CommPtr& comm, const Partition& partition, const Subdomains& subdomains,
                                               const Parameters& scene);

/// Where the outer solver begins: the state in the checkpoint of --restart, that of a nested start, or null. Collective.
std::unique_ptr<InterfaceState> startStage(const CommPtr& comm, const SolveOptions& options, const InterfaceProblem* problem,
                                           const std::string& meshHash, const std::vector<SubdomainMesh>& meshes,
                                           const Subdomains& subdomains, const Parameters& scene, Monitor& monitor);

/// Adds the solution's errors: against the exact solution of a scene that has one, and estimated where the scene asks for that
/// (Output/Error Estimate) or needs it (an automatic tolerance). Collective.
void errorStage(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const Parameters& scene,
                Solution& solution, Timers& timers);

/// Motions that the solution leaves free (settleNeutralMotions): notes, or what keeps the run from ending well; pressures on the axis.
/// Collective.
void neutralStage(const Comm& comm, std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const std::vector<ContactPiece>& pieces,
                  const Parameters& scene, Solution& solution, Monitor& monitor);

/// Judges the solution by its displacements and contact forces alone. A verdict that does not hold is the run's failure, whatever the
/// solver believed. Of `subdomains` those with physics of their own are asked for their forces and stresses; the others may be null.
/// Collective.
void verifyStage(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                 const std::vector<ContactPiece>& pieces, const Subdomains& subdomains, const Parameters& scene, Solution& solution);

/// Output/Checkpoint Every: from now on `monitor` writes checkpoint.h5 into the folder at the end of outer iterations, as often as the
/// scene asks for. All arguments must outlive the solver. \return false if it asks for none. Local.
bool writeCheckpoints(const CommPtr& comm, const Parameters& scene, const std::string& folder, const std::string& meshHash,
                      const std::vector<SubdomainMesh>& meshes, const Subdomains& subdomains, const InterfaceProblem* problem,
                      RunMonitor& monitor);

/// The header of the console; for --check more, and also with --quiet: its sizes are what was asked for.
/// \param memory  estimate for all ranks [MB]
void printSizes(const Comm& comm, const SceneFile& file, const ProblemSize& size, double memory, const SolveOptions& options);

/// Files and the last lines of the console; how the run ended. Collective.
RunResult reportStage(const Run& run, const SolveOptions& options);

}  // namespace suture
