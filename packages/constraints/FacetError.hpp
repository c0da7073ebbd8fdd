#pragma once
#include <suture/constraints/BuildConstraints.hpp>
#include <suture/constraints/ContactLine.hpp>
#include <suture/constraints/pairing/ContactPairs.hpp>

#include <string>
#include <vector>

namespace suture {

/// Mean compliance of the elements along a curve group, whatever the rest of their body is made of; zero of no group. Local. [1 / stress]
double complianceOf(const Mesh& mesh, const std::string& group, const ContactScales& scales);

/// Adds a note of the deepest interference that a line is drawn with. One below a millionth of the distance of its pairs, or below the
/// estimated error of the gap, is none. Local.
void noteInterference(const ContactLine& line, const PairedLine& paired, const std::string& unit, std::vector<std::string>& notes);

/// Sets the pieces' pressureDoubt from the estimated errors delta_j of the gaps: the largest
///     2.4 E* |delta_j - (delta_(j-1) + delta_(j+1)) / 2| / h,   1 / E* = c_A + c_B,  h the distance of neighbouring pairs.
/// Only changes from pair to pair count: a uniform error moves the bodies, and does not press. Local.
void estimatePressures(const std::vector<ContactLine>& lines, const std::vector<PairedLine>& paired, Constraints& constraints);

}  // namespace suture
