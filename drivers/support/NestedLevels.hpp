#pragma once
#include <suture/base/Monitor.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/solver/Decomposition.hpp>

#include <memory>

#include "SolveOptions.hpp"

namespace suture {

/// The start of `Outer Solver/Start = Nested`: solves the scene on each coarser level of the list, one from the other, and carries the last
/// answer to `problem`. Null when the scene does not ask for it. Levels are scenes of their own, with the overrides of the level; all of
/// them are read, and their errors told, before one is solved. Collective. \throws NumericalError  a level does not converge
std::unique_ptr<InterfaceState> nestedStartStage(const CommPtr& comm, const SolveOptions& options, const Parameters& scene,
                                                 const InterfaceProblem& problem, const Subdomains& subdomains, Monitor& monitor);

}  // namespace suture
