#pragma once
#include <suture/base/scene/Schema.hpp>

#include <string>
#include <vector>

namespace suture {

/// \throws InputError  the settings' outer solver does not fit their formulation: names those that do. Local, the same on all ranks.
/// \param settings  resolved lists of the solver packages
void checkCombination(const Parameters& settings);

/// Adds what the solver packages read to the scene's schema: Formulation, Outer Solver, Preconditioner, Subdomain. Local.
void addSolverParameters(Schema& scene);

/// Warnings on tolerances of the outer and the inner solver above 1e-2: statuses and forces may be off by as much, and the verdict alone
/// says whether the answer holds. Local. \param scene  the whole resolved scene
std::vector<std::string> looseTolerances(const Parameters& scene);

}  // namespace suture
