#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/elasticity/MaterialLaw.hpp>
#include <suture/elasticity/OrthotropicLaw.hpp>
#include <suture/elasticity/StressVector.hpp>

#include <Eigen/Cholesky>
#include <Teuchos_ParameterList.hpp>
#include <cmath>

namespace suture {

namespace {

// Entries of a stiffness that should be equal may differ by this fraction of the largest, because computed laws have round-off.
constexpr double kRounding = 1e-12;

template <typename Law>
void add(Registry<MaterialLaw>& registry) {
  registry.add(Law::kName, Law::schema(), [](const Parameters& own) { return std::make_unique<Law>(own); });
}

}  // namespace

void registerBuiltIns(Registry<MaterialLaw>& registry) {
  add<IsotropicLaw>(registry);
  add<OrthotropicLaw>(registry);
}

namespace {

InputError refuse(const std::string& why) { return {MaterialLaw::kind(), "the stiffness of the material " + why}; }

}  // namespace

ElasticStiffness MaterialLaw::stiffness() const {
  const ElasticStiffness c = doStiffness();
  if (!c.allFinite()) throw refuse("is not finite");
  const double largest = c.cwiseAbs().maxCoeff();
  if ((c - c.transpose()).cwiseAbs().maxCoeff() > kRounding * largest) throw refuse("is not symmetric: it has no strain energy");
  const Eigen::LLT<ElasticStiffness> factor(c);
  if (factor.info() != Eigen::Success) throw refuse("is not positive definite: some strain would have zero or negative energy");
  return 0.5 * (c + c.transpose());
}

Eigen::Matrix4d planePart(const ElasticStiffness& c) {
  if (c.topRightCorner<4, 2>().cwiseAbs().maxCoeff() > kRounding * c.cwiseAbs().maxCoeff())
    throw refuse("couples in-plane strains with out-of-plane shear (yz, xz): 2D bodies would not stay plane");
  return c.topLeftCorner<4, 4>();
}

ElasticStiffness isotropicStiffness(const IsotropicModuli& moduli) {
  const double nu = moduli.poisson, shear = moduli.young / (2.0 * (1.0 + nu));
  ElasticStiffness c = ElasticStiffness::Zero();
  c.topLeftCorner<3, 3>().setConstant(moduli.young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)));
  c.diagonal().head<3>().array() += 2.0 * shear;
  c.diagonal().tail<3>().setConstant(shear);
  return c;
}

IsotropicModuli nearestIsotropic(const ElasticStiffness& c) {
  const double normal = c.diagonal().head<3>().sum(), across = c(0, 1) + c(1, 2) + c(0, 2), shear = c.diagonal().tail<3>().sum();
  const double bulk = (normal + 2.0 * across) / 9.0, mean = (normal - across + 3.0 * shear) / 15.0;
  return {9.0 * bulk * mean / (3.0 * bulk + mean), (3.0 * bulk - 2.0 * mean) / (6.0 * bulk + 2.0 * mean)};
}

double meanCoupling(const ElasticStiffness& c) {
  // Exact if the three entries are equal.
  return c(0, 1) + ((c(1, 2) - c(0, 1)) + (c(0, 2) - c(0, 1))) / 3.0;
}

ElasticStiffness turned(const ElasticStiffness& c, double angle) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  axes.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return turned(c, axes);
}

ElasticStiffness turned(const ElasticStiffness& c, const Eigen::Matrix3d& axes) {
  // Strains in the material's axes from those in the scene's, e_ab = sum over i, j of axes_ia axes_jb e_ij; shear counts twice.
  ElasticStiffness strain;
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) {
      const int a = kStressAxes[row][0], b = kStressAxes[row][1], i = kStressAxes[column][0], j = kStressAxes[column][1];
      const double once = axes(i, a) * axes(j, b), other = axes(j, a) * axes(i, b);
      strain(row, column) = (row < 3 ? 1.0 : 2.0) * (column < 3 ? once : 0.5 * (once + other));
    }
  return strain.transpose() * c * strain;
}

}  // namespace suture
