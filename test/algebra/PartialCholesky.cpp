// Dense steps of a front against their definition, entry by entry.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/algebra/elimination/PartialCholesky.hpp>
#include <suture/base/Types.hpp>

#include <algebra/SaddleProblem.hpp>
#include <cmath>
#include <limits>

namespace suture {
namespace {

// The first columns of a matrix with a dominant diagonal, stored with a leading dimension above their length.
struct Trapezoid {
  Matrix whole, values;
  Trapezoid(int columns, int rows) : whole(random(rows, rows)), values(Matrix::Constant(rows + 3, columns, 7.0)) {
    values.topRows(rows) = whole.leftCols(columns);
  }
  static Matrix random(int rows, int columns) {
    Matrix all = saddle::random(rows, columns, 5);
    all = (all + all.transpose()).eval();
    all.diagonal().array() += 2.0 * rows;
    return all;
  }
};

TEUCHOS_UNIT_TEST(PartialCholesky, FactorsTheTriangleAndTheRowsBelow) {
  for (const int columns : {1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 40, 65, 97, 210})
    for (const int below : {0, 1, 5, 8, 9, 40}) {
      const int rows = columns + below;
      Trapezoid t(columns, rows);
      const int failed = partialCholesky(columns, rows, t.values.data(), int(t.values.rows()));
      TEST_EQUALITY(failed, 0);
      Matrix l = t.values.topRows(rows);
      l.triangularView<Eigen::StrictlyUpper>().setZero();
      // L L^T is the matrix in these columns
      const Matrix product = l * l.topRows(columns).transpose(), expected = t.whole.leftCols(columns);
      TEST_COMPARE((product - expected).cwiseAbs().maxCoeff(), <, 1e-15 * rows * rows);
      TEST_ASSERT((t.values.bottomRows(3).array() == 7.0).all());
    }
}

TEUCHOS_UNIT_TEST(PartialCholesky, ReportsThePivotThatIsNotPositive) {
  for (const int columns : {1, 9, 30})
    for (const int bad : {0, columns / 2, columns - 1})
      for (const double value : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        Matrix a = Matrix::Identity(columns + 4, columns);
        a(bad, bad) = value;
        const int failed = partialCholesky(columns, columns + 4, a.data(), columns + 4);
        TEST_EQUALITY(failed, bad + 1);
      }
}

TEUCHOS_UNIT_TEST(PartialCholesky, SubtractsTheSquareFromTheLowerTriangle) {
  for (const int rows : {1, 7, 23, 24, 25, 60, 100})
    for (const int columns : {1, 6, 30})
      for (const double share : {0.0, 1.0}) {
        const Matrix panel = saddle::random(rows + 2, columns, 3), before = saddle::random(rows + 1, rows, 4);
        // Entries that are not needed are not read.
        Matrix target = share == 0.0 ? Matrix(Matrix::Constant(rows + 1, rows, std::numeric_limits<double>::quiet_NaN())) : before;
        symmetricRankUpdate(rows, columns, panel.data(), rows + 2, share, target.data(), rows + 1);
        const Matrix square = panel.topRows(rows) * panel.topRows(rows).transpose();
        for (int j = 0; j < rows; ++j)
          for (int i = j; i < rows; ++i) {
            const double expected = (share == 0.0 ? 0.0 : before(i, j)) - square(i, j);
            TEST_ASSERT(std::abs(target(i, j) - expected) < 1e-15 * (columns + 1) * 4);
          }
        if (share != 0.0) TEST_ASSERT(target.row(rows) == before.row(rows));
      }
}

}  // namespace
}  // namespace suture
