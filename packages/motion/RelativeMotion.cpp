#include <suture/base/Point.hpp>
#include <suture/motion/RelativeMotion.hpp>

#include <algorithm>

namespace suture {

namespace {

// The first zero of a gap is searched among so many parts of a step, then in one of them by bisection to round-off.
constexpr int kParts = 8;
constexpr int kBisections = 40;
// At least this part of a step follows the closing of a gap: a motion is divided by it.
constexpr double kShortest = 1e-3;
constexpr double kTouching = 1e-13;  // gap that is closed, relative to the coordinates: round-off

Point tangential(const Point& vector, const Point& normal) { return minus(vector, scaled(dot(vector, normal), normal)); }

/// A frame turned about its place.
BodyFrame turned(BodyFrame frame, const Point& rotation) {
  frame.move({0, 0, 0}, rotation, frame.place());
  return frame;
}

Point rotated(const Point& vector, const Point& rotation) { return turned(BodyFrame(), rotation).turn(vector); }

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

void MovedNodes::add(double nodeWeight, const Point& x, const Point& y) {
  weight += nodeWeight;
  before = plus(before, scaled(nodeWeight, x));
  now = plus(now, scaled(nodeWeight, y));
}

RelativeMotion::RelativeMotion(const MovedNodes& a, const MovedNodes& b)
    : a_(a), b_(b), turnA_(turnBetween(a.from, a.to)), turnB_(turnBetween(b.from, b.to)) {
  // The common part is the rotation nearest to zero between those of both bodies.
  const Point apart = minus(turnB_, turnA_);
  const double square = dot(apart, apart), part = square > 0.0 ? std::clamp(-dot(turnA_, apart) / square, 0.0, 1.0) : 0.0;
  common_ = plus(turnA_, scaled(part, apart));
  distance_ = minus(a.from.place(), b.from.place());
  shift_ = minus(rotated(minus(a.to.place(), b.to.place()), scaled(-1.0, common_)), distance_);
  end_ = at(1.0);
}

BodyFrame RelativeMotion::frameA(double part) const { return turned(a_.from, scaled(part, turnA_)); }
BodyFrame RelativeMotion::frameB(double part) const { return turned(b_.from, scaled(part, turnB_)); }

Point RelativeMotion::at(double part) const {
  const BodyFrame a = frameA(part), b = frameB(part);
  const Point betweenFrames = rotated(plus(distance_, scaled(part, shift_)), scaled(part, common_));
  // Seen from the place of B.
  const Point ofA = plus(scaled(a_.weight, betweenFrames), a.turn(minus(a_.drawnAfter(part), scaled(a_.weight, a.centre()))));
  const Point ofB = minus(b_.drawnAfter(part), scaled(b_.weight, b.centre()));
  return plus(scaled(a_.weight + b_.weight, b_.to.place()), b_.to.turn(plus(b.turnBack(ofA), ofB)));
}

double RelativeMotion::closing(const Point& normal, double gap) const {
  const double touching = kTouching * (norm(a_.to.place()) + norm(a_.now));
  return firstZero([&](double part) { return gap + dot(normal, minus(end_, at(part))) - touching; });
}

Point RelativeMotion::slipAfter(double part, const Point& normal) const {
  const Eigen::Quaterniond turn =
      a_.to.orientation() * frameA(part).orientation().conjugate() * frameB(part).orientation() * b_.to.orientation().conjugate();
  // A rotation about the normal turns the direction of sliding; one about a tangent is rolling.
  const Point spin = scaled(dot(rotationVector(turn), normal), normal);
  return scaled(1.0 / (1.0 - part), endOfArc(tangential(minus(end_, at(part)), normal), spin));
}

}  // namespace suture
