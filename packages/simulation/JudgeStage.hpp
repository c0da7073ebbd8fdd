#pragma once
#include <suture/answer/Solution.hpp>
#include <suture/base/Monitor.hpp>
#include <suture/base/Timers.hpp>
#include <suture/simulation/Scene.hpp>

#include <vector>

namespace suture {

class LoadPath;

/// True if the settings request an estimate of the discretisation error, as a result or for an automatic tolerance. Local.
bool wantsErrorEstimate(const Parameters& settings);

/// True if the settings request estimated errors of forces. Local.
bool wantsErrorBars(const Parameters& settings);

/// True if the settings request recovered stresses at the nodes. Local.
bool wantsNodalStresses(const Parameters& settings);

/// Handles motions that the solution leaves undetermined (settleNeutralMotions): adds notes, or marks the run as not Done. Adds pressures
/// on the axis. Collective. \param path  the load steps so far, or null
void settleMotions(const Comm& comm, std::vector<SubdomainMesh>& meshes, const std::vector<ContactPiece>& pieces, const Scene& scene,
                   const LoadPath* path, Solution& solution, Monitor& monitor);

/// Adds the errors of the solution (against the exact solution, if the scene has one; estimated, if the settings request it) and, on
/// request, recovered stresses. Phases "errors", "estimate", "recover". Collective.
void findErrors(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Scene& scene, Solution& solution, Timers& timers);

/// Adds a bound of the error (errorBound) if the settings request it. Phase "bound". Collective. \param parts  on rank 0 \param followsPath
/// the solution is the last one of a path of load steps
void boundError(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Subdomains& subdomains, const Scene& scene,
                const BoundaryParts& parts, bool followsPath, Solution& solution, Timers& timers);

/// Adds a cheap estimate of the discretisation error (averagedEstimate) if the settings request it and there is no other estimate. Skipped
/// for scenes with user-defined subdomains, whose stress law is unknown. Phase "estimate". Collective.
void estimateMesh(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Subdomains& subdomains, const Scene& scene,
                  const LoadPath* path, Solution& solution, Timers& timers);

/// Stresses of a verified solution recovered at the nodes of each mesh: nodes x components. NaN for user-defined subdomains, whose stress
/// law is unknown. Collective.
std::vector<Matrix> recoveredStresses(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                      const Solution& solution);

/// Adds the extremes and the safety factors of the verified solution. Collective.
void findAnswers(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Scene& scene, Solution& solution);

/// Adds estimated errors of forces, if the settings request them, to a converged solution. Collective. \param pieces, shown  the contacts
/// and the solution with the results of the scene's entries, as reported
void findErrorBars(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Scene& scene, const std::vector<ContactPiece>& pieces,
                   const Solution& shown, Solution& solution);

/// Verifies the solution from its displacements and contact forces alone. If the verdict does not hold, the run has failed, even if the
/// solver converged. Only user-defined entries of `subdomains` are called, for their forces and stresses; the other entries may be null.
/// Collective. \param path  the load steps so far, or null; after the first step, controlled loads keep the amounts found there
void verifySolution(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<ContactPiece>& pieces,
                    const Subdomains& subdomains, const Scene& scene, const LoadPath* path, Solution& solution);

}  // namespace suture
