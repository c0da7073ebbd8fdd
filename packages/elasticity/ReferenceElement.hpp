#pragma once
#include <suture/mesh/CellBlock.hpp>

#include <vector>

namespace suture {

/// Largest number of nodes of the cells of a dimension: a bound for arrays on the stack.
template <int D>
constexpr int mostNodes = D == 2 ? 9 : kMostCellNodes;

/// Shape functions of a reference element (mesh/ShapeFunctions), tabulated at the points of a quadrature rule of Intrepid2. Created once
/// per cell and rule, on first use.
struct ReferenceElement {
  int nodes = 0;
  int points = 0;
  int dimension = 2;
  std::vector<double> weights;    ///< points
  std::vector<double> places;     ///< points x dimension: reference coordinates
  std::vector<double> values;     ///< points x nodes
  std::vector<double> gradients;  ///< points x nodes x dimension, with respect to reference coordinates

  const double* placeAt(int point) const { return places.data() + std::size_t(point) * dimension; }
  const double* valuesAt(int point) const { return values.data() + std::size_t(point) * nodes; }
  const double* gradientsAt(int point) const { return gradients.data() + std::size_t(point) * nodes * dimension; }
};

/// Purpose of a quadrature rule. The first two are exact on affine cells with constant data. Degrees refer to polynomials on triangles and
/// tetrahedra and to each direction elsewhere; p is the order of the cell. A wedge is a triangle times an interval; on a pyramid, a square
/// that shrinks towards its apex, shape functions and map are polynomials of the square's coordinates and of the height.
enum class Rule : int {
  Stiffness =
      0,     ///< products of gradients: degree 2 (p - 1) on simplices, 2 p elsewhere: 2 x 2 x 2 points in Hexahedron8, 3 x 3 x 3 in 20/27
  Load = 1,  ///< products of a shape function with a factor of order p; in 3D with the determinant of a curved cell's map
  Centroid = 2,   ///< the one-point rule
  Data = 3,       ///< products with a function of position: degree 2 p + 4, so that no order of convergence is lost
  Sampling = 4,   ///< where stresses are superconvergent or best: centroid (order 1), two Gauss points per direction (order 2) or three
                  ///< points of a triangle, four of a tetrahedron
  Recovery = 5,   ///< products of shape functions
  Revolution = 6  ///< as Stiffness with the factor r and terms in 1 / r: constant stresses are also exact on curved cells
};

/// The rule for the stiffness of a block's elements.
inline Rule stiffnessRule(const CellBlock& block) { return block.axisymmetric ? Rule::Revolution : Rule::Stiffness; }

/// Local. Kokkos must be initialised (by Tpetra::ScopeGuard) when a table is created. \throws InternalError  otherwise.
const ReferenceElement& referenceElement(Cell cell, Rule rule);

/// True if a Tetrahedron10 has an edge whose mid-side node is not at its middle. Local.
bool isCurvedTetrahedron(const CellBlock& block, int element);

/// The table for the stiffness of an element: that of stiffnessRule(), with which the forces of constant stresses are also exact on curved
/// cells, except for curved tetrahedra, which need more points. Local.
inline const ReferenceElement& stiffnessElement(const CellBlock& block, int element) {
  const Cell cell = block.cells[element];
  return referenceElement(cell, cell == Cell::Tetrahedron10 && isCurvedTetrahedron(block, element) ? Rule::Load : stiffnessRule(block));
}

/// Trace of the cells' shape functions on a side: 2D: 2 or 3 nodes, on the reference interval [-1, 1]; 3D: 3, 4, 6, 8 or 9 nodes, on the
/// reference triangle or square. Exact also for pressure on curved sides, and for products of two shape functions on flat sides. Local.
/// \throws InternalError  as above, or for another number of nodes. \param rule  Load or Data
const ReferenceElement& referenceSide(int nodes, int dimension, Rule rule = Rule::Load);

}  // namespace suture
