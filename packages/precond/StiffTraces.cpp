#include <suture/base/Collective.hpp>
#include <suture/base/Dense.hpp>
#include <suture/precond/EdgeSides.hpp>
#include <suture/precond/StiffTraces.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <random>

namespace suture {

namespace {

// Thresholds in units of the stiffness against change of shape. A trace below them multiplies the condition by about a twentieth of its
// stiffness.
constexpr double kStiff = 20.0;       // threshold for a trace of a subdomain
constexpr double kStiffOnEdge = 0.5;  // threshold for the part of it that weighting leaves on an edge
constexpr int kMostSteps = 10;

Matrix randomColumns(int rows, int columns) {
  std::mt19937 next;  // the same numbers everywhere, which std's distributions are not
  Matrix values(rows, columns);
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) values(i, j) = static_cast<double>(next()) / 4294967295.0 - 0.5;
  return values;
}

/// One side of an edge, in the edge's unknowns: the shear stiffness, and D_j^T V, the part of V that the other side's weights leave. D_i +
/// D_j = I.
Matrix sideColumns(const EdgeSide& side, const LocalProblem& local, const Matrix& traces, const Weighting& weighting) {
  const Vector squares = side.coefficients.cwiseAbs2();
  const Matrix own = rowsAt(traces, side.rows);
  Matrix weighted = Matrix::Zero(local.size(), traces.cols());
  for (int k = 0; k < own.rows(); ++k) weighted.row(side.rows[k]) = squares(k) * own.row(k);
  weighting.applyTranspose(side.local, weighted);
  Matrix all(own.rows(), 1 + own.cols());
  all.col(0) = squares.cwiseProduct(Vector(rowsAt(local.shearDiagonal(), side.rows)));
  all.rightCols(own.cols()) = side.coefficients.asDiagonal() * (own - rowsAt(weighted, side.rows));
  return all;
}

Matrix withColumns(const Matrix& rows, const std::array<Matrix, 2>& sides) {
  if (sides[0].cols() + sides[1].cols() <= 2 || sides[0].size() == 0 || sides[1].size() == 0) return rows;
  // A jump meets the stiffness of two springs in a row, half of this.
  const Vector a = sides[0].col(0), b = sides[1].col(0), scale = (2 * a.cwiseProduct(b).cwiseQuotient(a + b)).cwiseSqrt();
  Matrix columns(a.size(), sides[0].cols() + sides[1].cols() - 2);
  columns << sides[0].rightCols(sides[0].cols() - 1), sides[1].rightCols(sides[1].cols() - 1);
  columns = scale.cwiseInverse().asDiagonal() * columns;
  const Matrix known = orthonormalBasis(scale.cwiseInverse().asDiagonal() * rows.transpose(), 1e-12);
  for (int pass = 0; pass < 2; ++pass) columns -= (known * (known.transpose() * columns)).eval();
  const SingularValues svd = singularValues(columns);
  int count = 0;
  while (count < svd.values.size() && svd.values(count) * svd.values(count) > kStiffOnEdge) ++count;
  if (count == 0) return rows;
  Matrix all(a.size(), known.cols() + count);
  all << known, svd.u.leftCols(count);
  return orthonormalBasis(scale.asDiagonal() * all, 1e-12).transpose();
}

}  // namespace

Matrix stiffTraces(const LocalProblem& local) {
  const int n = local.size();
  if (local.shearDiagonal().size() == 0 || n == 0) return Matrix(n, 0);
  const Vector scale = local.shearDiagonal().cwiseSqrt();
  for (int block = std::min(8, n);; block = std::min(2 * block, n)) {
    Matrix basis = orthonormalBasis(randomColumns(n, block), 1e-12), image;
    for (int step = 0; step < kMostSteps; ++step) {
      image.resize(n, basis.cols());  // fewer than before where S has a kernel
      local.applySchur(scale.cwiseInverse().asDiagonal() * basis, image);
      image = scale.cwiseInverse().asDiagonal() * image;
      const Eigenpairs pairs = symmetricEigenpairs(basis.transpose() * image);
      const int m = static_cast<int>(pairs.values.size());
      int count = 0;
      while (count < m && pairs.values(m - 1 - count) > kStiff) ++count;
      const Vector values = pairs.values.tail(count);
      const Matrix found = basis * pairs.vectors.rightCols(count);
      const Matrix missed = image * pairs.vectors.rightCols(count) - found * values.asDiagonal();
      // The missed part couples a direction with the rest: small against the stiffness there, which is of the order of one.
      const bool settled = (missed.colwise().squaredNorm().array() < 1e-2).all() && (count > 0 || step > 2);
      if (count == m && m < n) break;  // perhaps there are more of them
      if (settled || step + 1 == kMostSteps || m == n) return scale.asDiagonal() * found * values.cwiseSqrt().asDiagonal();
      basis = orthonormalBasis(image, 1e-14);
    }
  }
}

std::vector<Matrix> StiffTraces::addedTo(std::vector<Matrix> rows, const InterfaceSpace& space, const LocalProblems& locals,
                                         const Weighting& weighting) {
  const auto incompressible = [](const auto& local) { return local && local->shearDiagonal().size() > 0; };
  const int mine = std::any_of(locals.begin(), locals.end(), incompressible);
  int any = 0;
  Teuchos::reduceAll(*space.comm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
  if (!any) return rows;
  locals_.resize(locals.size());
  traces_.resize(locals.size());
  collectively(*space.comm(), "what nearly incompressible subdomains are stiff against", [&] {
    for (std::size_t i = 0; i < locals.size(); ++i) {
      if (incompressible(locals[i]) && locals_[i] != locals[i]) traces_[i] = stiffTraces(*locals[i]);
      locals_[i] = locals[i];
    }
  });
  const auto both = exchangeEdges(space, edgeSides(space), [&](const EdgeSide& side) {
    if (!incompressible(locals[side.local])) return Matrix();
    return sideColumns(side, *locals[side.local], traces_[side.local], weighting);
  });
  collectively(*space.comm(), "edges of nearly incompressible subdomains", [&] {
    for (std::size_t e = 0; e < rows.size(); ++e) rows[e] = withColumns(rows[e], both[e]);
  });
  return rows;
}

}  // namespace suture
