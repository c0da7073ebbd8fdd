#pragma once
#include <string>

namespace suture {

/// Consistent units of length, force and stress, with the second and the kelvin: masses are in force x s^2 / length.
struct UnitSystem {
  double length = 1.0;  ///< metres in a unit
  double force = 1.0;   ///< newtons in a unit
  double stress = 1.0;  ///< pascals in a unit

  /// \param names  a scene's `Units`: "mm, N, MPa"
  /// \throws InputError  with the path "Units": a name is unknown or missing, with the known names; or the stress is not force / length^2
  static UnitSystem named(const std::string& names);

  /// SI value of one unit of a quantity: "" (a number), "length", "force", "stress", "mass / volume", "1 / temperature".
  /// \throws InputError  for another quantity
  double unitOf(const std::string& quantity) const;
};

/// A value in other units, rounded to 15 digits: 7850 kg/m^3 are 7.85e-9 t/mm^3. Unchanged if both units are equal.
double converted(double value, const std::string& quantity, const UnitSystem& from, const UnitSystem& to);

}  // namespace suture
