#include <suture/base/Point.hpp>
#include <suture/motion/BodyFrame.hpp>

#include <cmath>

namespace suture {

namespace {

Eigen::Vector3d vectorOf(const Point& p) { return {p[0], p[1], p[2]}; }
Point pointOf(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

}  // namespace

Eigen::Quaterniond rotationBy(const Point& vector) {
  const double half = 0.5 * norm(vector);
  // sin(h) / (2 h) -> 1/2 - h^2 / 12: the next term is below round-off.
  const double factor = half < 1e-4 ? 0.5 - half * half / 12.0 : 0.5 * std::sin(half) / half;
  return Eigen::Quaterniond(std::cos(half), factor * vector[0], factor * vector[1], factor * vector[2]);
}

Point rotationVector(const Eigen::Quaterniond& rotation) {
  const double sign = rotation.w() < 0.0 ? -1.0 : 1.0;  // q and -q are the same rotation
  const double sine = rotation.vec().norm(), half = std::atan2(sine, sign * rotation.w());
  return scaled(sine > 0.0 ? sign * 2.0 * half / sine : 2.0, pointOf(rotation.vec()));
}

Point turnBetween(const BodyFrame& from, const BodyFrame& to) {
  if (from.turnsOnlyAboutZ() && to.turnsOnlyAboutZ()) return minus(to.rotation(), from.rotation());
  return rotationVector(to.orientation() * from.orientation().conjugate());
}

Point endOfArc(const Point& chord, const Point& rotation) {
  const double angle = norm(rotation);
  if (angle == 0.0) return chord;
  const Point axis = scaled(1.0 / angle, rotation), along = scaled(dot(chord, axis), axis), across = minus(chord, along);
  const double half = 0.5 * angle;
  const Eigen::Vector3d turned = rotationBy(scaled(0.5, rotation)) * vectorOf(across);
  return plus(along, scaled(half / std::sin(half), pointOf(turned)));
}

Point BodyFrame::at(const Point& drawn) const { return plus(place_, turn(minus(drawn, centre_))); }

Point BodyFrame::turn(const Point& vector) const { return pointOf(matrix_ * vectorOf(vector)); }
Point BodyFrame::turnBack(const Point& vector) const { return pointOf(matrix_.transpose() * vectorOf(vector)); }

void BodyFrame::move(const Point& shift, const Point& rotation, const Point& about) {
  const Eigen::Quaterniond by = rotationBy(rotation);
  place_ = plus(plus(about, shift), pointOf(by * vectorOf(minus(place_, about))));
  turned_ = (by * turned_).normalized();
  matrix_ = turned_.toRotationMatrix();
  onlyAboutZ_ = onlyAboutZ_ && rotation[0] == 0.0 && rotation[1] == 0.0;
  angle_ += rotation[2];
}

std::array<double, BodyFrame::kNumbers> BodyFrame::numbers() const {
  return {centre_[0],  centre_[1],  centre_[2],  place_[0],   place_[1], place_[2],
          turned_.w(), turned_.x(), turned_.y(), turned_.z(), angle_,    onlyAboutZ_ ? 1.0 : 0.0};
}

BodyFrame BodyFrame::ofNumbers(const std::array<double, kNumbers>& numbers) {
  BodyFrame frame({numbers[0], numbers[1], numbers[2]});
  frame.place_ = {numbers[3], numbers[4], numbers[5]};
  frame.turned_ = Eigen::Quaterniond(numbers[6], numbers[7], numbers[8], numbers[9]);
  frame.matrix_ = frame.turned_.toRotationMatrix();
  frame.angle_ = numbers[10];
  frame.onlyAboutZ_ = numbers[11] != 0.0;
  return frame;
}

Point BodyFrame::rotation() const { return onlyAboutZ_ ? Point{0, 0, angle_} : rotationVector(turned_); }

}  // namespace suture
