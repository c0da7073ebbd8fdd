#include <Eigen/Geometry>
#include <suture/answer/bound/PressedSides.hpp>
#include <suture/answer/bound/SplitSide.hpp>
#include <suture/elasticity/SideMap.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// Distance of a vertex from the plane of the others, relative to the size of the side, that is round-off.
constexpr double kPlaneSide = 1e-10;

Eigen::Vector3d placeOfPoint(const Point& p) { return {p[0], p[1], p[2]}; }

}  // namespace

SplitSide::SplitSide(const std::vector<Point>& points, bool isOdd) {
  centre_.setZero();
  for (int i = 0; i < 4; ++i) centre_ += 0.25 * placeOfPoint(points[i]);
  const Eigen::Vector3d one = placeOfPoint(points[2]) - placeOfPoint(points[0]), other = placeOfPoint(points[3]) - placeOfPoint(points[1]);
  const Eigen::Vector3d across = one.cross(other);
  // Distance of the diagonals.
  const double apart = std::abs(across.dot(placeOfPoint(points[1]) - placeOfPoint(points[0]))) / across.norm();
  isPlane_ = apart <= kPlaneSide * std::max(one.norm(), other.norm());
  const auto middle = [&](int a, int b) { return (a + 1) % 4 == b ? 4 + a : (b + 1) % 4 == a ? 4 + b : int(points.size()); };
  const std::array<std::array<int, 3>, 2> vertices =
      isOdd ? std::array<std::array<int, 3>, 2>{{{0, 1, 3}, {1, 2, 3}}} : std::array<std::array<int, 3>, 2>{{{0, 1, 2}, {0, 2, 3}}};
  for (int t = 0; t < 2; ++t) {
    const auto [a, b, c] = vertices[t];
    triangles_[t] = {{a, b, c, middle(a, b), middle(b, c), middle(a, c)}};
  }
  ofCell_.assign(points.size(), Moment::Zero());
  ofTriangles_.assign(points.size() == 4 ? 4 : points.size() + 1, Moment::Zero());
  addCell(points);
  addTriangles(points);
  if (isPlane_) lens_ = 0.0, lensMoment_.setZero();
}

void SplitSide::addCell(const std::vector<Point>& points) {
  SideMap map(points, 3, Rule::Data);
  const ReferenceElement& reference = map.reference();
  for (int q = 0; q < reference.points; ++q) {
    map.at(q);
    const Eigen::Vector3d normal = placeOfPoint(map.normal()), arm = placeOfPoint(map.place()) - centre_;
    Eigen::RowVector4d weights;
    weights << 1.0, arm.transpose();
    for (int i = 0; i < nodes(); ++i) ofCell_[i] += reference.valuesAt(q)[i] * normal * weights;
    lens_ += normal.dot(arm) / 3;
    lensMoment_ += 0.5 * normal.cwiseProduct(arm.cwiseProduct(arm));
  }
}

void SplitSide::addTriangles(const std::vector<Point>& points) {
  const int count = SimplexNodes<3>::sideNodes(order());
  const Matrix& mass = sideMass(3, order());
  for (int t = 0; t < 2; ++t) {
    Eigen::Matrix<double, 3, 6> arms;
    for (int i = 0; i < 3; ++i) arms.col(i) = placeOfPoint(points[triangles_[t][i]]) - centre_;
    arms.col(3) = 0.5 * (arms.col(0) + arms.col(1));
    arms.col(4) = 0.5 * (arms.col(1) + arms.col(2));
    arms.col(5) = 0.5 * (arms.col(0) + arms.col(2));
    const Eigen::Vector3d normal = 0.5 * (arms.col(1) - arms.col(0)).cross(arms.col(2) - arms.col(0));
    areas_[t] = normal.norm();
    for (int i = 0; i < count; ++i) {
      Eigen::RowVector4d weights;
      weights << mass.col(i).sum(), (arms.leftCols(count) * mass.col(i)).transpose();
      ofTriangles_[triangles_[t][i]] += normal * weights;
    }
    lens_ -= normal.dot(arms.leftCols<3>().rowwise().mean()) / 3;
    const Matrix& linear = sideMass(3, 1);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d along = arms.leftCols<3>().row(k).transpose();
      lensMoment_[k] -= 0.5 * normal[k] * along.dot(linear * along);
    }
  }
}

Eigen::Vector3d SplitSide::force(const LinearStress& stress, const Moment& moment, bool linear) {
  Eigen::Vector3d sum = tensorOf<3>(stress.col(0)) * moment.col(0);
  for (int k = 1; k < 4 && linear; ++k) sum += tensorOf<3>(stress.col(k)) * moment.col(k);
  return sum;
}

}  // namespace suture
