// Safety factors on random principal stresses, against closed forms of the criteria and bisection.
#include <Eigen/Geometry>
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <functional>
#include <random>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/strength/Strength.hpp>

namespace suture {
namespace {

constexpr double kTight = 1e-10;
const double kNone = std::numeric_limits<double>::infinity();

/// Random principal stresses, largest first; from -`size` to `size`.
class States {
 public:
  explicit States(double size) : part_(-size, size) {}
  PrincipalStress next() {
    PrincipalStress s{part_(engine_), part_(engine_), part_(engine_)};
    std::sort(s.rbegin(), s.rend());
    return s;
  }

 private:
  std::mt19937 engine_{7};
  std::uniform_real_distribution<double> part_;
};

/// The largest t, up to 1e9, for which all states up to t are safe.
double largest(const std::function<bool(double t)>& isSafe) {
  double low = 0.0, high = 1.0;
  while (isSafe(high) && high < 1e9) high *= 2;
  for (int i = 0; i < 200; ++i) (isSafe(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  return low;
}

/// The state with its deviator of s_1 and s_3 multiplied.
PrincipalStress blown(const PrincipalStress& s, double t) {
  const double mean = 0.5 * (s[0] + s[2]), radius = 0.5 * (s[0] - s[2]);
  return {mean + t * radius, s[1], mean - t * radius};
}

TEUCHOS_UNIT_TEST(Strength, PrincipalStressesOfATensorAreItsEigenvalues) {
  States states(1.0);
  for (int i = 0; i < 20; ++i) {
    const PrincipalStress s = states.next();
    Eigen::Matrix3d turn(Eigen::AngleAxisd(0.3 + i, Eigen::Vector3d(1, 2, 3).normalized()));
    const Eigen::Matrix3d t = turn * Eigen::Vector3d(s[0], s[1], s[2]).asDiagonal() * turn.transpose();
    Eigen::RowVectorXd row(6);
    row << t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(0, 2);
    for (int k = 0; k < 3; ++k) TEST_FLOATING_EQUALITY(principalStress(row)[k] + 10, s[k] + 10, 1e-13);
    TEST_FLOATING_EQUALITY(vonMises(s), vonMises(Matrix(row))[0], 1e-12);
    // In 2D the out-of-plane stress counts, wherever it is in the order.
    Eigen::RowVectorXd plane(4);
    plane << s[1], s[2], s[0], 0.0;
    for (int k = 0; k < 3; ++k) TEST_FLOATING_EQUALITY(principalStress(plane)[k] + 10, s[k] + 10, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(Strength, VonMisesFactorMultipliesTheStressesUpToYield) {
  TEST_EQUALITY(VonMisesStrength(355.0).factor({100.0, 0.0, 0.0}), 3.55);
  TEST_EQUALITY(VonMisesStrength(355.0).factor({0.0, 0.0, -100.0}), 3.55);
  TEST_FLOATING_EQUALITY(VonMisesStrength(355.0).factor({100.0, 0.0, -100.0}), 3.55 / std::sqrt(3.0), 1e-14);  // pure shear
  TEST_EQUALITY(VonMisesStrength(355.0).factor({-80.0, -80.0, -80.0}), kNone);
  States states(100.0);
  for (int i = 0; i < 200; ++i) {
    const PrincipalStress s = states.next();
    const auto isElastic = [&](double t) {  // J_2 <= yield^2 / 3
      const double mean = t * (s[0] + s[1] + s[2]) / 3;
      double j2 = 0.0;
      for (const double one : s) j2 += 0.5 * (t * one - mean) * (t * one - mean);
      return j2 <= 355.0 * 355.0 / 3;
    };
    TEST_FLOATING_EQUALITY(VonMisesStrength(355.0).factor(s), largest(isElastic), kTight);
  }
}

TEUCHOS_UNIT_TEST(Strength, PrincipalStressFactorMultipliesTheStressesUpToFracture) {
  const PrincipalStressStrength iron(250.0, 840.0);
  States states(100.0);
  for (int i = 0; i < 200; ++i) {
    const PrincipalStress s = states.next();
    TEST_FLOATING_EQUALITY(iron.factor(s), largest([&](double t) { return t * s[0] <= 250.0 && t * s[2] >= -840.0; }), kTight);
  }
  TEST_EQUALITY(PrincipalStressStrength(250.0, kNone).factor({-1.0, -2.0, -3.0}), kNone);
  TEST_EQUALITY(iron.factor({0.0, 0.0, 0.0}), kNone);
}

TEUCHOS_UNIT_TEST(Strength, MohrCoulombAgainstTheCriterionInPrincipalStresses) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  States states(20.0);
  for (int i = 0; i < 500; ++i) {
    const double c = 0.1 + 10 * part(engine), phi = i % 10 == 0 ? 0.0 : 1.2 * part(engine),
                 tensile = i % 3 == 0 ? kNone : 0.1 + 3 * part(engine);
    const MohrCoulombStrength rock(c, phi, tensile);
    const double limit = phi > 0 ? std::min(tensile, c / std::tan(phi)) : tensile;
    // s_1 (1 + sin phi) - s_3 (1 - sin phi) <= 2 c cos phi, tension positive
    const auto holds = [&](const PrincipalStress& s) {
      return s[0] * (1 + std::sin(phi)) - s[2] * (1 - std::sin(phi)) <= 2 * c * std::cos(phi);
    };
    const PrincipalStress s = states.next();
    double expected = largest([&](double t) { return holds(blown(s, t)); });
    if (s[0] > 0) expected = std::min(expected, limit / s[0]);
    if (expected < 1e-6) {
      TEST_COMPARE(rock.factor(s), <, 1e-6);
    } else {
      TEST_FLOATING_EQUALITY(rock.factor(s), expected, 1e-8);
    }
    TEST_EQUALITY(rock.factor(s) >= 1.0, holds(s) && s[0] <= limit);
    // On the envelope: N = tan^2(45 + phi / 2), compression s_1 = N s_3 + 2 c sqrt(N).
    const double n = std::pow(std::tan(M_PI / 4 + phi / 2), 2), low = 5 * part(engine);
    TEST_FLOATING_EQUALITY(rock.factor({-low, -low, -(n * low + 2 * c * std::sqrt(n))}), 1.0, kTight);
  }
}

TEUCHOS_UNIT_TEST(Strength, TensionCutOffOfMohrCoulomb) {
  const double c = 1.0, phi = M_PI / 6;
  TEST_FLOATING_EQUALITY(MohrCoulombStrength(c, phi, kNone).tensile(), std::sqrt(3.0), 1e-14);  // the apex
  TEST_EQUALITY(MohrCoulombStrength(c, phi, 5.0).tensile(), MohrCoulombStrength(c, phi, kNone).tensile());
  const MohrCoulombStrength cut(c, phi, 0.4);
  TEST_FLOATING_EQUALITY(cut.factor({0.4, 0.0, 0.0}), 1.0, 1e-14);
  TEST_FLOATING_EQUALITY(cut.factor({0.1, 0.0, 0.0}), 4.0, 1e-14);
  TEST_FLOATING_EQUALITY(cut.factor({0.1, 0.1, 0.1}), 4.0, 1e-14);  // no shear
  TEST_EQUALITY(cut.factor({-3.0, -3.0, -3.0}), kNone);
  TEST_EQUALITY(cut.factor({9.0, 9.0, 8.0}), 0.0);  // mean stress beyond the apex
}

TEUCHOS_UNIT_TEST(Strength, HoekBrownConstantsOfARockMass) {
  // Hoek, Practical Rock Engineering: good quality hard rock, m_i 25, GSI 75: m_b 10.2, s 0.062; intact rock: m_i, 1, 0.5.
  const auto good = HoekBrownStrength::Constants::of(25.0, 75.0, 0.0), intact = HoekBrownStrength::Constants::of(25.0, 100.0, 1.0);
  TEST_FLOATING_EQUALITY(good.m, 10.2, 5e-3);
  TEST_FLOATING_EQUALITY(good.s, 0.062, 5e-3);
  TEST_FLOATING_EQUALITY(good.a, 0.501, 1e-3);
  TEST_EQUALITY(intact.m, 25.0);
  TEST_EQUALITY(intact.s, 1.0);
  TEST_FLOATING_EQUALITY(intact.a, 0.5, 1e-4);
}

TEUCHOS_UNIT_TEST(Strength, HoekBrownAgainstTheCriterionInPrincipalStresses) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  States states(60.0);
  for (int i = 0; i < 500; ++i) {
    const auto rock = HoekBrownStrength::Constants::of(5 + 30 * part(engine), 10 + 90 * part(engine), part(engine));
    const double compressive = 20 + 200 * part(engine);
    const HoekBrownStrength mass(compressive, rock, kNone);
    const double limit = rock.s * compressive / rock.m;
    const auto holds = [&](const PrincipalStress& s) {
      const double base = rock.m * -s[0] / compressive + rock.s;
      return base >= 0 && -s[2] <= -s[0] + compressive * std::pow(base, rock.a);
    };
    const PrincipalStress s = states.next();
    double expected = largest([&](double t) { return holds(blown(s, t)); });
    if (s[0] > 0) expected = std::min(expected, limit / s[0]);
    if (expected < 1e-6) {
      TEST_COMPARE(mass.factor(s), <, 1e-6);
    } else {
      TEST_FLOATING_EQUALITY(mass.factor(s), expected, 1e-8);
    }
    const double low = 40 * part(engine), high = low + compressive * std::pow(rock.m * low / compressive + rock.s, rock.a);
    TEST_FLOATING_EQUALITY(mass.factor({-low, -low, -high}), 1.0, kTight);
    // a = 1/2: with radius r and mean p, 4 r^2 = s_ci^2 (m (p - r) / s_ci + s), a quadratic equation.
    const HoekBrownStrength square(compressive, {rock.m, rock.s, 0.5}, kNone);
    const double p = 80 * part(engine), b = rock.m * compressive;
    const double r = (-b + std::sqrt(b * b + 16 * compressive * (rock.m * p + rock.s * compressive))) / 8;
    TEST_FLOATING_EQUALITY(square.shearAt(p), r, kTight);
  }
  const HoekBrownStrength intact(150.0, {25.0, 1.0, 0.5}, kNone);
  TEST_FLOATING_EQUALITY(intact.factor({0.0, 0.0, -150.0}), 1.0, kTight);  // uniaxial compression
  TEST_FLOATING_EQUALITY(intact.tensile(), 6.0, 1e-14);
  TEST_EQUALITY(HoekBrownStrength(150.0, {25.0, 1.0, 0.5}, 4.0).tensile(), 4.0);
  TEST_EQUALITY(HoekBrownStrength(150.0, {25.0, 0.0, 0.5}, kNone).factor({1.0, 0.0, 0.0}), 0.0);  // s = 0: no tension
}

}  // namespace
}  // namespace suture
