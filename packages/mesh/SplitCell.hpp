#pragma once
#include <suture/mesh/CellBlock.hpp>

#include <functional>
#include <vector>

namespace suture {

/// Local vertices of a simplex of a cell; the last is -1 in 2D.
using CellSimplex = std::array<int, 4>;

/// True if a node of the block comes before another.
using NodeOrder = std::function<bool(int a, int b)>;

/// Simplices of an element, positive if the cell is convex: quadrilaterals in 2D are cut along the shorter diagonal, or from the first
/// vertex if they are equal; cells in 3D from their first vertex, and their quadrilateral sides from the first vertex of the side, so that
/// neighbours fit. A hexahedron becomes six tetrahedra, a wedge three, a pyramid two. Local. \param isBefore  a total order of the vertices
std::vector<CellSimplex> splitCell(const CellBlock& block, int element, const NodeOrder& isBefore);

/// Node of a cell of second order between two of its vertices: on an edge, at the centre of a side or of the cell; -1 if it has none.
int middleOf(Cell cell, int i, int j);

/// Side of a cell that contains some of its nodes; -1: none.
int sideThrough(const CellInfo& cell, const int* locals, int count);

}  // namespace suture
