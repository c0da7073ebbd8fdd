#pragma once
#include <suture/answer/bound/PressedSides.hpp>

namespace suture {

/// Heights to add to the gaps of the mid-edge nodes, so that the polynomial gap of degree 2 is nowhere negative on any side: with b_ij the
/// Bernstein coefficients of edges and g_i >= 0 the gaps of vertices, the quadratic polynomial is nonnegative on a segment if and only if
/// b >= -sqrt(g_0 g_1) (the least lift is used), on a triangle if and only if its matrix of coefficients is copositive (Hadeler 1983). Zero
/// where the gap is nonnegative. Degree 1: zero, a linear gap is nonnegative if its vertices are.
///
/// \param gaps  nodal gaps, sideNodes x sides [length]; those of vertices may be negative by round-off only, and count as zero
/// Returns one value per contact node; zero at vertices. A node shared by sides has the largest height of them. Local.
std::vector<double> liftOfGaps(const PressedSides& sides, const Matrix& gaps);

/// Integral of pressure times gap over all sides, exact. \param pressures, gaps  nodal values, sideNodes x sides. Local. [force length]
double gapWork(const PressedSides& sides, const Matrix& pressures, const Matrix& gaps);

}  // namespace suture
