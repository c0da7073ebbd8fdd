#include <suture/base/Point.hpp>
#include <suture/simulation/SlipHistory.hpp>

namespace suture {

namespace {

/// Vector from the point of side B to that of side A; without a side B the place of the point of side A. \param at  place of a node
template <typename At>
Point apart(const std::vector<PairEnd>& ends, const At& at) {
  Point sum{0, 0, 0};
  for (const PairEnd& end : ends) sum = plus(sum, scaled(end.weight, at(end.node)));
  return sum;
}

Point tangential(const Point& vector, const Point& normal) { return minus(vector, scaled(dot(vector, normal), normal)); }

/// Frame of side B; null for an obstacle.
const BodyFrame* frameOfB(const std::vector<PairEnd>& ends, const MovingBodies& bodies) {
  for (const PairEnd& end : ends)
    if (end.weight < 0.0) return &bodies.frameOf(end.node);
  return nullptr;
}

}  // namespace

void SlipHistory::accept(const std::vector<ContactPair>& pairs, const std::vector<PairResult>& results, const Mesh& mesh,
                         const MovingBodies& bodies) {
  of_.clear();
  for (const PairResult& result : results) {
    if (!result.kind.restrictsSliding) continue;
    const ContactPair& pair = pairs[static_cast<std::size_t>(result.id)];
    Entry entry;
    entry.ends = pair.ends;
    const bool slides = result.state.status == PairStatus::Slip && norm(result.stepSlip()) > 0.0;
    entry.past = {{0, 0, 0}, result.past.slipped || slides, result.dissipated};
    entry.offset = tangential(apart(pair.ends, [&](int node) { return mesh.point(node); }), pair.normal);
    if (const BodyFrame* frame = frameOfB(pair.ends, bodies)) entry.offset = frame->turnBack(entry.offset);
    of_[{pair.line, pair.node()}] = std::move(entry);
  }
}

void SlipHistory::setPast(ContactPair& pair, const Mesh& mesh, const MovingBodies& bodies) const {
  const int d = mesh.dimension;
  const Point jump = apart(pair.ends, [&](int node) { return pointOf(bodies.beside().data() + Eigen::Index(node) * d, d); });
  Point slip{0, 0, 0};  // of the step, so far
  const auto found = of_.find({pair.line, pair.node()});
  if (found != of_.end()) {
    const Entry& entry = found->second;
    const BodyFrame* frame = frameOfB(entry.ends, bodies);
    const Point offset = frame ? frame->turn(entry.offset) : entry.offset;
    slip = minus(tangential(apart(entry.ends, [&](int node) { return mesh.point(node); }), pair.normal), tangential(offset, pair.normal));
    pair.past = entry.past;
  }
  pair.past.slip = minus(tangential(jump, pair.normal), slip);
}

}  // namespace suture
