#pragma once
#include <suture/mesh/CellBlock.hpp>

#include <vector>

namespace suture {

/// Shape functions of a reference element, tabulated at the points of a quadrature rule. Made once a shape by Intrepid2's bases and
/// cubature; loops over elements need nothing else of it.
struct ReferenceElement {
  static constexpr int maxNodes = 9;  ///< largest number of all cells: a bound for arrays on the stack

  int nodes = 0;
  int points = 0;
  int dimension = 2;
  std::vector<double> weights;    ///< points
  std::vector<double> values;     ///< points x nodes
  std::vector<double> gradients;  ///< points x nodes x dimension, with respect to reference coordinates

  const double* valuesAt(int point) const { return values.data() + std::size_t(point) * nodes; }
  const double* gradientsAt(int point) const { return gradients.data() + std::size_t(point) * nodes * dimension; }
};

/// Purpose of a quadrature rule. The first two are exact on affine cells with constant data.
enum class Rule : int {
  Stiffness = 0,  ///< products of gradients: degree 2 (p - 1) on triangles, 2 p in each direction on quadrilaterals
  Load = 1,       ///< products of a shape function with a factor of order p
  Centroid = 2,   ///< the one-point rule
  Data = 3,       ///< products with a function of the place: degree 2 p + 4, so that no order of convergence is lost
  Sampling = 4,   ///< where stresses are superconvergent, or best: the centroid (order 1), three points or 2 x 2 Gauss points (order 2)
  Recovery = 5,   ///< products of shape functions
  Revolution = 6  ///< as Stiffness with the factor r and terms in 1 / r: constant stresses are exact on curved cells, too
};

/// The rule for the stiffness of a block's elements.
inline Rule stiffnessRule(const CellBlock& block) { return block.axisymmetric ? Rule::Revolution : Rule::Stiffness; }

/// Local. Kokkos must be initialised (Tpetra::ScopeGuard does that). \throws InternalError if it is not.
const ReferenceElement& referenceElement(Cell cell, Rule rule);

/// The trace of the cells' shape functions on a side of 2 or 3 nodes (end points first), on the reference interval [-1, 1]. Exact for
/// pressure on curved sides, too. Local. \throws InternalError as above, or for another number of nodes.
/// \param rule  Load or Data
const ReferenceElement& referenceSide(int nodes, Rule rule = Rule::Load);

}  // namespace suture
