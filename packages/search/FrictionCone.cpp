#include <suture/search/FrictionCone.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

FrictionCone::Force FrictionCone::project(const Force& trial, Derivative* derivative) const {
  if (derivative) derivative->setZero();
  const double normal = trial(0), size = std::hypot(trial(1), trial(2));
  if (normal >= 0.0 && size <= bound + friction * normal) {
    if (derivative) derivative->setIdentity();
    return trial;
  }
  const Eigen::Vector2d along = size > 0.0 ? Eigen::Vector2d(trial.tail<2>() / size) : Eigen::Vector2d::Zero();
  const Eigen::Vector2d across(-along(1), along(0));
  // The cone's lateral surface; it ends at l_n = 0 with the disc of forces without a normal component.
  const double beyond = (size - bound - friction * normal) / (1.0 + friction * friction);
  const double onNormal = normal + friction * beyond, onSize = bound + friction * onNormal;
  Force nearest = Force::Zero();
  if (beyond > 0.0 && onNormal > 0.0) {
    nearest(0) = onNormal;
    nearest.tail<2>() = onSize * along;
    if (derivative) {
      const Force ray = Force(1.0, friction * along(0), friction * along(1)) / std::sqrt(1.0 + friction * friction);
      *derivative = ray * ray.transpose();
      derivative->bottomRightCorner<2, 2>() += onSize / size * across * across.transpose();
    }
    return nearest;
  }
  const double held = std::min(size, bound);
  nearest.tail<2>() = held * along;
  if (derivative && bound > 0.0) {
    if (size <= bound)
      derivative->bottomRightCorner<2, 2>().setIdentity();
    else
      derivative->bottomRightCorner<2, 2>() = bound / size * across * across.transpose();
  }
  return nearest;
}

}  // namespace suture
