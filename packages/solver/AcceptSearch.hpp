#pragma once
#include <suture/search/StateSearch.hpp>
#include <suture/solver/OuterSolver.hpp>

namespace suture {

/// Ends a run with the result of a search for pair states: solved or not, with the reason, and a note if round-off limits the accuracy or
/// the solution may not be unique. run.result.state must already have the found states. Local.
void acceptSearch(OuterSolver::Run& run, const StateSearch::Result& found);

}  // namespace suture
