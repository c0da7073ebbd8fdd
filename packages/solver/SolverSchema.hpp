#pragma once
#include <suture/base/scene/Schema.hpp>

#include <string>
#include <vector>

namespace suture {

inline constexpr const char* kCondensedGroups = "Condensed Groups";
inline constexpr const char* kContactOnTheInterface = "Contact On The Interface";

/// True if an outer solver, by name, can solve a formulation; both are believed of a user's own. Local.
bool solvesFormulation(const std::string& method, const std::string& formulation);

/// Adds what the solver packages read to the scene's schema: Formulation, Outer Solver, Preconditioner, Subdomain. Local.
void addSolverParameters(Schema& scene);

/// Warnings on tolerances of the outer and the inner solver above 1e-2: statuses and forces may be off by as much, and the verdict alone
/// says whether the answer holds. Local. \param scene  the whole resolved scene
std::vector<std::string> looseTolerances(const Parameters& scene);

}  // namespace suture
