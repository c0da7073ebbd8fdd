#include <suture/base/Point.hpp>
#include <suture/reader/cad/SurfaceShape.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <optional>

namespace suture {

namespace {

using Vector = Eigen::Vector3d;
using Kind = SurfaceShape::Kind;

Vector vectorOf(const Point& p) { return {p[0], p[1], p[2]}; }
Point pointAt(const Vector& v) { return {v[0], v[1], v[2]}; }

/// Mean of some vectors, and the eigenvalues (ascending) and eigenvectors of their covariance.
struct Spread {
  Vector mean = Vector::Zero(), values = Vector::Zero();
  Eigen::Matrix3d vectors = Eigen::Matrix3d::Identity();

  explicit Spread(const std::vector<Vector>& all) {
    for (const Vector& one : all) mean += one / static_cast<double>(all.size());
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const Vector& one : all) sum += (one - mean) * (one - mean).transpose() / static_cast<double>(all.size());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sum);
    values = solver.eigenvalues();
    vectors = solver.eigenvectors();
  }
};

/// Tests the points and normals against one kind of shape after the other.
class Fit {
 public:
  Fit(const std::vector<Point>& points, const std::vector<Point>& normals, const ShapeTolerance& tolerance) : tolerance_(tolerance) {
    for (const Point& point : points) points_.push_back(vectorOf(point));
    for (const Point& normal : normals) normals_.push_back(vectorOf(normal));
    Vector low = points_[0], high = points_[0];
    for (const Vector& point : points_) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    near_ = tolerance.distance * (high - low).norm();
  }

  std::optional<SurfaceShape> plane() const {
    Vector normal = Vector::Zero(), middle = Vector::Zero();
    for (const Vector& one : normals_) normal += one;
    for (const Vector& one : points_) middle += one / static_cast<double>(points_.size());
    if (normal.norm() < 0.5 * static_cast<double>(normals_.size())) return {};
    normal.normalize();
    SurfaceShape shape = shapeOf(Kind::Plane, normal, middle, 0.0);
    if (!agree([&](const Vector&) { return normal; }, [&](const Vector& p) { return normal.dot(p - middle); })) return {};
    return shape;
  }

  std::optional<SurfaceShape> sphere() const {
    // |p|^2 = 2 c.p + (R^2 - c^2), relative to the mean of the points.
    const Spread spread(points_);
    Eigen::MatrixXd rows(points_.size(), 4);
    Eigen::VectorXd right(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Vector p = points_[i] - spread.mean;
      rows.row(static_cast<Eigen::Index>(i)) << 2 * p.transpose(), 1.0;
      right[static_cast<Eigen::Index>(i)] = p.squaredNorm();
    }
    const Eigen::Vector4d x = rows.colPivHouseholderQr().solve(right);
    const Vector offset = x.head<3>(), centre = offset + spread.mean;
    const double square = x[3] + offset.squaredNorm();
    if (!(square > 0)) return {};
    return round(Kind::Sphere, Vector::UnitZ(), centre, std::sqrt(square), [&](const Vector& p) { return p - centre; });
  }

  std::optional<SurfaceShape> cylinder() const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const Vector& n : normals_) sum += n * n.transpose() / static_cast<double>(normals_.size());
    const Vector axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum).eigenvectors().col(0);
    const auto circle = circleAbout(axis, points_);
    if (!circle) return {};
    const auto& [centre, radius] = *circle;
    return round(Kind::Cylinder, axis, centre, radius,
                 [&, &middle = centre](const Vector& p) -> Vector { return across(p - middle, axis); });
  }

  std::optional<SurfaceShape> cone() const {
    // The normals lie on a circle: n.a is constant. All tangent planes contain the apex.
    const Spread spread(normals_);
    const Vector axis = spread.vectors.col(0);
    const double sine = axis.dot(spread.mean), cosine = std::sqrt(std::max(0.0, 1 - sine * sine));
    if (std::abs(sine) < 10 * tolerance_.angle || cosine < 10 * tolerance_.angle) return {};
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Vector right = Vector::Zero();
    const Vector origin = points_[0];
    for (std::size_t i = 0; i < points_.size(); ++i) {
      matrix += normals_[i] * normals_[i].transpose();
      right += normals_[i] * normals_[i].dot(points_[i] - origin);
    }
    const Eigen::FullPivLU<Eigen::Matrix3d> factor(matrix);
    if (factor.rcond() < 1e-10) return {};
    const Vector apex = factor.solve(right) + origin;
    SurfaceShape shape = shapeOf(Kind::Cone, axis, apex, 0.0);
    double outwards = 0.0, along = 0.0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Vector radial = across(points_[i] - apex, axis);
      shape.radius = std::max(shape.radius, radial.norm());
      outwards += normals_[i].dot(radial);
      along += axis.dot(points_[i] - apex);
    }
    shape.hollow = outwards < 0;
    const double sign = shape.hollow ? -1.0 : 1.0;  // the outer normal of a cone leans towards its apex
    const Vector forward = along < 0 ? Vector(-axis) : axis;
    const double lean = std::abs(sine);
    const bool fits = agree(
        [&](const Vector& p) -> Vector {
          const Vector radial = across(p - apex, axis);
          if (radial.norm() <= near_) return Vector::Zero();
          return sign * (cosine * radial.normalized() - lean * forward);
        },
        [&](const Vector& p) { return cosine * across(p - apex, axis).norm() - lean * forward.dot(p - apex); });
    if (!fits) return {};
    return shape;
  }

  /// \param tube  radius of the tube
  std::optional<SurfaceShape> torus(double tube) const {
    for (const double sign : {1.0, -1.0}) {
      std::vector<Vector> spine;
      for (std::size_t i = 0; i < points_.size(); ++i) spine.push_back(points_[i] - sign * tube * normals_[i]);
      const Spread spread(spine);
      const Vector axis = spread.vectors.col(0);
      const auto circle = circleAbout(axis, spine);
      if (!circle) continue;
      const auto& [centre, radius] = *circle;
      const auto nearest = [&, centre = centre, radius = radius](const Vector& p) -> Vector {
        return centre + radius * across(p - centre, axis).normalized();
      };
      if (!agree([&](const Vector& p) -> Vector { return sign * (p - nearest(p)).normalized(); },
                 [&](const Vector& p) { return (p - nearest(p)).norm() - tube; }))
        continue;
      SurfaceShape shape = shapeOf(Kind::Torus, axis, centre, radius);
      shape.tube = tube;
      shape.hollow = sign < 0;
      return shape;
    }
    return {};
  }

 private:
  static Vector across(const Vector& v, const Vector& axis) { return v - axis.dot(v) * axis; }

  static SurfaceShape shapeOf(Kind kind, const Vector& axis, const Vector& centre, double radius) {
    SurfaceShape shape;
    shape.kind = kind;
    shape.axis = pointAt(axis);
    shape.centre = pointAt(centre);
    shape.radius = radius;
    return shape;
  }

  /// Circle through the projections of points along an axis: centre, in the plane of the mean of the points, and radius.
  static std::optional<std::pair<Vector, double>> circleAbout(const Vector& axis, const std::vector<Vector>& points) {
    const Vector first = axis.unitOrthogonal(), second = axis.cross(first);
    Vector middle = Vector::Zero();
    for (const Vector& p : points) middle += p / static_cast<double>(points.size());
    Eigen::MatrixXd rows(points.size(), 3);
    Eigen::VectorXd right(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double x = first.dot(points[i] - middle), y = second.dot(points[i] - middle);
      rows.row(static_cast<Eigen::Index>(i)) << 2 * x, 2 * y, 1.0;
      right[static_cast<Eigen::Index>(i)] = x * x + y * y;
    }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factor(rows);
    if (factor.rank() < 3) return {};
    const Vector x = factor.solve(right);
    const double square = x[2] + x[0] * x[0] + x[1] * x[1];
    if (!(square > 0)) return {};
    return std::make_pair(Vector(middle + x[0] * first + x[1] * second), std::sqrt(square));
  }

  template <typename Radial>
  std::optional<SurfaceShape> round(Kind kind, const Vector& axis, const Vector& centre, double radius, const Radial& radial) const {
    SurfaceShape shape = shapeOf(kind, axis, centre, radius);
    double outwards = 0.0;
    for (std::size_t i = 0; i < points_.size(); ++i) outwards += normals_[i].dot(radial(points_[i]));
    shape.hollow = outwards < 0;
    const double sign = shape.hollow ? -1.0 : 1.0;
    if (!agree([&](const Vector& p) -> Vector { return sign * radial(p).normalized(); },
               [&](const Vector& p) { return radial(p).norm() - radius; }))
      return {};
    return shape;
  }

  /// True if all points and normals agree with the shape. \param normal  at a point; zero where the shape has none
  template <typename Normal, typename Distance>
  bool agree(const Normal& normal, const Distance& distance) const {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!(std::abs(distance(points_[i])) <= near_)) return false;
      const Vector expected = normal(points_[i]);
      if (expected.squaredNorm() > 0.5 && !((normals_[i] - expected).norm() <= tolerance_.angle)) return false;
    }
    return true;
  }

  ShapeTolerance tolerance_;
  std::vector<Vector> points_, normals_;
  double near_ = 0.0;
};

}  // namespace

SurfaceShape surfaceShape(const std::vector<Point>& points, const std::vector<Point>& normals, const ShapeTolerance& tolerance,
                          double tube) {
  if (points.size() < 3 || points.size() != normals.size()) return {};
  const Fit fit(points, normals, tolerance);
  if (const auto found = fit.plane()) return *found;
  if (const auto found = fit.sphere()) return *found;
  if (const auto found = fit.cylinder()) return *found;
  if (const auto found = fit.cone()) return *found;
  if (tube > 0)
    if (const auto found = fit.torus(tube)) return *found;
  return {};
}

bool isSameShape(const SurfaceShape& a, const SurfaceShape& b, double extent, double tolerance) {
  if (a.kind != b.kind || a.kind == Kind::Plane || a.kind == Kind::Other || a.hollow != b.hollow) return false;
  const double near = tolerance * extent;
  if (std::abs(a.tube - b.tube) > near) return false;
  if (a.kind != Kind::Cone && std::abs(a.radius - b.radius) > near) return false;
  const Point way = minus(b.centre, a.centre);
  if (a.kind == Kind::Sphere) return norm(way) <= near;
  if (norm(cross(a.axis, b.axis)) > tolerance) return false;
  return (a.kind == Kind::Cylinder ? norm(cross(way, a.axis)) : norm(way)) <= near;
}

std::string kindName(Kind kind) {
  static const char* const names[] = {"plane", "cylinder", "cone", "sphere", "torus", "surface"};
  return names[static_cast<int>(kind)];
}

}  // namespace suture
