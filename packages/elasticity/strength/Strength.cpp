#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <suture/elasticity/StressVector.hpp>
#include <suture/elasticity/strength/Strength.hpp>

namespace suture {

namespace {
constexpr double kUnloaded = std::numeric_limits<double>::infinity();
}  // namespace

PrincipalStress principalStress(const Eigen::Ref<const Eigen::RowVectorXd>& stress) {
  PrincipalStress s;
  if (stress.size() == stressComponents<2> || (stress[4] == 0.0 && stress[5] == 0.0)) {
    const double mean = 0.5 * (stress[0] + stress[1]), radius = std::hypot(0.5 * (stress[0] - stress[1]), stress[3]);
    s = {mean + radius, mean - radius, stress[2]};
    std::sort(s.rbegin(), s.rend());
    return s;
  }
  Eigen::Matrix3d tensor;
  for (int c = 0; c < 6; ++c) tensor(kStressAxes[c][0], kStressAxes[c][1]) = tensor(kStressAxes[c][1], kStressAxes[c][0]) = stress[c];
  const Eigen::Vector3d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor, Eigen::EigenvaluesOnly).eigenvalues();
  return {values[2], values[1], values[0]};
}

double vonMises(const PrincipalStress& s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c));
}

double VonMisesStrength::factor(const PrincipalStress& s) const {
  const double equivalent = vonMises(s);
  return equivalent > 0.0 ? yield_ / equivalent : kUnloaded;
}

double PrincipalStressStrength::factor(const PrincipalStress& s) const {
  const double inTension = s[0] > 0.0 ? tensile_ / s[0] : kUnloaded, inCompression = s[2] < 0.0 ? -compressive_ / s[2] : kUnloaded;
  return std::min(inTension, inCompression);
}

double ShearStrength::factor(const PrincipalStress& s) const {
  const double radius = 0.5 * (s[0] - s[2]), inTension = s[0] > 0.0 ? tensile() / s[0] : kUnloaded;
  return radius > 0.0 ? std::min(inTension, shearAt(-0.5 * (s[0] + s[2])) / radius) : inTension;
}

MohrCoulombStrength::MohrCoulombStrength(double cohesion, double angle, double tensile)
    : cohesion_(cohesion), angle_(angle), tensile_(angle > 0.0 ? std::min(tensile, cohesion / std::tan(angle)) : tensile) {}

double MohrCoulombStrength::shearAt(double mean) const { return std::max(0.0, cohesion_ * std::cos(angle_) + mean * std::sin(angle_)); }

HoekBrownStrength::Constants HoekBrownStrength::Constants::of(double intact, double gsi, double disturbance) {
  return {intact * std::exp((gsi - 100.0) / (28.0 - 14.0 * disturbance)), std::exp((gsi - 100.0) / (9.0 - 3.0 * disturbance)),
          0.5 + (std::exp(-gsi / 15.0) - std::exp(-20.0 / 3.0)) / 6.0};
}

HoekBrownStrength::HoekBrownStrength(double compressive, const Constants& constants, double tensile)
    : compressive_(compressive), tensile_(std::min(tensile, constants.s * compressive / constants.m)), of_(constants) {}

double HoekBrownStrength::shearAt(double mean) const {
  // With u = m_b s_3 / s_ci + s, where s_3 = mean - radius: u^a + 2 u / m_b = right. The left side grows and is concave: Newton's method
  // converges from below without passing the root.
  const double slope = 2.0 / of_.m, right = 2.0 * mean / compressive_ + slope * of_.s;
  if (!(right > 0.0)) return 0.0;
  double u = std::min(std::pow(0.5 * right, 1.0 / of_.a), 0.5 * right / slope);  // one of the two terms is at least half
  for (int step = 0; step < 50; ++step) {
    const double power = std::pow(u, of_.a), change = (right - power - slope * u) / (of_.a * power / u + slope);
    if (!(change > 1e-15 * u)) break;
    u += change;
  }
  return 0.5 * compressive_ * std::pow(u, of_.a);
}

}  // namespace suture
