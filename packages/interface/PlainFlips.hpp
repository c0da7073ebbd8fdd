#pragma once
#include <suture/constraints/ContactLaw.hpp>
#include <suture/contact/RigidContact.hpp>
#include <suture/interface/InterfaceProblem.hpp>

namespace suture {

/// Digits of displacements that a gap can have: gaps are differences of them.
constexpr double kGapDigits = 1e-14;

/// The set after an evaluation's forces and penetrations, as the laws project them: closed pairs that pull open, open ones that penetrate
/// close, each by more than it must be believed by. Sets the evaluation's tolerances, and its counts of changed and closed pairs. Local;
/// the same on all ranks.
/// \param laws        of the contact lines
/// \param digits      rounding of each pair's penetration [length]
ClosedSet plainFlips(const RigidContact& rigid, const ContactLaws& laws, const ClosedSet& closed, PairResolution resolution,
                     const Vector& digits, InterfaceEvaluation& found);

}  // namespace suture
