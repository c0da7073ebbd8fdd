#pragma once
#include <suture/answer/Solution.hpp>
#include <suture/simulation/MeanSupports.hpp>
#include <suture/simulation/Scene.hpp>

namespace suture {

class Monitor;

/// True if the scene has loads whose amounts are unknown.
bool hasControlledLoads(const Scene& scene);

/// Finds and sets the amounts of all controlled loads such that the solution meets their targets. Uses Broyden's method; each iteration
/// solves the scene with known amounts. A single controlled load without contact takes three solutions. Collective.
/// \param scene     with resolved loads  \param meshes  its subdomains
/// \param supports  auxiliary supports of the scene, whose forces must vanish
/// \return displacements of these supports [length]
/// \throws NumericalError  an iteration does not converge; a target is not reached (the message gives the value reached)
Vector controlLoads(const CommPtr& comm, Scene& scene, const MeanSupports& supports, const std::vector<SubdomainMesh>& meshes,
                    Monitor& monitor);

/// Refuses load steps in a scene with auxiliary supports: the forces of its means change from step to step. \throws InputError  Local.
void requireOneStep(const Scene& scene, const MeanSupports& supports);

/// Check of the verdict: relative distance of controlled loads from their targets. Collective.
Check targetCheck(const Comm& comm, const Scene& scene, const std::vector<SubdomainMesh>& meshes, const Solution& solution);

}  // namespace suture
