#include <suture/base/Point.hpp>
#include <suture/simulation/moving/SlipHistory.hpp>

#include <cmath>

namespace suture {

namespace {

Point tangential(const Point& vector, const Point& normal) { return minus(vector, scaled(dot(vector, normal), normal)); }

}  // namespace

void SlipHistory::begin(const MovingBodies& bodies, const Mesh& mesh) {
  before_ = bodies;
  shape_ = mesh;
}

void SlipHistory::accept(const std::vector<ContactPair>& pairs, const std::vector<PairResult>& results) {
  of_.clear();
  closed_.clear();
  for (const PairResult& result : results) {
    if (!result.kind.restrictsSliding) continue;
    const ContactPair& pair = pairs[static_cast<std::size_t>(result.id)];
    const bool slides = result.state.status == PairStatus::Slip && norm(result.stepSlip()) > 0.0;
    of_[{pair.line, pair.node()}] = {{0, 0, 0}, result.past.slipped || slides, result.dissipated};
    if (result.state.closed()) closed_.insert({pair.line, pair.node()});
  }
}

RelativeMotion SlipHistory::motionOf(const ContactPair& pair, const Mesh& mesh, const MovingBodies& bodies) const {
  const int own = pair.node();
  MovedNodes a, b;  // an obstacle rests
  a.from = before_.frameOf(own), a.to = bodies.frameOf(own);
  if (pair.own < static_cast<int>(pair.ends.size()))
    b.from = before_.frameOf(pair.ends.back().node), b.to = bodies.frameOf(pair.ends.back().node);
  for (std::size_t i = 0; i < pair.ends.size(); ++i) {
    const PairEnd& end = pair.ends[i];
    MovedNodes& nodes = static_cast<int>(i) < pair.own ? a : b;
    nodes.add(end.weight, nodes.from.drawnAt(shape_.point(end.node)), nodes.to.drawnAt(mesh.point(end.node)));
  }
  return {a, b};
}

void SlipHistory::setPast(ContactPair& pair, double gap, const Mesh& mesh, const MovingBodies& bodies) const {
  const auto found = of_.find({pair.line, pair.node()});
  if (found != of_.end()) pair.past = found->second;
  Point beside{0, 0, 0};
  for (const PairEnd& end : pair.ends)
    beside = plus(beside, scaled(end.weight, pointOf(bodies.beside().data() + Eigen::Index(end.node) * mesh.dimension, mesh.dimension)));
  const RelativeMotion motion = motionOf(pair, mesh, bodies);
  const Point slip = motion.slipAfter(wasClosed(pair) ? 0.0 : motion.closing(pair.normal, gap), pair.normal);
  pair.past.slip = minus(tangential(beside, pair.normal), slip);
}

double SlipHistory::closing(const ContactPair& pair, double gap, const Mesh& mesh, const MovingBodies& bodies) const {
  return wasClosed(pair) ? 0.0 : motionOf(pair, mesh, bodies).closing(pair.normal, gap);
}

}  // namespace suture
