#pragma once
#include <suture/base/Monitor.hpp>
#include <suture/base/Timers.hpp>
#include <suture/simulation/Scene.hpp>
#include <suture/solver/Solution.hpp>

#include <vector>

namespace suture {

class LoadPath;

/// True if the settings ask for an estimate of the discretisation error: as a result, or for an automatic tolerance. Local.
bool wantsErrorEstimate(const Parameters& settings);

/// True if the settings ask for recovered stresses at the nodes. Local.
bool wantsNodalStresses(const Parameters& settings);

/// Motions that the solution leaves free (settleNeutralMotions): notes, or what keeps the run from ending well; pressures on the axis.
/// Collective.
void settleMotions(const Comm& comm, std::vector<SubdomainMesh>& meshes, const std::vector<ContactPiece>& pieces, const Scene& scene,
                   Solution& solution, Monitor& monitor);

/// Adds the solution's errors, against the exact solution of a scene that has one, and estimated where the settings want that, and
/// recovered stresses, where they want these. Phases "errors", "estimate", "recover". Collective.
void findErrors(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Scene& scene, Solution& solution, Timers& timers);

/// Adds a cheap estimate of the error of the mesh (averagedEstimate) where there is no other, if the settings want it. None of scenes with
/// subdomains whose physics are their own: their stresses follow no law that is known. Phase "estimate". Collective.
void estimateMesh(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Subdomains& subdomains, const Scene& scene,
                  Solution& solution, Timers& timers);

/// Adds the extremes of the verified solution. Collective.
void findAnswers(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Scene& scene, Solution& solution);

/// Judges the solution by its displacements and contact forces alone. A verdict that does not hold is the run's failure, whatever the
/// solver believed. Of `subdomains` those with physics of their own are asked for their forces and stresses; the others are not, and may be
/// null. Collective. \param path  the load steps so far, or null; after the first, controlled loads keep the amounts that it found
void verifySolution(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<ContactPiece>& pieces,
                    const Subdomains& subdomains, const Scene& scene, const LoadPath* path, Solution& solution);

}  // namespace suture
