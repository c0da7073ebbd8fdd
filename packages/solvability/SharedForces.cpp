#include <suture/algebra/DisjointSets.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/algebra/dense/NonnegativeLeastSquares.hpp>
#include <suture/solvability/SharedForces.hpp>

#include <Eigen/SparseCore>
#include <Eigen/SparseQR>

#include <algorithm>
#include <map>

namespace suture {

namespace {

constexpr double kRemainder = 1e-10;  // fraction of the largest column that remains of an independent column
constexpr double kNoPart = 1e-9;      // amplitude, relative to the largest of a combination, that counts as zero
constexpr int kCuts = 100;  // maximum number of rounds of half spaces; those of a cone in 3D converge quadratically, in 2D each is exact

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Basis (columns) of the combinations of columns that vanish: not orthonormal, mostly sparse.
Matrix vanishing(const SparseMatrix& matrix) {
  double largest = 0.0;
  for (int k = 0; k < matrix.outerSize(); ++k) largest = std::max(largest, matrix.col(k).norm());
  const int count = static_cast<int>(matrix.cols());
  if (largest == 0.0) return Matrix::Identity(count, count);
  Eigen::SparseQR<SparseMatrix, Eigen::COLAMDOrdering<int>> qr;
  qr.setPivotThreshold(kRemainder * largest);
  qr.compute(matrix);
  const int rank = static_cast<int>(qr.rank()), left = count - rank;
  if (left == 0) return Matrix(count, 0);
  const SparseMatrix upper = qr.matrixR();
  Matrix all = Matrix::Zero(count, left);
  const Matrix rest = Matrix(upper.rightCols(left)).topRows(rank);
  all.topRows(rank) = -SparseMatrix(upper.topLeftCorner(rank, rank)).triangularView<Eigen::Upper>().solve(rest);
  all.bottomRows(left).setIdentity();
  return qr.colsPermutation() * all;
}

}  // namespace

std::vector<SharedForces> sharedForces(const std::vector<ForceColumn>& columns) {
  std::map<GlobalId, int> rows;
  std::vector<Eigen::Triplet<double>> entries;
  const int count = static_cast<int>(columns.size());
  for (int k = 0; k < count; ++k)
    for (const auto& [unknown, value] : columns[k].entries)
      entries.emplace_back(rows.emplace(unknown, static_cast<int>(rows.size())).first->second, k, value);
  // The decomposition needs at least as many rows as columns.
  SparseMatrix matrix(std::max(static_cast<int>(rows.size()), count), count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  matrix.makeCompressed();
  Matrix all = vanishing(matrix);
  if (all.cols() == 0) return {};

  std::map<int, int> first;  // first column of each pair
  DisjointSets parts(count);
  for (int k = 0; k < count; ++k) parts.join(first.emplace(columns[k].pair, k).first->second, k);
  for (Eigen::Index c = 0; c < all.cols(); ++c) {
    const double size = all.col(c).cwiseAbs().maxCoeff();
    int before = -1;
    for (int k = 0; k < count; ++k) {
      if (std::abs(all(k, c)) <= kNoPart * size) {
        all(k, c) = 0.0;
        continue;
      }
      if (before >= 0) parts.join(before, k);
      before = k;
    }
  }
  std::map<int, std::pair<std::vector<int>, std::vector<int>>> members;  // columns, combinations
  for (Eigen::Index c = 0; c < all.cols(); ++c) {
    Eigen::Index at = 0;
    all.col(c).cwiseAbs().maxCoeff(&at);
    members[parts.lowest(static_cast<int>(at))].second.push_back(static_cast<int>(c));
  }
  for (int k = 0; k < count; ++k)
    if (const auto part = members.find(parts.lowest(k)); part != members.end()) part->second.first.push_back(k);
  std::vector<SharedForces> shared;
  for (const auto& [number, both] : members) shared.push_back({both.first, orthonormalBasis(all(both.first, both.second), kRemainder)});
  return shared;
}

Vector leastAmplitudes(const SharedForces& shared, const Vector& amplitudes,
                       const std::function<std::vector<ForceCut>(const Vector& amplitudes)>& violated) {
  const Vector given = shared.basis.transpose() * amplitudes;
  const Vector determined = amplitudes - shared.basis * given;
  Matrix rows(0, given.size());
  Vector bounds;
  Vector least = determined;
  for (int round = 0; round < kCuts; ++round) {
    const std::vector<ForceCut> cuts = violated(least);
    if (cuts.empty()) return least;
    const Eigen::Index before = rows.rows();
    rows.conservativeResize(before + Eigen::Index(cuts.size()), Eigen::NoChange);
    bounds.conservativeResize(rows.rows());
    for (std::size_t c = 0; c < cuts.size(); ++c) {
      const Eigen::Index row = before + Eigen::Index(c);
      rows.row(row).setZero();
      bounds(row) = cuts[c].bound;
      for (const auto& [place, value] : cuts[c].normal) {
        rows.row(row) += value * shared.basis.row(place);
        bounds(row) -= value * determined(place);
      }
      bounds(row) = std::min(bounds(row), rows.row(row).dot(given));
    }
    least = determined + shared.basis * leastDistance(rows, bounds);
  }
  return least;
}

}  // namespace suture
