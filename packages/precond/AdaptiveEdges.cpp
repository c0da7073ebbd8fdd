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

/// Three matrices over the edge's unknowns, side by side: S and T of a side, and its weights.
Matrix sideMatrices(const InterfaceSpace& space, const EdgeSide& side, const LocalProblem& local, const Matrix& schur,
                    const Weighting& weighting) {
  const int n = static_cast<int>(side.rows.size());
  std::vector<char> onEdge(local.size(), 0);
  for (const int row : side.rows) onEdge[row] = 1;
  std::vector<int> others;  // free of corners
  const std::vector<int>& places = space.coupling(side.local).columns();
  for (int row = 0; row < local.size(); ++row) {
    const InterfaceRelation* by = space.relation(places[row]);
    const bool held = by ? by->others.size() != 1 || space.isCorner(by->others[0]) : space.isCorner(places[row]);
    if (!held && !onEdge[row]) others.push_back(row);
  }
  Matrix own = pick(schur, side.rows, side.rows);
  Matrix reduced = own;
  if (!others.empty()) {
    const Matrix across = pick(schur, others, side.rows);
    reduced -= across.transpose() * solvePositive(pick(schur, others, others), across);
  }
  Matrix weights = Matrix::Zero(local.size(), n);
  for (int k = 0; k < n; ++k) weights(side.rows[k], k) = 1.0;
  weighting.apply(side.local, weights);
  Matrix all(n, 3 * n);
  const auto t = side.coefficients.asDiagonal();
  all << t * own * t, t * reduced * t, t * rowsAt(weights, side.rows) * t;
  return all;
}

/// Rows to demand, orthonormal.
Matrix chosenRows(const std::array<Matrix, 2>& sides, double threshold) {
  const int n = static_cast<int>(sides[0].rows());
  const auto part = [&](int side, int which) { return sides[side].middleCols(which * n, n); };
  const Matrix jump = part(1, 2).transpose() * part(0, 0) * part(1, 2) + part(0, 2).transpose() * part(1, 0) * part(0, 2);
  Matrix sum = part(0, 1) + part(1, 1);
  sum.diagonal().array() += 1e-13 * sum.trace() / n;  // without corners both sides may float
  const Matrix stored = part(0, 1) * solvePositive(sum, part(1, 1));
  Matrix lower;
  if (!choleskyFactor(0.5 * (jump + jump.transpose()), lower)) throw NumericalError("an edge of the interface has no stiffness");
  // The inverse problem: what the sides store may be singular, the energy of a jump is not.
  Matrix scaled = 0.5 * (stored + stored.transpose());
  lower.triangularView<Eigen::Lower>().solveInPlace(scaled);
  scaled = scaled.transpose().eval();
  lower.triangularView<Eigen::Lower>().solveInPlace(scaled);
  const Eigenpairs pairs = symmetricEigenpairs(0.5 * (scaled + scaled.transpose()));
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
  const std::vector<EdgeSide> sides = edgeSides(space);
  int last = -1;
  Matrix schur;  // of the local problem that was asked last: its sides come one after the other
  std::vector<const EdgeSide*> byLocal;
  std::vector<Matrix> own(sides.size());
  collectively(*space.comm(), "adaptive edge constraints", [&] {
    std::vector<int> order(sides.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return sides[a].local < sides[b].local; });
    for (const int k : order) {
      if (sides[k].local != last) schur = locals[sides[k].local]->schur();
      last = sides[k].local;
      own[k] = sideMatrices(space, sides[k], *locals[last], schur, weighting);
    }
  });
  const auto both = exchangeEdges(space, sides, [&](const EdgeSide& side) { return own[&side - sides.data()]; });
  std::vector<Matrix> all;
  collectively(*space.comm(), "adaptive edge constraints", [&] {
    for (const auto& edge : both) all.push_back(chosenRows(edge, threshold_));
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
