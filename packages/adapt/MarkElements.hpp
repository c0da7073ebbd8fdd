#pragma once
#include <suture/base/Types.hpp>

#include <vector>

namespace suture {

/// Doerfler's bulk criterion: marks the smallest set of elements whose squared errors are at least the fraction `theta` of the sum.
/// Elements whose squares equal the smallest marked one (to 1e-4) are marked too, so that the set depends neither on the numbering nor on
/// round-off, and symmetric meshes stay symmetric. Local. \param squares  squared error of each element [energy]  \param theta  in (0, 1]
/// \return by element; all zero where there is no error
/// \throws InternalError  negative or non-finite squares, theta outside (0, 1]
std::vector<char> markElements(const std::vector<double>& squares, double theta = 0.6);

}  // namespace suture
