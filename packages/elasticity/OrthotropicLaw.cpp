#include <suture/elasticity/OrthotropicLaw.hpp>

#include <Eigen/LU>
#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <suture/base/scene/SceneReader.hpp>

namespace suture {

Schema OrthotropicLaw::schema() {
  return Schema("three axes of symmetry, 1 and 2 in the plane and 3 across it (axisymmetric: along the hoop)")
      .reals("Young Moduli", std::nullopt, "E_1, E_2, E_3: stress over strain in bars along the axes.", "stress", Range::positive())
      .reals("Poisson Ratios", std::nullopt,
             "nu_12, nu_23, nu_13: contraction along the second axis over the extension of a bar along the first.")
      .reals("Shear Moduli", std::nullopt, "G_12, G_23, G_13.", "stress", Range::positive())
      .real("Angle", 0.0, "From the x axis to axis 1, anticlockwise; axisymmetric: from the radius. [degrees]");
}

namespace {

std::array<double, 3> three(const Parameters& own, const std::string& name, Problems& problems) {
  const auto& given = own.get<Teuchos::Array<double>>(name);
  std::array<double, 3> values{1.0, 1.0, 1.0};
  if (given.size() != 3)
    problems.add(pathOf(own, name), "has " + std::to_string(given.size()) + " entries, expected 3, also in plane scenes");
  else
    std::copy(given.begin(), given.end(), values.begin());
  return values;
}

}  // namespace

OrthotropicLaw::OrthotropicLaw(const Parameters& own) : angle_(own.get<double>("Angle") * M_PI / 180.0) {
  Problems problems;
  young_ = three(own, "Young Moduli", problems);
  poisson_ = three(own, "Poisson Ratios", problems);
  shear_ = three(own, "Shear Moduli", problems);
  problems.throwIfAny();
}

ElasticStiffness OrthotropicLaw::doStiffness() const {
  ElasticStiffness compliance = ElasticStiffness::Zero();
  for (int i = 0; i < 3; ++i) compliance(i, i) = 1.0 / young_[i];
  compliance(0, 1) = compliance(1, 0) = -poisson_[0] / young_[0];
  compliance(1, 2) = compliance(2, 1) = -poisson_[1] / young_[1];
  compliance(0, 2) = compliance(2, 0) = -poisson_[2] / young_[0];
  for (int i = 0; i < 3; ++i) compliance(3 + i, 3 + i) = 1.0 / shear_[i];
  return turned(compliance.inverse(), angle_);
}

}  // namespace suture
