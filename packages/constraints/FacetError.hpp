#pragma once
#include <suture/constraints/BuildConstraints.hpp>
#include <suture/pairs/ContactPairs.hpp>
#include <suture/pairs/ContactSurface.hpp>

#include <string>
#include <vector>

namespace suture {

/// Mean compliance of the elements along a face, regardless of the rest of their bodies; zero for an empty face. Local. [1 / stress]
double complianceOf(const Mesh& mesh, const ContactFace& face, const ContactScales& scales);

/// Adds a note on the deepest drawn interference of a contact; a warning if the contact joins two bodies and the interference is deeper
/// than the longest element. Interference below a millionth of the distance between pairs, or below the estimated error of the gap, is
/// ignored. Local.
void noteInterference(const ContactSurface& contact, const PairedSurface& paired, const std::string& unit, std::vector<std::string>& notes);

/// Adds a warning if the distance between the sides of a contact exceeds the length of the contact. Local.
void noteDistance(const ContactSurface& contact, const PairedSurface& paired, const std::string& unit, std::vector<std::string>& notes);

/// Sets the pieces' pressureDoubt from the estimated errors delta_j of the gaps: the largest
///     2.4 E* |delta_j - mean of delta_k| / h,   1 / E* = c_A + c_B,  over the neighbours k of pair j, h their mean distance from it.
/// Only differences between pairs count: a uniform error moves the bodies without changing the pressure. Local.
void estimatePressures(const std::vector<ContactSurface>& contacts, const std::vector<PairedSurface>& paired, Constraints& constraints);

}  // namespace suture
