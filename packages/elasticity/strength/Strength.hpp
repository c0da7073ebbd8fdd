#pragma once
#include <suture/base/Errors.hpp>
#include <suture/base/scene/Schema.hpp>

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <vector>

namespace suture {

/// Principal stresses, largest first, tension positive. [stress]
using PrincipalStress = std::array<double, 3>;

/// Principal stresses of a row of elementStresses(), the out-of-plane or hoop stress included. Local.
PrincipalStress principalStress(const Eigen::Ref<const Eigen::RowVectorXd>& stress);

/// The von Mises stress of principal stresses. Local.
double vonMises(const PrincipalStress& s);

/// Strength of an isotropic material: how far a state of stress is from yield or failure. The stresses are total ones, with initial
/// stresses and without pore pressure.
///
/// Invariant, tested for every criterion: the factor is 1 on the surface of failure, above 1 inside, below 1 outside.
class Strength {
 public:
  virtual ~Strength() = default;
  /// As in `Materials/<name>/Strength`.
  virtual std::string name() const = 0;
  /// Safety factor: at least 0; infinity for a state without load. The derived classes define it. Local.
  virtual double factor(const PrincipalStress& s) const = 0;
};

/// Yield of ductile materials: the factor is the yield strength divided by the von Mises stress, by which all stresses could be multiplied.
class VonMisesStrength : public Strength {
 public:
  static constexpr const char* kName = "von Mises";
  explicit VonMisesStrength(double yield) : yield_(yield) {}
  std::string name() const override { return kName; }
  double factor(const PrincipalStress& s) const override;

 private:
  double yield_;
};

/// Fracture of brittle materials (Rankine): the least factor by which all stresses could be multiplied until the largest principal stress
/// is the tensile strength or the smallest is the compressive strength.
class PrincipalStressStrength : public Strength {
 public:
  static constexpr const char* kName = "Principal Stress";
  /// \param compressive  infinity: crushing is not checked
  PrincipalStressStrength(double tensile, double compressive) : tensile_(tensile), compressive_(compressive) {}
  std::string name() const override { return kName; }
  double factor(const PrincipalStress& s) const override;

 private:
  double tensile_, compressive_;
};

/// Criteria of rock, soil and concrete. The factor is the smaller of two ratios of strength to stress:
///   shear: the radius of the largest Mohr circle that the envelope allows about the centre (s_1 + s_3) / 2, over the radius (s_1 - s_3) /
///   2; tension: the tensile strength over s_1, if s_1 is tensile.
/// The first is the strength factor of elastic analyses of excavations: the deviator grows at constant mean stress (of s_1 and s_3), so
/// that a hydrostatic initial stress does not count as a load.
class ShearStrength : public Strength {
 public:
  double factor(const PrincipalStress& s) const override;

  /// Largest shear stress (radius of a Mohr circle) at the mean stress `mean` of the largest and the smallest principal stress, compression
  /// positive; 0 beyond the apex. [stress]
  virtual double shearAt(double mean) const = 0;
  /// Tensile strength. [stress]
  virtual double tensile() const = 0;
};

/// Mohr-Coulomb: shear stress <= cohesion + pressure tan(friction angle) on every plane, so that the radius is
/// cohesion cos(phi) + mean sin(phi); the tensile strength is at most that of the apex, cohesion / tan(phi).
class MohrCoulombStrength : public ShearStrength {
 public:
  static constexpr const char* kName = "Mohr-Coulomb";
  /// \param angle  of friction [rad], in [0, pi/2);  \param tensile  infinity: that of the apex
  MohrCoulombStrength(double cohesion, double angle, double tensile);
  std::string name() const override { return kName; }
  double shearAt(double mean) const override;
  double tensile() const override { return tensile_; }

 private:
  double cohesion_, angle_, tensile_;
};

/// Generalised Hoek-Brown (Hoek, Carranza-Torres, Corkum 2002), compression positive: s_1 = s_3 + s_ci (m_b s_3 / s_ci + s)^a. The tensile
/// strength is at most s s_ci / m_b.
class HoekBrownStrength : public ShearStrength {
 public:
  static constexpr const char* kName = "Hoek-Brown";
  /// Constants of the rock mass.
  struct Constants {
    double m = 0.0, s = 1.0, a = 0.5;
    /// m_b = m_i exp((GSI - 100) / (28 - 14 D)), s = exp((GSI - 100) / (9 - 3 D)), a = 1/2 + (exp(-GSI / 15) - exp(-20 / 3)) / 6.
    static Constants of(double intact, double gsi, double disturbance);
  };
  /// \param compressive  uniaxial strength of the intact rock [stress];  \param tensile  infinity: s s_ci / m_b
  HoekBrownStrength(double compressive, const Constants& constants, double tensile);
  std::string name() const override { return kName; }
  double shearAt(double mean) const override;
  double tensile() const override { return tensile_; }

 private:
  double compressive_, tensile_;
  Constants of_;
};

/// Adds the parameters of strength to the schema of a material.
void addStrengthParameters(Schema& material);

/// The strength of a material; null if it has none. Local.
/// \param material  entry of `Materials`  \param problems  receives missing and contradictory values
std::shared_ptr<const Strength> strengthOf(const Parameters& material, Problems& problems);

}  // namespace suture
