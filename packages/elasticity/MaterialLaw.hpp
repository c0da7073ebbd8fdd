#pragma once
#include <suture/base/Registry.hpp>

#include <Eigen/Core>
#include <optional>

namespace suture {

/// Stiffness of a linear elastic material in 3D: stresses from strains, both in the order xx, yy, zz, xy, yz, xz, with engineering shear
/// strains (2 e_xy). In axisymmetric scenes x is the radius, y the axis, z the hoop direction. [stress]
using ElasticStiffness = Eigen::Matrix<double, 6, 6>;

/// Young modulus [stress] and Poisson ratio [-].
struct IsotropicModuli {
  double young = 0.0;
  double poisson = 0.0;
};

/// Linear elastic law of a material with any anisotropy. Created by name, `Materials/<name>/Type`; its parameters are in the sublist of
/// that name, those of Isotropic next to `Type`. Elements, stresses, recovery, estimates, the verdict, Monolithic and fields use
/// stiffness() only.
///
/// To add a law, derive from this class and implement doStiffness().
class MaterialLaw {
 public:
  static const char* kind() { return "material law"; }
  virtual ~MaterialLaw() = default;

  /// Symmetric. \throws InputError  if it is not finite, not symmetric or not positive definite, with the reason. Local.
  ElasticStiffness stiffness() const;

  /// The two moduli if they define the law completely; elements use the plane forms of this case. Local.
  virtual std::optional<IsotropicModuli> isotropic() const { return std::nullopt; }

 protected:
  virtual ElasticStiffness doStiffness() const = 0;
};

/// A law given by its stiffness, for scenes built in C++.
class GivenLaw : public MaterialLaw {
 public:
  explicit GivenLaw(const ElasticStiffness& stiffness) : stiffness_(stiffness) {}

 protected:
  ElasticStiffness doStiffness() const override { return stiffness_; }

 private:
  ElasticStiffness stiffness_;
};

void registerBuiltIns(Registry<MaterialLaw>& registry);

/// lambda m m^T + 2 mu I, shear mu. Local.
ElasticStiffness isotropicStiffness(const IsotropicModuli& moduli);

/// Isotropic moduli nearest to a stiffness: Voigt's means of the bulk and shear moduli over all directions. They represent a material with
/// another law where a single number is needed: weights, the softer side of a contact, locking. Exact for an isotropic stiffness. Local.
IsotropicModuli nearestIsotropic(const ElasticStiffness& stiffness);

/// Mean of the couplings between normal strains: Lame's constant of an isotropic stiffness. [stress] Local.
double meanCoupling(const ElasticStiffness& stiffness);

/// In-plane part: rows and columns xx, yy, zz, xy. \throws InputError  if in-plane strains are coupled with out-of-plane shear, so that a
/// 2D problem would not stay plane. Local.
Eigen::Matrix4d planePart(const ElasticStiffness& stiffness);

/// The same stiffness in the axes of the scene. \param axes  columns: the material's axes, orthonormal. Local.
ElasticStiffness turned(const ElasticStiffness& stiffness, const Eigen::Matrix3d& axes);
/// The same for a material rotated by `angle` about z, anticlockwise from x. [rad] Local.
ElasticStiffness turned(const ElasticStiffness& stiffness, double angle);

}  // namespace suture
