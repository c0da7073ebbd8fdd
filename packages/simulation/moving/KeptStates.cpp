#include <suture/base/Point.hpp>
#include <suture/pairs/PairFrame.hpp>
#include <suture/simulation/moving/KeptStates.hpp>

#include <algorithm>

namespace suture {

namespace {

constexpr double kOpposite = 1e-6;  // 1 + cosine of the angle between two normals that determine no rotation

/// A vector normal to `from`, after the smallest rotation that takes one unit vector to the other.
Point carried(const Point& vector, const Point& from, const Point& to) {
  const double sum = 1.0 + dot(from, to);
  return sum < kOpposite ? vector : minus(vector, scaled(dot(vector, to) / sum, plus(from, to)));
}

}  // namespace

void KeptStates::keep(const ContactPair& pair, const ContactState& state) {
  const std::vector<Point> frame = pairFrame(pair, dimension_);
  Kept kept{state, pair.normal, {0, 0, 0}};
  for (std::size_t k = 1; k < frame.size(); ++k) kept.direction = plus(kept.direction, scaled(state.direction[k], frame[k]));
  states_[{pair.line, pair.node()}] = kept;
}

PairStatus KeptStates::statusOf(const ContactPair& pair) const {
  const auto found = states_.find({pair.line, pair.node()});
  return found == states_.end() ? PairStatus::Open : found->second.state.status;
}

ContactState KeptStates::of(const ContactPair& pair) const {
  const auto found = states_.find({pair.line, pair.node()});
  if (found == states_.end()) return {};
  ContactState state = found->second.state;
  const Point direction = carried(found->second.direction, found->second.normal, pair.normal);
  const double size = norm(direction);
  state.direction = {0, 0, 0};
  if (size == 0.0) return state;
  const std::vector<Point> frame = pairFrame(pair, dimension_);
  for (std::size_t k = 1; k < frame.size(); ++k) state.direction[k] = dot(direction, frame[k]) / size;
  return state;
}

bool KeptStates::anyClosed() const {
  return std::any_of(states_.begin(), states_.end(), [](const auto& one) { return one.second.state.closed(); });
}

}  // namespace suture
