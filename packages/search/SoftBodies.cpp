#include <suture/algebra/SparseNullSpace.hpp>
#include <suture/search/PadModel.hpp>
#include <suture/search/SoftBodies.hpp>
#include <suture/search/UnilateralFoundation.hpp>

#include <vector>

namespace suture {

RigidBodyModel::Equilibrium SoftBodies::project(const Vector& t, const Vector& compliance, Vector& reached) const {
  const RigidBodyModel::Pairs& data = rigid_.data();
  const Eigen::Index pairs = t.size(), motions = data.work.size();
  std::vector<Eigen::Index> sprung;
  for (Eigen::Index k = 0; k < motions; ++k)
    if (springs_(k) > 0.0) sprung.push_back(k);
  // A spring is two opposite pads that touch.
  const auto count = pairs + 2 * static_cast<Eigen::Index>(sprung.size());
  std::vector<Eigen::Triplet<double, int>> entries;
  for (int i = 0; i < static_cast<int>(pairs); ++i)
    for (SparseRows::InnerIterator entry(data.rows, i); entry; ++entry)
      entries.emplace_back(i, static_cast<int>(entry.col()), entry.value());
  Vector y = Vector::Zero(count), stiffness = Vector::Zero(count);
  y.head(pairs) = t;
  for (Eigen::Index i = 0; i < pairs; ++i)
    if (data.canChange[static_cast<std::size_t>(i)]) stiffness(i) = 1.0 / compliance(i);
  for (std::size_t s = 0; s < sprung.size(); ++s)
    for (const int sense : {0, 1}) {
      const Eigen::Index row = pairs + 2 * static_cast<Eigen::Index>(s) + sense;
      entries.emplace_back(static_cast<int>(row), static_cast<int>(sprung[s]), sense == 0 ? 1.0 : -1.0);
      stiffness(row) = springs_(sprung[s]);
    }
  SparseRows rows(count, motions);
  rows.setFromTriplets(entries.begin(), entries.end());
  RigidBodyModel::Equilibrium result;
  result.motion = Vector::Zero(motions);
  if (motions <= kMostDense) {
    result.found = UnilateralFoundation(Matrix(rows), stiffness, data.work, data.work.norm()).solve(result.motion, y);
  } else {
    const Vector soft = stiffness.unaryExpr([](double k) { return k > 0.0 ? 1.0 / k : 1e300; });
    const PadModel::Equilibrium pads = PadModel::unilateral(rows, data.work, y, soft);
    result.found = pads.found;
    result.motion = pads.motion;
    y = pads.trial.col(0).cwiseProduct(soft);
  }
  reached = y.head(pairs);
  result.force = reached.cwiseMax(0.0).cwiseProduct(stiffness.head(pairs));
  return result;
}

}  // namespace suture
