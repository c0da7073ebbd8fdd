#pragma once
#include <suture/mesh/CellBlock.hpp>

#include <cmath>
#include <functional>
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

// The same in 3D. Nodes of a cell whose reference element is mapped by a function of place: straight edges if it is linear there.
const std::vector<Cell>& solids();
CellBlock mapped(Cell cell, const std::function<suture::Point(const suture::Point&)>& map);
// The brick [0,a] x [0,b] x [0,c], the tetrahedron or wedge that is a part of it, or the pyramid on its base.
CellBlock brick(Cell cell, double a, double b, double c);
// Straight edges, far from any symmetry: except tetrahedra, no affine image of the reference element; sides of four nodes are warped.
CellBlock distortedSolid(Cell cell);
// distortedSolid() with the nodes of edges, sides and centres moved off their middles.
CellBlock curvedSolid(Cell cell);
// All sides of a block of one element.
std::vector<suture::Side> sidesOfElement(const CellBlock& block);

// Area of the polygon of the vertices (shoelace).
double polygonArea(const CellBlock& block, int vertices);

}  // namespace sample
