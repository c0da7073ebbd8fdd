#pragma once
#include <suture/constraints/BuildConstraints.hpp>
#include <suture/pairing/ContactPairs.hpp>
#include <suture/pairing/ContactSurface.hpp>

#include <string>
#include <vector>

namespace suture {

/// Mean compliance of the elements along a face, whatever the rest of their bodies is made of; zero of an empty face. Local. [1 / stress]
double complianceOf(const Mesh& mesh, const ContactFace& face, const ContactScales& scales);

/// Adds a note of the deepest interference that a contact is drawn with; a warning where it is one of two bodies and deeper than the
/// longest element. One below a millionth of the distance of its pairs, or below the estimated error of the gap, is none. Local.
void noteInterference(const ContactSurface& contact, const PairedSurface& paired, const std::string& unit, std::vector<std::string>& notes);

/// Adds a warning where the sides of a contact are farther apart than it is long. Local.
void noteDistance(const ContactSurface& contact, const PairedSurface& paired, const std::string& unit, std::vector<std::string>& notes);

/// Sets the pieces' pressureDoubt from the estimated errors delta_j of the gaps: the largest
///     2.4 E* |delta_j - mean of delta_k| / h,   1 / E* = c_A + c_B,  over the pairs k beside j, h their mean distance from it.
/// Only changes from pair to pair count: a uniform error moves the bodies, and does not press. Local.
void estimatePressures(const std::vector<ContactSurface>& contacts, const std::vector<PairedSurface>& paired, Constraints& constraints);

}  // namespace suture
