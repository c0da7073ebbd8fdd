#pragma once
#include <suture/answer/bound/ContactPressures.hpp>

#include <functional>
#include <random>

namespace suture {

/// A line of segments with vertices at x.
PressedSides pressedLine(const std::vector<double>& x, int degree);

/// The unit square: cells x cells quadrilaterals with vertices moved by at most `shift` cells, cut along random diagonals.
PressedSides pressedSquare(int cells, int degree, double shift);

/// 0 .. 1 in `count` steps, inner points moved by at most shift / 2 steps.
std::vector<double> steps(int count, double shift, std::mt19937& random);

/// Adds the moments of the pressure with Bernstein coefficients p(side, local node), by quadrature independent of sideMass().
void press(PressedSides& sides, const std::function<double(int, int)>& p);

/// Point (weights of vertices) and weight of a quadrature that is exact for polynomials of degree 4.
struct SidePoint {
  std::vector<double> at;
  double weight;
};
std::vector<SidePoint> quadrature(int dimension);

/// Lagrange functions, Bernstein polynomials at a point.
std::vector<double> lagrange(const PressedSides& sides, const std::vector<double>& at);
std::vector<double> bernstein(const PressedSides& sides, const std::vector<double>& at);

/// Place of a local node.
Point placeOf(const PressedSides& sides, int side, int node);

}  // namespace suture
