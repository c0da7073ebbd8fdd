#pragma once
#include <suture/mesh/CellBlock.hpp>

#include <string>

namespace suture {

/// Smallest determinant of the Jacobian of the map from the reference cell anywhere on the element, between its nodes, too: negative or
/// zero where the element is turned over, folded or collapsed. To 1e-3 of the largest. [area or volume] Local. \param place  gets where it
/// is, in the mesh
double smallestJacobian(const CellBlock& block, int element, Point* place = nullptr);

/// Area of the polygon of an element's vertices, positive when they run counter-clockwise; in space the volume between its sides, positive
/// when these look outwards. [area or volume] Local.
double signedSize(const CellBlock& block, int element);

/// Mean of an element's vertices. Local.
Point centreOf(const CellBlock& block, int element);

/// Longest distance between two vertices of an element. [length] Local.
double diameterOf(const CellBlock& block, int element);

/// "(x, y)" for messages; six digits.
std::string placeText(const Point& point, int dimension = 2);

/// "7 elements (the first at (1, 2))", or "1 element (at (1, 2))": how many of something, and where. `place`: placeText(); `more` follows
/// the noun.
std::string countAt(std::size_t count, const std::string& what, const std::string& place, const std::string& more = "");

}  // namespace suture
