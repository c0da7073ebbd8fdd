#pragma once
#include <suture/base/Types.hpp>

namespace suture {

/// Optional data about a subdomain or a local problem, asked for by name: what a preconditioner may use beside the matrix. Who has none of
/// a name answers without columns, and whoever asks does without. A user's subdomain and preconditioner may agree on names of their own.
struct Hint {
  /// How the values of subdomains that share an unknown become those of their group: added, the largest, or side by side, each subdomain's
  /// columns on its own unknowns.
  enum class Join { Sum, Largest, Columns };

  Matrix values{};  ///< a row an unknown
  Join join = Join::Sum;

  bool empty() const { return values.cols() == 0; }

  /// Young modulus of what lies at each unknown; where several materials meet, the largest: for the weighting Young. [stress] Largest
  static constexpr const char* kYoungModulus = "Young modulus";
  /// The diagonal of the stiffness against change of shape alone, where volume changes much less easily anywhere in the scene. [force /
  /// length] Sum
  static constexpr const char* kShearDiagonal = "shear diagonal";
  /// Volume that a unit of each unknown carries through the seam out of the subdomain of lower number, or through a contact line out of
  /// side A, where volume changes much less easily than shape. [area; axisymmetric: volume] Sum
  static constexpr const char* kSeamFlux = "seam flux";
  /// The motions that cost least, for coarse spaces: their span contains that of the rigid modes. Without the hint these are meant. Columns
  static constexpr const char* kCoarseModes = "coarse modes";
};

}  // namespace suture
