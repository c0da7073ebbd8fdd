#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/search/StabilisingPairs.hpp>

namespace suture {

namespace {

constexpr double kNoWorkOfPairs = 1e-11;  // work of forces in a motion that counts as zero, relative to the largest force
constexpr double kHeldBySpring = 0.1;  // displacement along a tangent, relative to the motion, above which a spring there holds the motion
constexpr double kOpenPair = 1e-3;     // preference of open pairs: closed ones hold a body where it is
constexpr double kInVain = 1e-2;       // preference of pairs whose states were contradicted

}  // namespace

/// True if neither loads nor slipping pairs do work in free motions: the position of bodies along them is arbitrary.
bool StabilisingPairs::isNeutral(const PairStates& next, const Matrix& free, double largest) const {
  const RigidBodyModel::Pairs& data = rigid_.data();
  if (projection_.isFrictionless())
    return ((free.transpose() * data.work).cwiseAbs().array() <=
            kNoWorkOfPairs * (free.cwiseAbs().transpose() * data.work.cwiseAbs()).array())
        .all();
  if ((free.transpose() * data.work).cwiseAbs().maxCoeff() > kNoWorkOfPairs * largest) return false;
  for (std::size_t i = 0; i < next.size(); ++i) {
    if (!data.canChange[i] || next[i].status != PairStatus::Slip || !projection_.restrictsSliding(i)) continue;
    for (const SparseRows& tangent : data.tangents)
      if ((tangent.row(static_cast<Eigen::Index>(i)) * free).norm() > kDependentRows) return false;
  }
  return true;
}

/// Adds springs along tangents of open pairs, one per free motion.
void StabilisingPairs::addSprings(PairStates& next, Matrix free) const {
  const RigidBodyModel::Pairs& data = rigid_.data();
  while (free.cols() > 0) {
    double most = kHeldBySpring;
    std::size_t best = next.size();
    Matrix bestWay;
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (!data.canChange[i] || next[i].closed() || next[i].transverseStiffness > 0.0 || !projection_.restrictsSliding(i) ||
          !(projection_.tangentialStiffness(i) > 0.0))
        continue;
      Matrix way(static_cast<Eigen::Index>(data.tangents.size()), free.cols());
      for (Eigen::Index k = 0; k < way.rows(); ++k)
        way.row(k) = data.tangents[static_cast<std::size_t>(k)].row(static_cast<Eigen::Index>(i)) * free;
      if (const double size = way.norm(); size > most) most = size, best = i, bestWay = way;
    }
    if (best == next.size()) return;
    const Eigenpairs axes = symmetricEigenpairs(bestWay * bestWay.transpose());
    const Vector along = axes.vectors.rightCols(1);
    ContactState& state = next[best];
    state.direction = {0.0, along.size() == 2 ? along(1) : 0.0, -along(0)};  // acrossSlip() is the tangent
    state.transverseStiffness = projection_.tangentialStiffness(best);
    free = (free * nullSpace(along.transpose() * bestWay, kDependentRows)).eval();
  }
}

/// Lets open or sliding pairs stick until no motion is free.
void StabilisingPairs::tie(PairStates& next, Matrix free, const std::vector<int>& inVain) const {
  const RigidBodyModel::Pairs& data = rigid_.data();
  std::vector<char> isInVain(next.size(), 0);
  for (const int i : inVain) isInVain[static_cast<std::size_t>(i)] = 1;
  while (free.cols() > 0) {
    double most = kDependentRows;
    std::size_t best = next.size();
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (!data.canChange[i]) continue;
      const auto at = static_cast<Eigen::Index>(i);
      double size = next[i].closed() ? 0.0 : (data.rows.row(at) * free).norm();
      if (next[i].status != PairStatus::Stick && projection_.restrictsSliding(i))
        for (const SparseRows& tangent : data.tangents) size = std::max(size, (tangent.row(at) * free).norm());
      if (!next[i].closed()) size *= kOpenPair;
      if (isInVain[i]) size *= kInVain;
      if (size > most) most = size, best = i;
    }
    if (best == next.size()) break;
    next[best].status = projection_.restrictsSliding(best) ? PairStatus::Stick : PairStatus::Slip;
    next[best].direction = {0, 0, 0};
    next[best].transverseStiffness = 0.0;
    const Matrix now = rigid_.loose(next);
    if (now.cols() >= free.cols()) break;
    free = now;
  }
}

PairStates StabilisingPairs::addedTo(PairStates next, double largest, const std::vector<int>& inVain) const {
  for (ContactState& state : next)
    if (!state.closed()) state = PairStatus::Open;
  Matrix free = rigid_.loose(next);
  if (free.cols() > 0 && isNeutral(next, free, largest)) {
    if (projection_.isFrictionless()) return next;
    addSprings(next, free);
    free = rigid_.loose(next);
  }
  tie(next, std::move(free), inVain);
  return next;
}

}  // namespace suture
