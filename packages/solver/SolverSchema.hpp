#pragma once
#include <suture/base/scene/Schema.hpp>

#include <string>
#include <vector>

namespace suture {

/// \throws InputError  if the outer solver does not fit the formulation; the message lists those that do. Local, the same on all ranks.
/// \param settings  resolved lists of the solver packages
void checkCombination(const Parameters& settings);

/// Adds the parameters of the solver packages to the scene's schema: Formulation, Outer Solver, Preconditioner, Subdomain. Local.
void addSolverParameters(Schema& scene);

/// Warnings for outer and inner tolerances above 1e-2: contact states and forces may be wrong by as much, and only the verdict shows
/// whether the solution is valid. Local. \param scene  the whole resolved scene
std::vector<std::string> looseTolerances(const Parameters& scene);

}  // namespace suture
