#pragma once
#include <suture/answer/bound/PressedSides.hpp>

#include <optional>

namespace suture {

/// Tangential contact forces of the sides of a contact, and what limits them.
struct FrictionForces {
  std::vector<std::array<double, 2>> tangential;  ///< per node, along the tangents of its sides; in 2D the first [force]
  std::vector<double> bounds;                     ///< largest tangential force of each node [force]
  std::vector<char> slips;                        ///< per node: it slips
  std::optional<double> given;                    ///< bound of Tresca friction, if it is a constant of the whole contact [stress]
};

/// Friction stresses with the moments of given tangential forces, and bounds g that they do not exceed anywhere: statically admissible for
/// Tresca friction with the bounds g.
struct FrictionTractions {
  std::array<Matrix, 2> values;             ///< nodal values of the stresses along the tangents, sideNodes x sides [stress]
  Matrix bounds;                            ///< nodal values of g, sideNodes x sides [stress]
  Matrix up, down;                          ///< 2D: nodal values of g + stress and g - stress, nowhere negative [stress]
  std::vector<std::array<double, 2>> rest;  ///< force minus moment of each node; zero except in clusters [force]
  std::vector<std::vector<int>> clusters;   ///< ContactPressures; for each of them `rest` is self-balanced
  bool isGiven = false;                     ///< g is `FrictionForces::given`
  bool feasible = false;
};

/// In 2D half the difference of two polynomials q+ and q- >= 0 with the moments bound +- tangential force; g is half their sum. With a
/// given bound q+ + q- = 2 g. Where there are no such polynomials, and in 3D: the stresses closest to a smooth estimate; g is a
/// distribution of the bounds, but equals the stress where that is larger and on sides all of whose nodes slip. Local. \param sides  places
/// and sizes
FrictionTractions frictionTractions(const PressedSides& sides, const FrictionForces& forces);

/// Integral of g |slip| - stress . slip over all sides; not negative. Exact in 2D, in 3D at most an upper bound. [force length]
/// \param slips  nodal values along the tangents, sideNodes x sides each; in 2D the first [length]
double slipWork(const PressedSides& sides, const FrictionTractions& friction, const std::array<Matrix, 2>& slips);

/// Integral of g |slip|, likewise. [force length]
double frictionEnergy(const PressedSides& sides, const FrictionTractions& friction, const std::array<Matrix, 2>& slips);

}  // namespace suture
