// Tables of shape functions and quadrature: against the functions of package mesh, and against integrals of monomials.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/ReferenceElement.hpp>
#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/mesh/SideGeometry.hpp>

#include <cmath>

#include <mesh/ReferenceCells.hpp>

#include "SampleCells.hpp"

using namespace suture;

namespace {

std::vector<Cell> everyCell() {
  std::vector<Cell> all = sample::cells();
  all.insert(all.end(), sample::solids().begin(), sample::solids().end());
  return all;
}

const Rule rules[] = {Rule::Stiffness, Rule::Load, Rule::Centroid, Rule::Data, Rule::Sampling, Rule::Recovery, Rule::Revolution};

// Coordinates of a quadrature point: shape functions reproduce the coordinates of the nodes.
Point placeOf(const ReferenceElement& table, Cell cell, int point) {
  Point place{0, 0, 0};
  for (int a = 0; a < table.nodes; ++a)
    for (int k = 0; k < 3; ++k) place[k] += table.valuesAt(point)[a] * referencePoint(cell, a)[k];
  return place;
}

double factorial(int n) { return std::tgamma(n + 1.0); }

// Integral of x^i y^j z^k over the reference element.
double integral(Cell cell, int i, int j, int k) {
  const auto line = [](int n) { return n % 2 ? 0.0 : 2.0 / (n + 1); };
  const auto triangle = [](int m, int n) { return factorial(m) * factorial(n) / factorial(m + n + 2); };
  if (cell == Cell::Wedge6) return triangle(i, j) * line(k);
  if (cell == Cell::Pyramid5)  // cross sections [-h, h]^2, h = 1 - z: integral of h^(i + j + 2) z^k
    return line(i) * line(j) * factorial(i + j + 2) * factorial(k) / factorial(i + j + k + 3);
  if (!isSimplex(cell)) return line(i) * line(j) * (dimensionOf(cell) == 3 ? line(k) : 1.0);
  return dimensionOf(cell) == 2 ? triangle(i, j) : factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 3);
}

void checkMonomials(const ReferenceElement& table, Cell cell, int degree, Teuchos::FancyOStream& out, bool& success) {
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; j <= degree - i; ++j)
      for (int k = 0; k <= (dimensionOf(cell) == 3 ? degree - i - j : 0); ++k) {
        double sum = 0.0;
        for (int q = 0; q < table.points; ++q) {
          const Point at = placeOf(table, cell, q);
          sum += table.weights[q] * std::pow(at[0], i) * std::pow(at[1], j) * std::pow(at[2], k);
        }
        TEST_COMPARE(std::abs(sum - integral(cell, i, j, k)), <, 1e-13);
      }
}

}  // namespace

TEUCHOS_UNIT_TEST(ReferenceElement, HasTheShapeFunctionsOfTheMeshAtEveryPoint) {
  for (const Cell cell : everyCell())
    for (const Rule rule : rules) {
      const ReferenceElement& table = referenceElement(cell, rule);
      TEST_EQUALITY(table.nodes, cellInfo(cell).nodes);
      TEST_EQUALITY(table.dimension, cellInfo(cell).dimension);
      double worst = 0.0;
      for (int q = 0; q < table.points; ++q) {
        const Point at = placeOf(table, cell, q);
        for (int k = 0; k < table.dimension; ++k) worst = std::max(worst, std::abs(table.placeAt(q)[k] - at[k]));
        const std::vector<ShapeJet> jets = referencecells::jets(cell, at);
        for (int a = 0; a < table.nodes; ++a) {
          worst = std::max(worst, std::abs(table.valuesAt(q)[a] - jets[a].value));
          for (int k = 0; k < table.dimension; ++k)
            worst = std::max(worst, std::abs(table.gradientsAt(q)[table.dimension * a + k] - jets[a].gradient[k]));
        }
      }
      TEST_COMPARE(worst, <, 2e-13);
    }
}

TEUCHOS_UNIT_TEST(ReferenceElement, IntegratesPolynomialsOfTheDegreeOfItsRule) {
  for (const Cell cell : everyCell()) {
    const int order = cellInfo(cell).order;
    const bool simplex = isSimplex(cell);
    checkMonomials(referenceElement(cell, Rule::Centroid), cell, 1, out, success);
    checkMonomials(referenceElement(cell, Rule::Stiffness), cell, simplex ? 2 * (order - 1) : 2 * order, out, success);
    checkMonomials(referenceElement(cell, Rule::Load), cell, simplex ? 2 * order : 2 * order + 1, out, success);
    checkMonomials(referenceElement(cell, Rule::Data), cell, cell == Cell::Tetrahedron10 ? 6 : 2 * order + 4, out, success);
    checkMonomials(referenceElement(cell, Rule::Recovery), cell, 2 * order, out, success);
  }
}

TEUCHOS_UNIT_TEST(ReferenceElement, HasTheUsualPointsIn3D) {
  const std::map<Cell, int> points{{Cell::Tetrahedron4, 1},  {Cell::Tetrahedron10, 4}, {Cell::Hexahedron8, 8}, {Cell::Hexahedron20, 27},
                                   {Cell::Hexahedron27, 27}, {Cell::Wedge6, 6},        {Cell::Pyramid5, 8}};
  for (const auto& [cell, count] : points) {
    TEST_EQUALITY(referenceElement(cell, Rule::Stiffness).points, count);
    TEST_EQUALITY(referenceElement(cell, Rule::Centroid).points, 1);
    TEST_EQUALITY(referenceElement(cell, Rule::Sampling).points, cellInfo(cell).order == 1 ? 1 : isSimplex(cell) ? 4 : 8);
  }
}

TEUCHOS_UNIT_TEST(ReferenceElement, KnowsTheSidesIn3DAsPlaneCells) {
  for (const int nodes : {3, 4, 6, 8, 9})
    for (const Rule rule : {Rule::Load, Rule::Data}) {
      const Cell cell = sideCell(nodes);
      const ReferenceElement& side = referenceSide(nodes, 3, rule);
      TEST_EQUALITY(side.nodes, nodes);
      TEST_EQUALITY(side.dimension, 2);
      checkMonomials(side, cell, 2 * cellInfo(cell).order, out, success);
      for (const double weight : side.weights) TEST_COMPARE(weight, >, 0.0);
      double worst = 0.0;
      for (int q = 0; q < side.points; ++q) {
        const std::vector<ShapeJet> jets = referencecells::jets(cell, placeOf(side, cell, q));
        for (int a = 0; a < nodes; ++a) worst = std::max(worst, std::abs(side.valuesAt(q)[a] - jets[a].value));
      }
      TEST_COMPARE(worst, <, 1e-13);
    }
  TEST_EQUALITY(referenceSide(3, 2).dimension, 1);
  TEST_THROW(referenceSide(5, 3), InternalError);
  TEST_THROW(referenceSide(4, 2), InternalError);
}

TEUCHOS_UNIT_TEST(ReferenceElement, TakesMorePointsForACurvedTetrahedron) {
  const CellBlock straight = sample::distortedSolid(Cell::Tetrahedron10), curved = sample::curvedSolid(Cell::Tetrahedron10);
  TEST_EQUALITY(stiffnessElement(straight, 0).points, 4);
  TEST_EQUALITY(stiffnessElement(curved, 0).points, 14);
}
