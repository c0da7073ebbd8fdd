#include <suture/base/Point.hpp>
#include <suture/simulation/moving/SlipHistory.hpp>

#include <algorithm>

namespace suture {

namespace {

Point tangential(const Point& vector, const Point& normal) { return minus(vector, scaled(dot(vector, normal), normal)); }

// The first zero of a gap is searched among so many parts of a step, then in one of them.
constexpr int kParts = 8;
constexpr int kBisections = 40;
// At least this part of a step follows the closing of a pair: a motion is its velocity in that part.
constexpr double kShortest = 1e-3;
constexpr double kTouching = 1e-13;  // of a gap, relative to the coordinates

/// First zero in [0, 1) of a function; the end if it is positive before.
template <typename Function>
double firstZero(const Function& function) {
  if (function(0.0) <= 0.0) return 0.0;
  double low = 0.0, high = 0.0;
  for (int k = 1; k <= kParts; ++k) {
    high = std::min(double(k) / kParts, 1.0 - kShortest);
    if (function(high) <= 0.0) break;
    low = high;
  }
  if (low == high) return high;
  for (int k = 0; k < kBisections; ++k) {
    const double middle = 0.5 * (low + high);
    (function(middle) > 0.0 ? low : high) = middle;
  }
  return high;
}

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

/// Motion of the two points of a pair in a step.
class SlipHistory::Way {
 public:
  /// Of the points that face each other at the end. \param gap  between them there
  Way(const SlipHistory& history, const ContactPair& pair, double gap, const Mesh& mesh, const MovingBodies& bodies)
      : normal_(pair.normal), gap_(gap) {
    const auto isOwn = [&](const PairEnd& end) { return end.weight * pair.ends.front().weight > 0.0; };
    const auto facing = std::find_if(pair.ends.begin(), pair.ends.end(), [&](const PairEnd& end) { return !isOwn(end); });
    fromA_ = history.before_.frameOf(pair.node()), toA_ = bodies.frameOf(pair.node());
    if (facing != pair.ends.end()) fromB_ = history.before_.frameOf(facing->node), toB_ = bodies.frameOf(facing->node);
    for (const PairEnd& end : pair.ends) {
      const Point before = history.shape_.point(end.node), now = mesh.point(end.node);
      Drawn& drawn = isOwn(end) ? onA_ : onB_;
      drawn.weight += end.weight;
      drawn.before = plus(drawn.before, scaled(end.weight, (isOwn(end) ? fromA_ : fromB_).drawnAt(before)));
      drawn.now = plus(drawn.now, scaled(end.weight, (isOwn(end) ? toA_ : toB_).drawnAt(now)));
    }
    turnA_ = turnBetween(fromA_, toA_), turnB_ = turnBetween(fromB_, toB_);
    // The part of the rotations that both have is no motion against each other: the one nearest to zero between them.
    const Point apart = minus(turnB_, turnA_);
    const double square = dot(apart, apart), part = square > 0.0 ? std::clamp(-dot(turnA_, apart) / square, 0.0, 1.0) : 0.0;
    common_ = plus(turnA_, scaled(part, apart));
    distance_ = minus(fromA_.place(), fromB_.place());
    shift_ = minus(rotated(minus(toA_.place(), toB_.place()), -1.0), distance_);
    end_ = at(1.0);
  }

  /// Vector from the point of side B to that of side A, with an obstacle the place of the point of side A, after a part of the step, seen
  /// from side B at its end. Between its ends the bodies turn and move apart at constant rates, and strains change in proportion.
  Point at(double part) const {
    const BodyFrame a = frameAfter(fromA_, turnA_, part), b = frameAfter(fromB_, turnB_, part);
    const Point distance = rotated(plus(distance_, scaled(part, shift_)), part);
    const Point fromCentre = plus(distance, minus(a.at(onA_.at(part)), a.place()));  // of side B
    const Point seen = plus(toB_.place(), toB_.turn(b.turnBack(fromCentre)));
    const Point sum = scaled(onA_.weight, seen);
    return onB_.weight == 0.0 ? sum : plus(sum, scaled(onB_.weight, toB_.at(onB_.at(part))));
  }
  /// Part of the step after which the pair closes; nearly 1 if it stays open.
  double closing() const {
    const double touching = kTouching * norm(toA_.at(onA_.at(1.0)));
    return firstZero([&](double part) { return gap_ + dot(normal_, minus(end_, at(part))) - touching; });
  }
  /// Slip after a part of the step, as long as if it had lasted for the whole one.
  Point slipAfter(double part) const {
    const BodyFrame a = frameAfter(fromA_, turnA_, part), b = frameAfter(fromB_, turnB_, part);
    const Eigen::Quaterniond turn = toA_.orientation() * a.orientation().conjugate() * b.orientation() * toB_.orientation().conjugate();
    // A rotation about the normal turns the direction of sliding; one about a tangent is rolling.
    const Point spin = scaled(dot(rotationVector(turn), normal_), normal_);
    return scaled(1.0 / (1.0 - part), endOfArc(tangential(minus(end_, at(part)), normal_), spin));
  }

 private:
  /// A point of a body, at its place on the drawn one.
  struct Drawn {
    double weight = 0.0;
    Point before{0, 0, 0}, now{0, 0, 0};  // times the weight

    Point at(double part) const { return scaled(1.0 / weight, plus(scaled(1.0 - part, before), scaled(part, now))); }
  };
  /// A frame turned about its centre.
  static BodyFrame frameAfter(BodyFrame frame, const Point& turn, double part) {
    if (part != 0.0) frame.move({0, 0, 0}, scaled(part, turn), frame.place());
    return frame;
  }
  Point rotated(const Point& vector, double part) const { return frameAfter(BodyFrame(), common_, part).turn(vector); }

  Point normal_;
  double gap_;
  BodyFrame fromA_, toA_, fromB_, toB_;
  Drawn onA_, onB_;
  Point turnA_{0, 0, 0}, turnB_{0, 0, 0}, common_{0, 0, 0}, distance_{0, 0, 0}, shift_{0, 0, 0}, end_{0, 0, 0};
};

void SlipHistory::setPast(ContactPair& pair, double gap, const Mesh& mesh, const MovingBodies& bodies) const {
  const auto found = of_.find({pair.line, pair.node()});
  if (found != of_.end()) pair.past = found->second;
  Point beside{0, 0, 0};
  for (const PairEnd& end : pair.ends)
    beside = plus(beside, scaled(end.weight, pointOf(bodies.beside().data() + Eigen::Index(end.node) * mesh.dimension, mesh.dimension)));
  const Way way(*this, pair, gap, mesh, bodies);
  pair.past.slip = minus(tangential(beside, pair.normal), way.slipAfter(wasClosed(pair) ? 0.0 : way.closing()));
}

double SlipHistory::closing(const ContactPair& pair, double gap, const Mesh& mesh, const MovingBodies& bodies) const {
  return wasClosed(pair) ? 0.0 : Way(*this, pair, gap, mesh, bodies).closing();
}

}  // namespace suture
