#include <suture/elasticity/OrthotropicLaw.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <suture/base/scene/SceneReader.hpp>

namespace suture {

Schema OrthotropicLaw::schema() {
  return Schema("three axes of symmetry, by default x, y and z (axisymmetric: radius, axis and hoop)")
      .reals("Young Moduli", std::nullopt, "E_1, E_2, E_3: stress over strain in bars along the axes.", "stress", Range::positive())
      .reals("Poisson Ratios", std::nullopt,
             "nu_12, nu_23, nu_13: contraction along the second axis over the extension of a bar along the first.")
      .reals("Shear Moduli", std::nullopt, "G_12, G_23, G_13.", "stress", Range::positive())
      .real(
          "Angle", 0.0,
          "Anticlockwise rotation of axes 1 and 2 about axis 3: in 2D from the x axis to axis 1; axisymmetric: from the radius. [degrees]")
      .reals("Axis 1", std::nullopt, "direction of axis 1 before the rotation by Angle, of any length; default: x")
      .optional()
      .reals("Axis 2", std::nullopt,
             "another direction in the plane of axes 1 and 2; axis 2 is its component perpendicular to axis 1; default: y. Axis 3 is "
             "perpendicular to both. In 2D scenes one of the axes must be perpendicular to the plane")
      .optional();
}

namespace {

std::array<double, 3> three(const Parameters& own, const std::string& name, Problems& problems) {
  const auto& given = own.get<Teuchos::Array<double>>(name);
  std::array<double, 3> values{1.0, 1.0, 1.0};
  if (given.size() != 3)
    problems.add(pathOf(own, name), "has " + std::to_string(given.size()) + " entries, expected 3, also in 2D scenes");
  else
    std::copy(given.begin(), given.end(), values.begin());
  return values;
}

/// Columns: axes 1, 2 and 3.
Eigen::Matrix3d axesIn(const Parameters& own, Problems& problems) {
  constexpr double kParallel = 1e-6;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  for (int i = 0; i < 2; ++i) {
    const std::string name = "Axis " + std::to_string(i + 1);
    if (!own.isParameter(name)) continue;
    const std::array<double, 3> given = three(own, name, problems);
    axes.col(i) = Eigen::Map<const Eigen::Vector3d>(given.data());
  }
  const double longest = axes.col(0).norm();
  axes.col(0) /= longest;
  const double given = axes.col(1).norm();
  axes.col(1) -= axes.col(0).dot(axes.col(1)) * axes.col(0);
  if (!(longest > 0.0) || !(axes.col(1).norm() > kParallel * given)) {
    problems.add(pathOf(own, own.isParameter("Axis 2") ? "Axis 2" : "Axis 1"),
                 "the directions of axes 1 and 2 are zero or parallel; expected two that span a plane (default of axis 2: y)");
    return Eigen::Matrix3d::Identity();
  }
  axes.col(1).normalize();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  const double angle = own.get<double>("Angle") * M_PI / 180.0;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return axes * turn;
}

}  // namespace

OrthotropicLaw::OrthotropicLaw(const Parameters& own) {
  Problems problems;
  young_ = three(own, "Young Moduli", problems);
  poisson_ = three(own, "Poisson Ratios", problems);
  shear_ = three(own, "Shear Moduli", problems);
  axes_ = axesIn(own, problems);
  problems.throwIfAny();
}

ElasticStiffness OrthotropicLaw::doStiffness() const {
  ElasticStiffness compliance = ElasticStiffness::Zero();
  for (int i = 0; i < 3; ++i) compliance(i, i) = 1.0 / young_[i];
  compliance(0, 1) = compliance(1, 0) = -poisson_[0] / young_[0];
  compliance(1, 2) = compliance(2, 1) = -poisson_[1] / young_[1];
  compliance(0, 2) = compliance(2, 0) = -poisson_[2] / young_[0];
  for (int i = 0; i < 3; ++i) compliance(3 + i, 3 + i) = 1.0 / shear_[i];
  return turned(compliance.inverse(), axes_);
}

}  // namespace suture
