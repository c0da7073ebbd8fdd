#pragma once
#include <suture/mesh/CellBlock.hpp>

#include <string>

namespace suture {

/// Smallest determinant of the Jacobian of the map from the reference cell anywhere on the element, also between its nodes: negative or
/// zero if the element is inverted, folded or collapsed. Accurate to 1e-3 of the largest value. [area or volume] Local.
/// \param place  gets the location in the mesh
double smallestJacobian(const CellBlock& block, int element, Point* place = nullptr);

/// Area of the polygon of an element's vertices, positive if they run counter-clockwise; in 3D the volume enclosed by its sides, positive
/// if these face outwards. [area or volume] Local.
double signedSize(const CellBlock& block, int element);

/// Mean of an element's vertices. Local.
Point centreOf(const CellBlock& block, int element);

/// Longest distance between two vertices of an element. [length] Local.
double diameterOf(const CellBlock& block, int element);

/// "(x, y)" for messages; six digits.
std::string placeText(const Point& point, int dimension = 2);

/// "7 elements (the first at (1, 2))", or "1 element (at (1, 2))": number and location of objects. `place`: placeText(); `more` follows the
/// noun.
std::string countAt(std::size_t count, const std::string& what, const std::string& place, const std::string& more = "");

}  // namespace suture
