#pragma once
#include <suture/solver/OuterSolver.hpp>

namespace suture {

/// Contact with friction by FrictionSearch, for the problem's FrictionStates. Without a start of its own it begins with a loose solution
/// without friction, where that exists, and a Tresca problem by its normal forces; else with what rigid bodies on pads that also hold along
/// the tangents press together, all of it sticking. Collective.
/// \param innerTolerance  of linear solves until the states stay
void searchFriction(OuterSolver::Run& run, double innerTolerance);

}  // namespace suture
