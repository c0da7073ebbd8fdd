#pragma once
#include <suture/base/Types.hpp>

namespace suture {

/// Optional data about a subdomain or a local problem, requested by name: data that a preconditioner may use in addition to the matrix. If
/// there are none, the hint has no columns, and the preconditioner works without it. A user's subdomain and preconditioner may use their
/// own names.
struct Hint {
  /// How the values of subdomains that share an unknown combine to those of their group: sum, maximum, or separate columns, those of each
  /// subdomain on its own unknowns.
  enum class Join { Sum, Largest, Columns };

  Matrix values{};  ///< one row per unknown
  Join join = Join::Sum;

  bool empty() const { return values.cols() == 0; }

  /// Young modulus of the material at each unknown, the largest where several materials meet: for the weighting Young. [stress] Largest
  static constexpr const char* kYoungModulus = "Young modulus";
  /// Diagonal of the stiffness against change of shape alone, if anywhere in the scene volume changes much less easily. [force / length]
  /// Sum
  static constexpr const char* kShearDiagonal = "shear diagonal";
  /// Volume that a unit displacement of each unknown moves through the seam out of the subdomain of lower number, or through a contact line
  /// out of side A, where volume changes much less easily than shape. [area; axisymmetric: volume] Sum
  static constexpr const char* kSeamFlux = "seam flux";
  /// Motions of lowest energy, for coarse spaces; their span contains the rigid-body modes, which are used if the hint is missing. Columns
  static constexpr const char* kCoarseModes = "coarse modes";
};

}  // namespace suture
