#pragma once
#include <suture/base/Point.hpp>

#include <Eigen/Geometry>

#include <array>

namespace suture {

/// Place of a body that moves far while its strains stay small: x = place + R (X - centre) for a point X of the drawn body, with a rotation
/// R. Displacements in the body are measured from there. Local.
class BodyFrame {
 public:
  BodyFrame() = default;
  /// Where the body is drawn. \param centre  any point, best the centre of the body
  explicit BodyFrame(const Point& centre) : centre_(centre), place_(centre) {}

  /// Present place of a drawn point.
  Point at(const Point& drawn) const;
  /// Drawn point at a present place.
  Point drawnAt(const Point& place) const { return plus(centre_, turnBack(minus(place, place_))); }
  /// R v
  Point turn(const Point& vector) const;
  /// R^T v
  Point turnBack(const Point& vector) const;
  /// Moves on: turns by a rotation vector about a point of space, then shifts. The motion is finite: exp(rotation).
  void move(const Point& shift, const Point& rotation, const Point& about);

  /// The frame as numbers, to be sent or kept: ofNumbers() makes the same frame of them.
  static constexpr std::size_t kNumbers = 12;
  std::array<double, kNumbers> numbers() const;
  static BodyFrame ofNumbers(const std::array<double, kNumbers>& numbers);

  const Point& centre() const { return centre_; }
  /// Place of the centre.
  const Point& place() const { return place_; }
  /// Rotation vector [radians]. About z alone, as in 2D, the angle counts all turns; otherwise it is at most pi.
  Point rotation() const;
  const Eigen::Quaterniond& orientation() const { return turned_; }
  bool turnsOnlyAboutZ() const { return onlyAboutZ_; }

 private:
  Point centre_{0, 0, 0}, place_{0, 0, 0};
  Eigen::Quaterniond turned_ = Eigen::Quaterniond::Identity();
  Eigen::Matrix3d matrix_ = Eigen::Matrix3d::Identity();  // the same rotation: a frame turns many points
  double angle_ = 0.0;                                    // about z, with all turns
  bool onlyAboutZ_ = true;
};

/// Rotation vector that turns one frame to another; about z alone all turns count. [radians]
Point turnBetween(const BodyFrame& from, const BodyFrame& to);
/// Displacement of a point in a uniform motion (shift and rotation at constant rates), straightened along the direction of motion at its
/// end: the length of the way instead of that of its chord. \param chord  displacement \param rotation  rotation vector of the motion, of
/// at most pi
Point endOfArc(const Point& chord, const Point& rotation);
/// Unit quaternion of a rotation vector.
Eigen::Quaterniond rotationBy(const Point& vector);
/// Rotation vector of a unit quaternion; its length is at most pi.
Point rotationVector(const Eigen::Quaterniond& rotation);

}  // namespace suture
