#pragma once
#include <suture/base/Registry.hpp>

#include <Eigen/Core>
#include <optional>

namespace suture {

/// Stiffness of a linear elastic material in three dimensions: stresses from strains, both in the order xx, yy, zz, xy, yz, xz, shear
/// strains being those of the engineer (2 e_xy). In axisymmetric scenes x is the radius, y the axis, z the hoop. [stress]
using ElasticStiffness = Eigen::Matrix<double, 6, 6>;

/// Young modulus [stress] and Poisson ratio [-].
struct IsotropicModuli {
  double young = 0.0;
  double poisson = 0.0;
};

/// The law of a material: linear elastic, of whatever anisotropy. Made by name, `Materials/<name>/Type`; its parameters stand in the list
/// of that name, but those of Isotropic beside `Type`. Elements, stresses, recovery, estimates, the verdict, Monolithic and fields follow
/// from stiffness() alone.
///
/// A law of a user's own: derive, and write doStiffness().
class MaterialLaw {
 public:
  static const char* kind() { return "material law"; }
  virtual ~MaterialLaw() = default;

  /// Symmetric. \throws InputError  it is not finite, not symmetric or not positive definite: says which. Local.
  ElasticStiffness stiffness() const;

  /// The two moduli, if they are all that there is to the law: elements know the plane forms of this case. Local.
  virtual std::optional<IsotropicModuli> isotropic() const { return std::nullopt; }

 protected:
  virtual ElasticStiffness doStiffness() const = 0;
};

/// A law given by its stiffness: for scenes that are built in C++.
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

/// The isotropic moduli that come nearest to a stiffness: Voigt's means of the bulk and the shear modulus over all directions. They stand
/// for a material of another law where one number is asked for: weights, the softer side of a contact, what locks. Exact for an isotropic
/// stiffness. Local.
IsotropicModuli nearestIsotropic(const ElasticStiffness& stiffness);

/// Mean of the couplings between normal strains: Lame's constant of an isotropic stiffness. [stress] Local.
double meanCoupling(const ElasticStiffness& stiffness);

/// The part that acts in the plane: rows and columns xx, yy, zz, xy. \throws InputError  the strains in the plane are coupled with the
/// shear across it, so that a plane problem would not stay in its plane. Local.
Eigen::Matrix4d planePart(const ElasticStiffness& stiffness);

/// The same stiffness in axes of the scene. \param axes  columns: the material's axes, unit vectors at right angles. Local.
ElasticStiffness turned(const ElasticStiffness& stiffness, const Eigen::Matrix3d& axes);
/// The same of a material turned by `angle` about z, anticlockwise from x. [rad] Local.
ElasticStiffness turned(const ElasticStiffness& stiffness, double angle);

}  // namespace suture
