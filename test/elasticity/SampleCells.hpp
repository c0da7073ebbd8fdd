#pragma once
#include <suture/mesh/CellBlock.hpp>

#include <cmath>
#include <vector>

// One element of every shape for the tests of elasticity, placed by a map of the plane.
namespace sample {

using suture::Cell;
using suture::CellBlock;

const std::vector<Cell>& cells();

inline bool isTriangle(Cell cell) { return cell == Cell::Triangle3 || cell == Cell::Triangle6; }

// Nodes of a straight-sided element with the given vertices (counter-clockwise): vertices, mid-sides, centre.
CellBlock straight(Cell cell, const std::vector<std::array<double, 2>>& vertices);

// The triangle (0,0), (a,0), (0,b) or the rectangle [0,a] x [0,b].
CellBlock axisParallel(Cell cell, double a, double b);

// Far from any symmetry, straight sides; a quadrilateral is no parallelogram.
CellBlock distorted(Cell cell);

// distorted() with every mid-side node pushed off its chord: curved sides.
CellBlock curved(Cell cell);

// Area within the polygon of the vertices (shoelace).
double polygonArea(const CellBlock& block, int vertices);

}  // namespace sample
