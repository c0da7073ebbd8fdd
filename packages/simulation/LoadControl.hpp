#pragma once
#include <suture/simulation/Scene.hpp>
#include <suture/solver/Solution.hpp>

namespace suture {

class Monitor;

/// True if the scene has loads whose amounts are unknown.
bool hasControlledLoads(const Scene& scene);

/// Finds the amounts at which the answer has the targets of all controlled loads, and sets them: Broyden's method, each step of which is a
/// solution of the scene with known amounts. One such load in a scene without contact takes three. Collective.
/// \param scene  with resolved loads  \param meshes  its subdomains
/// \throws NumericalError  a step does not converge; a target that the answer does not come near, which tells what it comes to
void controlLoads(const CommPtr& comm, Scene& scene, const std::vector<SubdomainMesh>& meshes, Monitor& monitor);

/// Check of the verdict: how far controlled loads are from their targets, relative to these. Collective.
Check targetCheck(const Comm& comm, const Scene& scene, const std::vector<SubdomainMesh>& meshes, const Solution& solution);

}  // namespace suture
