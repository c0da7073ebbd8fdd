// Biorthogonal functions against known closed forms.
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Matrices.hpp>
#include <suture/mesh/GaussRule.hpp>
#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/pairs/mortar/DualBasis.hpp>

#include <cmath>

using namespace suture;
using matrices::rows;

namespace {

/// Shape functions of a line's side at the points of a quadrature over a part of it.
struct Part {
  Matrix shapes;
  Vector weights;
};
Part part(int nodes, double begin, double end, int points = 4) {
  const LineRule rule = gaussRule(points);
  Part result{Matrix(nodes, points), Vector(points)};
  for (int q = 0; q < points; ++q) {
    const SideShape shape = sideShape(nodes, (begin + end) / 2 + (end - begin) / 2 * rule.points(q));
    for (int i = 0; i < nodes; ++i) result.shapes(i, q) = shape.value[i];
    result.weights(q) = rule.weights(q) * (end - begin) / 2;
  }
  return result;
}

/// The psi as combinations of shape functions, one per row.
Matrix coefficients(const DualBasis& basis, int functions) {
  Matrix all(functions, functions);
  for (int k = 0; k < functions; ++k) all.col(k) = basis.at(Vector::Unit(functions, k));
  return all;
}

}  // namespace

TEUCHOS_UNIT_TEST(DualBasis, HasTheKnownFunctionsOfWholeLines) {
  const Part linear = part(2, -1, 1), quadratic = part(3, -1, 1);
  TEST_COMPARE((coefficients(DualBasis(linear.shapes, linear.weights), 2) - rows({{2, -1}, {-1, 2}})).norm(), <, 1e-14);
  TEST_COMPARE(
      (coefficients(DualBasis(quadratic.shapes, quadratic.weights), 3) - rows({{1.5, 0.5, -0.25}, {0.5, 1.5, -0.25}, {-1, -1, 1.5}}))
          .norm(),
      <, 1e-13);
}

// The middles of a triangle's edges integrate quadratic functions exactly, 2 x 2 Gauss points bilinear squares.
TEUCHOS_UNIT_TEST(DualBasis, HasTheKnownFunctionsOfTrianglesAndQuadrilaterals) {
  const Matrix triangle = rows({{0.5, 0, 0.5}, {0.5, 0.5, 0}, {0, 0.5, 0.5}});
  TEST_COMPARE((coefficients(DualBasis(triangle, Vector::Constant(3, 0.7)), 3) - rows({{3, -1, -1}, {-1, 3, -1}, {-1, -1, 3}})).norm(), <,
               1e-14);
  const double g = 1 / std::sqrt(3.0);
  Matrix square(4, 4);
  const double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (int q = 0; q < 4; ++q)
    for (int i = 0; i < 4; ++i) square(i, q) = (1 + corner[i][0] * corner[q][0] * g) * (1 + corner[i][1] * corner[q][1] * g) / 4;
  TEST_COMPARE((coefficients(DualBasis(square, Vector::Constant(4, 0.3)), 4) -
                rows({{4, -2, 1, -2}, {-2, 4, -2, 1}, {1, -2, 4, -2}, {-2, 1, -2, 4}}))
                   .norm(),
               <, 1e-13);
}

// int psi_j chi_k = delta_jk int chi_k over the part alone, by an independent quadrature; the psi add up to one.
TEUCHOS_UNIT_TEST(DualBasis, IsBiorthogonalOverAPartOfASide) {
  for (const int nodes : {2, 3})
    for (const double end : {-0.9, -0.2, 0.4}) {
      const Part own = part(nodes, -1, end), other = part(nodes, -1, end, 9);
      const DualBasis basis(own.shapes, own.weights);
      Matrix product = Matrix::Zero(nodes, nodes);
      Vector integral = Vector::Zero(nodes);
      for (Eigen::Index q = 0; q < other.weights.size(); ++q) {
        const Vector psi = basis.at(other.shapes.col(q));
        TEST_FLOATING_EQUALITY(psi.sum(), 1.0, 1e-8);
        product += other.weights(q) * psi * other.shapes.col(q).transpose();
        integral += other.weights(q) * other.shapes.col(q);
      }
      TEST_COMPARE((product - Matrix(integral.asDiagonal())).norm(), <, 1e-8);
    }
}
