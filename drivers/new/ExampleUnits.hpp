#pragma once
#include <string>

namespace suture::proposal {

/// Units of a new scene, and the numbers of its example material and loads in them. A unit without a known size is taken as that of SI:
/// these numbers are marked FILL IN.
class ExampleUnits {
 public:
  /// \param names  as the scene has them: "mm, N, MPa" (length, force, stress)
  explicit ExampleUnits(const std::string& names);

  const std::string& names() const { return names_; }
  double youngModulus() const { return 2.1e11 / stress_; }                        ///< of steel [stress]
  double pressure() const { return 1e6 / stress_; }                               ///< [stress]
  double weight() const { return 7.7e4 * length_ * length_ * length_ / force_; }  ///< of steel [force / length^3]

 private:
  std::string names_;
  double length_, force_, stress_;  // sizes in m, N, Pa
};

}  // namespace suture::proposal
