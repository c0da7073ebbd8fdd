#pragma once
#include <suture/solver/OuterSolver.hpp>

namespace suture {

/// Frictional contact for the problem's FrictionStates, by StateSearch. Without a given start the first states are those of rigid bodies on
/// pads. Collective. \param innerTolerance  of linear solves until the states no longer change
void searchFriction(OuterSolver::Run& run, double innerTolerance);

}  // namespace suture
