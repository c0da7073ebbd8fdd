#pragma once
#include <suture/base/Schema.hpp>

namespace suture {

/// Adds what the solver packages read to the scene's schema: Formulation, Outer Solver, Preconditioner, Subdomain. Local.
void addSolverParameters(Schema& scene);

}  // namespace suture
