#include <suture/base/RigidFrame.hpp>
#include <suture/base/RigidValues.hpp>

#include <algorithm>

namespace suture {

RigidFrame RigidFrame::around(const std::vector<Point>& points) {
  RigidFrame frame;
  for (const Point& point : points) frame.centre = plus(frame.centre, scaled(1.0 / static_cast<double>(points.size()), point));
  double farthest = 0.0;
  for (const Point& point : points) farthest = std::max(farthest, norm(minus(point, frame.centre)));
  if (farthest > 0.0) frame.radius = farthest;
  return frame;
}

Point RigidFrame::arm(const Point& point) const {
  Point arm = minus(point, centre);
  for (double& x : arm) x /= radius;
  return arm;
}

Matrix RigidFrame::at(const Point& point, int dimension) const {
  Matrix motion(dimension, rigidMotions(dimension));
  for (int k = 0; k < dimension; ++k) {
    Point axis{0, 0, 0};
    axis[static_cast<std::size_t>(k)] = 1.0;
    const std::array<double, 6> values = rigidValues(dimension, arm(point), axis);
    motion.row(k) = Eigen::Map<const Vector>(values.data(), motion.cols()).transpose();
  }
  return motion;
}

}  // namespace suture
