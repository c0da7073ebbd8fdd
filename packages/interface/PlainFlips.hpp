#pragma once
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/pairs/ContactLaw.hpp>
#include <suture/search/RigidBodyModel.hpp>

namespace suture {

/// Relative accuracy of a gap, as a difference of displacements.
constexpr double kGapDigits = 1e-14;

/// The next set given by forces and penetrations of an evaluation, as the laws project them: closed pairs in tension open, penetrating open
/// pairs close, each if it exceeds its tolerance. Sets the evaluation's tolerances and its counts of changed and closed pairs. Local; the
/// same on all ranks.
/// \param laws        of the contact lines
/// \param digits      round-off of each pair's penetration [length]
ClosedSet plainFlips(const RigidBodyModel& rigid, const ContactLaws& laws, const ClosedSet& closed, PairResolution resolution,
                     const Vector& digits, InterfaceEvaluation& found);

}  // namespace suture
