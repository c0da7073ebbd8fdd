#include <suture/base/Point.hpp>
#include <suture/simulation/moving/SlipHistory.hpp>

#include <algorithm>

namespace suture {

namespace {

/// Vector from the point of side B to that of side A; with an obstacle the place of the point of side A. \param at  place of a node
template <typename At>
Point apart(const std::vector<PairEnd>& ends, const At& at) {
  Point sum{0, 0, 0};
  for (const PairEnd& end : ends) sum = plus(sum, scaled(end.weight, at(end.node)));
  return sum;
}

Point tangential(const Point& vector, const Point& normal) { return minus(vector, scaled(dot(vector, normal), normal)); }

}  // namespace

void SlipHistory::begin(const MovingBodies& bodies, const Mesh& mesh) {
  before_ = bodies;
  shape_ = mesh;
}

void SlipHistory::accept(const std::vector<ContactPair>& pairs, const std::vector<PairResult>& results) {
  of_.clear();
  for (const PairResult& result : results) {
    if (!result.kind.restrictsSliding) continue;
    const ContactPair& pair = pairs[static_cast<std::size_t>(result.id)];
    const bool slides = result.state.status == PairStatus::Slip && norm(result.stepSlip()) > 0.0;
    of_[{pair.line, pair.node()}] = {{0, 0, 0}, result.past.slipped || slides, result.dissipated};
  }
}

void SlipHistory::setPast(ContactPair& pair, const Mesh& mesh, const MovingBodies& bodies) const {
  const auto found = of_.find({pair.line, pair.node()});
  if (found != of_.end()) pair.past = found->second;
  const int d = mesh.dimension;
  const Point beside = apart(pair.ends, [&](int node) { return pointOf(bodies.beside().data() + Eigen::Index(node) * d, d); });
  Point before = apart(pair.ends, [&](int node) { return shape_.point(node); });
  Point now = apart(pair.ends, [&](int node) { return mesh.point(node); });
  const int own = pair.ends.front().node;
  const auto facing =
      std::find_if(pair.ends.begin(), pair.ends.end(), [&](const PairEnd& end) { return end.weight * pair.ends.front().weight < 0.0; });
  const BodyFrame &fromA = before_.frameOf(own), &toA = bodies.frameOf(own);
  // The motion is seen from the other side, or from an obstacle, which rests.
  BodyFrame fromB, toB;
  if (facing != pair.ends.end()) {
    fromB = before_.frameOf(facing->node), toB = bodies.frameOf(facing->node);
    before = toB.turn(fromB.turnBack(before));
  }
  // Way of the point of side A that faces B now, as if its body were rigid.
  double weight = 0.0;
  Point place{0, 0, 0};
  for (const PairEnd& end : pair.ends)
    if (end.weight * pair.ends.front().weight > 0.0) weight += end.weight, place = plus(place, scaled(end.weight, mesh.point(end.node)));
  place = scaled(1.0 / weight, place);
  const Point chord = minus(place, toB.at(fromB.drawnAt(fromA.at(toA.drawnAt(place)))));
  const Eigen::Quaterniond turn = toA.orientation() * fromA.orientation().conjugate() * fromB.orientation() * toB.orientation().conjugate();
  // A rotation about the normal turns the direction of sliding; one about a tangent is rolling.
  const Point spin = scaled(dot(rotationVector(turn), pair.normal), pair.normal);
  now = plus(now, scaled(weight, minus(endOfArc(chord, spin), chord)));
  const Point slip = tangential(minus(now, before), pair.normal);
  pair.past.slip = minus(tangential(beside, pair.normal), slip);
}

}  // namespace suture
