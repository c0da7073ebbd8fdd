#include <suture/algebra/DisjointSets.hpp>
#include <suture/algebra/SparseNullSpace.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/algebra/dense/NonnegativeLeastSquares.hpp>
#include <suture/answer/solvability/SharedForces.hpp>

#include <algorithm>
#include <map>

namespace suture {

namespace {

constexpr double kRemainder = 1e-10;  // fraction of the largest column that remains of an independent column
constexpr double kNoPart = 1e-9;      // amplitude, relative to the largest of a combination, that counts as zero
constexpr int kCuts = 100;  // maximum number of rounds of half spaces; those of a cone in 3D converge quadratically, in 2D each is exact

}  // namespace

std::vector<SharedForces> sharedForces(const std::vector<ForceColumn>& columns) {
  std::map<GlobalId, int> rows;
  std::vector<Eigen::Triplet<double, int>> entries;
  const int count = static_cast<int>(columns.size());
  for (int k = 0; k < count; ++k)
    for (const auto& [unknown, value] : columns[k].entries)
      entries.emplace_back(rows.emplace(unknown, static_cast<int>(rows.size())).first->second, k, value);
  SparseMatrix matrix(static_cast<Eigen::Index>(rows.size()), count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  double largest = 0.0;
  for (int k = 0; k < count; ++k) largest = std::max(largest, matrix.col(k).norm());
  Matrix all = sparseNullBasis(matrix, kRemainder * largest);
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
