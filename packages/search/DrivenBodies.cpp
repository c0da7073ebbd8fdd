#include <suture/search/DrivenBodies.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

namespace {

constexpr std::size_t kMeetings = 20;    // maximum number of states to which bodies are moved
constexpr double kLeastWay = 1e-2;       // first displacement tried, relative to the shortest one after which something may change
constexpr double kMostWay = 1e3;         // last displacement tried, relative to the longest such one
constexpr double kNoWorkDriven = 1e-11;  // excess of the loads that counts as zero, relative to the sum of its parts

}  // namespace

/// Unit motion along the excess of the loads over the forces of `next`; empty: there is no excess.
Vector DrivenBodies::motion(const ContactBalance& balance, const PairStates& next, const Matrix& free) const {
  const RigidBodyModel::Pairs& data = rigid_.data();
  Vector beyond = Vector::Zero(rigid_.motions()), parts = beyond;
  const auto add = [&](double force, const SparseRows& rows, Eigen::Index pair) {
    for (SparseRows::InnerIterator entry(rows, pair); entry; ++entry) {
      beyond(entry.col()) += force * entry.value();
      parts(entry.col()) += std::abs(force * entry.value());
    }
  };
  for (std::size_t i = 0; i < next.size(); ++i) {
    if (!data.canChange[i]) continue;
    const auto at = static_cast<Eigen::Index>(i);
    const ContactState& state = next[i];
    if (!state.closed()) add(balance.force(at, 0), data.rows, at);
    for (std::size_t k = 0; k < data.tangents.size(); ++k) {
      const auto component = static_cast<Eigen::Index>(k + 1);
      const double allowed = !state.closed() ? 0.0
                             : state.status == PairStatus::Stick && projection_.restrictsSliding(i)
                                 ? balance.force(at, component)
                                 : state.largest(balance.force(at, 0)) * state.direction[k + 1];
      add(balance.force(at, component) - allowed, data.tangents[k], at);
    }
  }
  const Vector motion = free * (free.transpose() * beyond);
  return motion.norm() > kNoWorkDriven * parts.norm() ? Vector(motion.normalized()) : Vector();
}

bool DrivenBodies::advance(const PairStates& now, const ContactBalance& balance, const PairStates& next, double largest,
                           const std::vector<int>& inVain, PairStates& found) {
  const RigidBodyModel::Pairs& data = rigid_.data();
  const Matrix free = rigid_.loose(next);
  if (free.cols() == 0) return false;
  const Vector motion = this->motion(balance, next, free);
  if (motion.size() == 0) return false;
  Matrix way = Matrix::Zero(balance.jump.rows(), 3);
  way.col(0) = data.rows * motion;
  for (std::size_t k = 0; k < data.tangents.size(); ++k) way.col(static_cast<Eigen::Index>(k + 1)) = data.tangents[k] * motion;
  double least = std::numeric_limits<double>::infinity(), most = 0.0;  // displacements after which something may change
  for (std::size_t i = 0; i < next.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (!data.canChange[i] || !(way.row(at).norm() > kDependentRows)) continue;
    const double length = now[i].closed() ? balance.force.row(at).norm() / data.stiffness(at) : std::abs(balance.jump(at, 0));
    if (length > 0.0) least = std::min(least, length);
    most = std::max(most, length);
  }
  for (double length = kLeastWay * least; length <= kMostWay * most; length *= 2.0) {
    found = projection_.states(now, balance.force, balance.jump + length * way);
    if (rigid_.loose(found).cols() >= free.cols()) continue;
    found = stabilising_.addedTo(std::move(found), largest, inVain);
    if (std::find(met_.begin(), met_.end(), found) != met_.end()) continue;
    met_.push_back(found);
    return met_.size() <= kMeetings;
  }
  return false;
}

}  // namespace suture
