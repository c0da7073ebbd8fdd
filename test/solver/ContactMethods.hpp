#pragma once
#include <interface/ContactScenes.hpp>
#include <suture/monolithic/Monolithic.hpp>
#include <suture/precond/Preconditioner.hpp>
#include <suture/solver/OuterSolver.hpp>
#include <suture/solver/SolverSchema.hpp>

namespace suture::blocks {

/// Preconditioner by name, everything else by default.
std::function<Teuchos::RCP<Preconditioner>()> preconditioner(const std::string& name);

/// Solves by an outer solver's name. \param tolerance  that of the outer solver;  \param start  instead of the auxiliary solution, or null.
/// Collective.
OuterResult solveWith(const std::string& method, const InterfaceProblem& problem, double tolerance,
                      const std::function<Teuchos::RCP<Preconditioner>()>& makePreconditioner, const InterfaceState* start = nullptr);
OuterResult solveWith(const std::string& method, const InterfaceProblem& problem, double tolerance = 1e-10,
                      const std::string& preconditionerName = "BDDC", const InterfaceState* start = nullptr);

/// Distance of a solution from the monolithic one, over all ranks.
struct Distance {
  double displacement = 0.0, force = 0.0;  ///< relative to the largest
  int otherwise = 0;                       ///< pairs of another status
};

Distance distance(const Blocks& all, const InterfaceProblem::Recovered& found, const MonolithicResult& reference);

}  // namespace suture::blocks
