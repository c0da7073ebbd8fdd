// Material laws: constants of a lamina in closed form, invariance under rotations, and refused input.
#include <Eigen/LU>
#include <Teuchos_ParameterList.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/elasticity/HookesLaw.hpp>
#include <suture/elasticity/OrthotropicLaw.hpp>

namespace suture {
namespace {

// Carbon fibres in epoxy. [GPa]
constexpr double kE1 = 140.0, kE2 = 10.0, kE3 = 9.0, kNu12 = 0.3, kNu23 = 0.4, kNu13 = 0.28, kG12 = 5.0, kG23 = 3.0, kG13 = 4.5;

Schema lawSchema() { return Schema().list("Materials", Schema().each("material", materialSchema())); }

std::string orthotropic(const std::string& young, const std::string& poisson, const std::string& shear, double angle = 0.0,
                        const std::string& axis1 = "", const std::string& axis2 = "") {
  const auto parameter = [](const char* name, const char* type, const std::string& value) {
    return "<Parameter name='" + std::string(name) + "' type='" + type + "' value='" + value + "'/>";
  };
  return "<ParameterList name='Suture'><ParameterList name='Materials'><ParameterList name='ply'>" +
         parameter("Type", "string", "Orthotropic") + "<ParameterList name='Orthotropic'>" +
         parameter("Young Moduli", "Array(double)", young) + parameter("Poisson Ratios", "Array(double)", poisson) +
         parameter("Shear Moduli", "Array(double)", shear) + parameter("Angle", "double", std::to_string(angle)) +
         (axis1.empty() ? "" : parameter("Axis 1", "Array(double)", axis1)) +
         (axis2.empty() ? "" : parameter("Axis 2", "Array(double)", axis2)) +
         "</ParameterList></ParameterList></ParameterList></ParameterList>";
}

std::unique_ptr<MaterialLaw> lawOf(const std::string& xml) {
  const SceneFile file = parseScene(xml, "laws.xml", lawSchema());
  const Parameters& own = file.parameters->sublist("Materials").sublist("ply");
  const std::string type = own.get<std::string>("Type");
  return Registry<MaterialLaw>::instance().make(type, own.isSublist(type) ? own.sublist(type) : own);
}

std::unique_ptr<MaterialLaw> lamina(double angle) {
  return lawOf(orthotropic("{140.0, 10.0, 9.0}", "{0.3, 0.4, 0.28}", "{5.0, 3.0, 4.5}", angle));
}

Material materialOf(std::shared_ptr<const MaterialLaw> law, ElementForm form = ElementForm::Displacement) {
  Material material{"ply"};
  const IsotropicModuli near = nearestIsotropic(law->stiffness());
  material.young = near.young;
  material.poisson = near.poisson;
  material.element = form;
  material.law = std::move(law);
  return material;
}

TEUCHOS_UNIT_TEST(MaterialLaw, LaminaPulledOffItsAxes) {
  // R. M. Jones, Mechanics of Composite Materials: apparent constants of an orthotropic sheet whose axis 1 is rotated by the angle.
  for (const double degrees : {0.0, 10.0, 30.0, 45.0, 77.0, 90.0, -20.0}) {
    const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
    const double mixed = 1 / kG12 - 2 * kNu12 / kE1;
    const double alongX = std::pow(c, 4) / kE1 + mixed * s * s * c * c + std::pow(s, 4) / kE2;
    const double alongY = std::pow(s, 4) / kE1 + mixed * s * s * c * c + std::pow(c, 4) / kE2;
    const double across = -(kNu12 / kE1 * (std::pow(s, 4) + std::pow(c, 4)) - (1 / kE1 + 1 / kE2 - 1 / kG12) * s * s * c * c);
    const double sheared =
        (2 / kE1 + 2 * kNu12 / kE1 - 1 / kG12) * s * std::pow(c, 3) - (2 / kE2 + 2 * kNu12 / kE1 - 1 / kG12) * std::pow(s, 3) * c;
    const Material ply = materialOf(lamina(degrees));
    const Eigen::Matrix3d compliance = elasticity(ply, PlaneModel::Stress, 2).inverse();
    TEST_FLOATING_EQUALITY(compliance(0, 0), alongX, 1e-12);
    TEST_FLOATING_EQUALITY(compliance(1, 1), alongY, 1e-12);
    TEST_COMPARE(std::abs(compliance(0, 1) - across), <, 1e-12 * alongY);
    TEST_COMPARE(std::abs(compliance(0, 2) - sheared), <, 1e-12 * alongY);
    // The functions used by elements and estimates agree.
    const HookesLaw<2> law(ply, PlaneModel::Stress);
    TEST_COMPARE(std::abs(law.complementary({1, 0, 0, 0}) - alongX), <, 1e-12 * alongX);
    TEST_COMPARE((law.pointwise * law.compliance.col(0) - Eigen::Vector4d(1, 0, 0, 0)).norm(), <, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(MaterialLaw, PlaneStrainKeepsTheStrainAcrossZero) {
  const HookesLaw<2> law(materialOf(lamina(25.0)), PlaneModel::Strain);
  const Eigen::Vector4d strain(2e-3, -1e-3, 0.0, 3e-3), stress = law.pointwise * strain;
  TEST_COMPARE((law.compliance * stress - strain).norm(), <, 1e-15);
  TEST_FLOATING_EQUALITY(law.complementary(stress), stress.dot(strain), 1e-12);
  TEST_FLOATING_EQUALITY(law.across(stress), stress[2], 1e-12);
}

TEUCHOS_UNIT_TEST(MaterialLaw, TurnedTwiceIsTurnedByTheSumAndAFullTurnIsNone) {
  const ElasticStiffness c = lamina(0.0)->stiffness();
  TEST_COMPARE((turned(turned(c, 0.3), 0.4) - turned(c, 0.7)).norm(), <, 1e-13 * c.norm());
  TEST_COMPARE((turned(c, M_PI) - c).norm(), <, 1e-13 * c.norm());
  const ElasticStiffness quarter = turned(c, M_PI / 2);  // axes 1 and 2 change places
  TEST_FLOATING_EQUALITY(quarter(0, 0), c(1, 1), 1e-13);
  TEST_FLOATING_EQUALITY(quarter(0, 2), c(1, 2), 1e-13);
  TEST_FLOATING_EQUALITY(quarter(4, 4), c(5, 5), 1e-13);
  // The work of a strain does not depend on the axes, nor does the mean over all directions.
  TEST_FLOATING_EQUALITY(nearestIsotropic(turned(c, 0.9)).young, nearestIsotropic(c).young, 1e-13);
}

TEUCHOS_UNIT_TEST(MaterialLaw, AxesIn3DAreThoseOfTheMaterial) {
  const auto along = [](const std::string& axis1, const std::string& axis2, double angle = 0.0) {
    return lawOf(orthotropic("{140.0, 10.0, 9.0}", "{0.3, 0.4, 0.28}", "{5.0, 3.0, 4.5}", angle, axis1, axis2))->stiffness();
  };
  // A bar along the unit vector n has the compliance n n : C^-1 : n n; along a material axis this is 1 / E of the axis.
  const auto modulusAlong = [](const ElasticStiffness& c, const Eigen::Vector3d& n) {
    Eigen::Matrix<double, 6, 1> stress;
    stress << n[0] * n[0], n[1] * n[1], n[2] * n[2], n[0] * n[1], n[1] * n[2], n[0] * n[2];
    return 1.0 / stress.dot(c.inverse() * stress);
  };
  const Eigen::Vector3d n1 = Eigen::Vector3d(2, -1, 2) / 3, n2 = Eigen::Vector3d(1, 4, 1).normalized(), n3 = n1.cross(n2);
  const ElasticStiffness c = along("{4.0, -2.0, 4.0}", "{3.0, 3.0, 3.0}");  // (3, 3, 3) is a multiple of n1 and n2
  TEST_FLOATING_EQUALITY(modulusAlong(c, n1), kE1, 1e-12);
  TEST_FLOATING_EQUALITY(modulusAlong(c, n2), kE2, 1e-12);
  TEST_FLOATING_EQUALITY(modulusAlong(c, n3), kE3, 1e-12);
  const ElasticStiffness quarter = along("{4.0, -2.0, 4.0}", "{3.0, 3.0, 3.0}", 90.0);
  TEST_FLOATING_EQUALITY(modulusAlong(quarter, n2), kE1, 1e-12);
  TEST_FLOATING_EQUALITY(modulusAlong(quarter, n1), kE2, 1e-12);
  TEST_COMPARE((along("{1.0, 0.0, 0.0}", "{0.0, 1.0, 0.0}", 25.0) - lamina(25.0)->stiffness()).norm(), <, 1e-12 * c.norm());
  // With axis 1 normal to the plane a plane body stays plane; with an axis between the two it does not.
  planePart(along("{0.0, 0.0, 1.0}", "{1.0, 1.0, 0.0}"));
  TEST_THROW(planePart(along("{1.0, 0.0, 1.0}", "{0.0, 1.0, 0.0}")), InputError);
  TEST_THROW(along("{1.0, 2.0, 3.0}", "{2.0, 4.0, 6.0}"), InputError);
  TEST_THROW(along("{0.0, 0.0, 0.0}", "{2.0, 4.0, 6.0}"), InputError);
  TEST_THROW(along("{1.0, 0.0}", "{0.0, 1.0, 0.0}"), InputError);
}

TEUCHOS_UNIT_TEST(MaterialLaw, NineEqualConstantsAreIsotropic) {
  const double e = 7.0, nu = 0.25, g = e / (2 * (1 + nu));
  const auto law = lawOf(orthotropic("{7.0, 7.0, 7.0}", "{0.25, 0.25, 0.25}", "{2.8, 2.8, 2.8}", 33.0));
  TEST_FLOATING_EQUALITY(g, 2.8, 1e-15);
  const ElasticStiffness expected = isotropicStiffness({e, nu});
  TEST_COMPARE((law->stiffness() - expected).norm(), <, 1e-14 * expected.norm());
  const IsotropicModuli near = nearestIsotropic(expected);
  TEST_FLOATING_EQUALITY(near.young, e, 1e-14);
  TEST_FLOATING_EQUALITY(near.poisson, nu, 1e-14);
  for (const PlaneModel plane : {PlaneModel::Strain, PlaneModel::Stress}) {
    const HookesLaw<2> own(materialOf(std::make_shared<GivenLaw>(law->stiffness())), plane), plain({"m", e, nu}, plane);
    TEST_COMPARE((own.pointwise - plain.pointwise).norm(), <, 1e-13 * plain.pointwise.norm());
    TEST_COMPARE((own.compliance - plain.compliance).norm(), <, 1e-13 * plain.compliance.norm());
  }
  const HookesLaw<2> mixed(materialOf(std::make_shared<GivenLaw>(law->stiffness()), ElementForm::Mixed), PlaneModel::Strain);
  TEST_FLOATING_EQUALITY(mixed.projected, e * nu / ((1 + nu) * (1 - 2 * nu)), 1e-13);
}

TEUCHOS_UNIT_TEST(MaterialLaw, RefusesInvalidElasticMaterials) {
  const auto messageOf = [](const MaterialLaw& law) {
    try {
      law.stiffness();
    } catch (const InputError& error) {
      return error.problems().front().message;
    }
    return std::string();
  };
  const auto says = [](const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; };
  TEST_ASSERT(says(messageOf(*lawOf(orthotropic("{1.0, 1.0, 1.0}", "{0.9, 0.9, 0.9}", "{1.0, 1.0, 1.0}"))), "not positive definite"));
  ElasticStiffness c = isotropicStiffness({1.0, 0.3});
  c(0, 1) += 1e-3;
  TEST_ASSERT(says(messageOf(GivenLaw(c)), "not symmetric"));
  c = isotropicStiffness({1.0, 0.3});
  c(0, 4) = c(4, 0) = 0.1;
  TEST_ASSERT(says(messageOf(GivenLaw(c)), ""));  // 3D
  TEST_THROW(planePart(c), InputError);
  const Material coupled = materialOf(std::make_shared<GivenLaw>(c));
  TEST_THROW(HookesLaw<2>(coupled, PlaneModel::Strain), InputError);
  TEST_COMPARE((HookesLaw<3>(coupled, PlaneModel::Strain).pointwise - c).norm(), <, 1e-15);
  c(0, 4) = c(4, 0) = std::nan("");
  TEST_ASSERT(says(messageOf(GivenLaw(c)), "not finite"));
  TEST_THROW(lawOf(orthotropic("{1.0, 1.0}", "{0.1, 0.1, 0.1}", "{1.0, 1.0, 1.0}")), InputError);
  TEST_THROW(lawOf(orthotropic("{1.0, -1.0, 1.0}", "{0.1, 0.1, 0.1}", "{1.0, 1.0, 1.0}")), InputError);
}

TEUCHOS_UNIT_TEST(MaterialLaw, EveryNameIsInTheSchema) {
  const Schema schema = materialSchema();
  const Schema::Parameter* type = schema.find("Type");
  TEST_ASSERT(type != nullptr);
  TEST_ASSERT(type->allowed == Registry<MaterialLaw>::instance().names());
  TEST_ASSERT(schema.find("Young Modulus") && schema.find("Young Modulus")->with);
  TEST_ASSERT(schema.findList("Orthotropic") && !schema.findList("Isotropic"));
}

}  // namespace
}  // namespace suture
