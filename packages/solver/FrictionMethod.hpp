#pragma once
#include <suture/solver/OuterSolver.hpp>

namespace suture {

/// Frictional contact by FrictionSearch, for the problem's FrictionStates. Without a given start it begins with a rough frictionless
/// solution, if there is one, and a Tresca problem with its normal forces; otherwise with all pairs sticking that are pressed together by
/// rigid bodies on pads with tangential stiffness. Collective.
/// \param innerTolerance  of linear solves until the states no longer change
void searchFriction(OuterSolver::Run& run, double innerTolerance);

}  // namespace suture
