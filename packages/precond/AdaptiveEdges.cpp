#include <suture/base/Collective.hpp>
#include <suture/base/Dense.hpp>
#include <suture/precond/AdaptiveEdges.hpp>
#include <suture/precond/EdgeSides.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <sstream>

namespace suture {

namespace {

constexpr double kMostOfInterface = 0.5;  // beyond this a direct solver of the interface is meant

/// matrix^+ rhs, for a right-hand side that the kernel does not feel: by a shift that rounding hides. Where that of the matrix itself is
/// larger (a Schur complement of a nearly incompressible body is a small difference of large terms) the shift is what it takes.
Matrix solveSemidefinite(const Matrix& matrix, const Matrix& rhs) {
  for (double shift = 1e-12; shift < 1e-4; shift *= 10) {
    Matrix shifted = matrix, lower;
    shifted.diagonal() *= 1.0 + shift;
    if (!choleskyFactor(shifted, lower)) continue;
    Matrix solution = lower.triangularView<Eigen::Lower>().solve(rhs);
    lower.transpose().triangularView<Eigen::Upper>().solveInPlace(solution);
    return solution;
  }
  throw NumericalError("the stiffness of an edge of the interface is not positive semidefinite");
}

/// Over the edge's n unknowns and its c corners, side by side: the Schur complement T of a side onto both, and, in the first n rows, the
/// edge's block of S and its weights.
Matrix sideMatrices(const EdgeSide& side, const LocalProblem& local, const Matrix& schur, const Weighting& weighting) {
  const int n = static_cast<int>(side.rows.size()), c = static_cast<int>(side.cornerRows.size());
  std::vector<int> kept = side.rows;
  kept.insert(kept.end(), side.cornerRows.begin(), side.cornerRows.end());
  std::vector<int> sorted = kept;
  std::sort(sorted.begin(), sorted.end());
  const std::vector<int> others = complement(local.size(), sorted);
  Vector coefficients(n + c);
  coefficients << side.coefficients, side.cornerCoefficients;
  Matrix reduced = pick(schur, kept, kept);
  if (!others.empty()) {
    const Matrix across = pick(schur, others, kept);
    // Contact edges hold one component only: the motions left free are a kernel that `across` does not feel.
    reduced -= across.transpose() * solveSemidefinite(pick(schur, others, others), across);
  }
  Matrix weights = Matrix::Zero(local.size(), n);
  for (int k = 0; k < n; ++k) weights(side.rows[k], k) = 1.0;
  weighting.apply(side.local, weights);
  Matrix all = Matrix::Zero(n + c, 3 * n + c);
  const auto t = side.coefficients.asDiagonal();
  all.leftCols(n + c) = coefficients.asDiagonal() * reduced * coefficients.asDiagonal();
  all.block(0, n + c, n, n) = t * pick(schur, side.rows, side.rows) * t;
  all.block(0, 2 * n + c, n, n) = t * rowsAt(weights, side.rows) * t;
  return all;
}

/// Rows to demand of an edge of n unknowns, orthonormal. Where a side does not take part there is no jump: none.
Matrix chosenRows(const std::array<Matrix, 2>& sides, int n, double threshold) {
  if (sides[0].size() == 0 || sides[1].size() == 0) return Matrix(0, n);
  if (sides[0].rows() != sides[1].rows() || sides[0].cols() != sides[1].cols())
    throw InternalError("the two sides of an edge of the interface differ in their corners");
  const int all = static_cast<int>(sides[0].rows());
  const auto stored = [&](int side) { return sides[side].leftCols(all); };
  const auto block = [&](int side) { return sides[side].block(0, all, n, n); };
  const auto weights = [&](int side) { return sides[side].block(0, all + n, n, n); };
  const Matrix jump = weights(1).transpose() * block(0) * weights(1) + weights(0).transpose() * block(1) * weights(0);
  // Least energy of two traces with a given jump that vanishes at the corners. Rigid motions of both together are free.
  Matrix least = (stored(0) * solveSemidefinite(stored(0) + stored(1), stored(1))).topLeftCorner(n, n);
  Matrix lower;
  if (!choleskyFactor(0.5 * (jump + jump.transpose()), lower)) throw NumericalError("an edge of the interface has no stiffness");
  // The inverse problem: the stored energy may vanish, that of a jump does not.
  least = 0.5 * (least + least.transpose()).eval();
  lower.triangularView<Eigen::Lower>().solveInPlace(least);
  least = least.transpose().eval();
  lower.triangularView<Eigen::Lower>().solveInPlace(least);
  const Eigenpairs pairs = symmetricEigenpairs(0.5 * (least + least.transpose()));
  int count = 0;
  while (count < n && pairs.values(count) * threshold < 1.0) ++count;
  return orthonormalBasis(lower * pairs.vectors.leftCols(count), 1e-12).transpose();
}

}  // namespace

Schema AdaptiveEdges::schema() {
  Schema schema("Eigenvectors of each edge's generalised problem, chosen by what they would cost: for jumps that no partition follows.");
  schema.real("Threshold", 5.0, "Eigenvectors whose value is above become constraints; the condition stays below a multiple of it.",
              {1.0, 1e12, true, false, {}});
  return schema;
}

std::vector<Matrix> AdaptiveEdges::rows(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const {
  std::vector<EdgeSide> sides = edgeSides(space);
  keepCommonCorners(space, sides);
  int last = -1;
  Matrix schur;  // schur complement of the last local problem: its sides come one after the other
  std::vector<Matrix> own(sides.size());
  collectively(*space.comm(), "adaptive edge constraints", [&] {
    std::vector<int> order(sides.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return sides[a].local < sides[b].local; });
    for (const int k : order) {
      if (!locals[sides[k].local]) continue;  // does not take part
      if (sides[k].local != last) schur = locals[sides[k].local]->schur();
      last = sides[k].local;
      own[k] = sideMatrices(sides[k], *locals[last], schur, weighting);
    }
  });
  const auto both = exchangeEdges(space, sides, [&](const EdgeSide& side) { return own[&side - sides.data()]; });
  std::vector<Matrix> all;
  collectively(*space.comm(), "adaptive edge constraints", [&] {
    for (std::size_t e = 0; e < both.size(); ++e)
      all.push_back(chosenRows(both[e], static_cast<int>(space.edges()[e].unknowns.size()), threshold_));
  });

  // An edge counts where its first side lives.
  double mine[2] = {0.0, 0.0}, sums[2];
  for (const EdgeSide& side : sides)
    if (side.side == 0) {
      mine[0] += static_cast<double>(all[side.edge].rows());
      mine[1] += static_cast<double>(all[side.edge].cols());
    }
  Teuchos::reduceAll(*space.comm(), Teuchos::REDUCE_SUM, 2, mine, sums);
  if (sums[1] >= 100.0 && sums[0] > kMostOfInterface * sums[1]) {
    std::ostringstream text;
    text << "a threshold of " << threshold_ << " makes constraints of " << sums[0] << " of the " << sums[1]
         << " unknowns on edges: the coarse problem would be as large as the interface. Thresholds of 3 to 100 are useful";
    throw InputError("Preconditioner/BDDC/Adaptive/Threshold", text.str());
  }
  return all;
}

}  // namespace suture
