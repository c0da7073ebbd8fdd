#pragma once
#include <string>

namespace suture::proposal {

/// "mm" -> "mm, N, MPa", "m" -> "m, N, Pa", "in" -> "in, lbf, psi"; any other text is unchanged.
std::string completeUnits(const std::string& units);

/// Units of a new scene, and its example material and loads in these units. Units of unknown size are treated as SI;
/// the numbers are placeholders marked FILL IN.
class ExampleUnits {
 public:
  /// \param names  as in the scene: "mm, N, MPa" (length, force, stress)
  explicit ExampleUnits(const std::string& names);

  const std::string& names() const { return names_; }
  double youngModulus() const { return 2.1e11 / stress_; }                        ///< stiffness of steel [stress]
  double pressure() const { return 1e6 / stress_; }                               ///< [stress]
  double weight() const { return 7.7e4 * length_ * length_ * length_ / force_; }  ///< weight of steel [force / length^3]

 private:
  std::string names_;
  double length_, force_, stress_;  // sizes in m, N, Pa
};

}  // namespace suture::proposal
