#pragma once
#include <suture/answer/bound/StarMesh.hpp>

namespace suture {

/// Basis of the tractions on a face in 3D: for unit resultants (force, moment about the centroid), and without resultants.
/// \tparam K  degree of the tractions, 1 or 2
template <int K>
struct FaceTractions {
  static constexpr int nodes = K == 1 ? 3 : 6;
  static constexpr int count = 3 * nodes;     ///< tractions at the nodes: 3 node + component
  static constexpr int balanced = count - 6;  ///< at most so many without resultants
  using Basis = Eigen::Matrix<double, count, count>;
  using Wrenches = Eigen::Matrix<double, 6, 6>;

  Eigen::Vector3d centre;
  double area = 0.0, size = 0.0;  ///< size: length by which moments are divided
  /// Columns: six for the resultants over `area` and `size`, of least norm if a boundary condition excludes tractions; then orthonormal
  /// ones without resultants. Zero where there are none.
  Basis basis;
  bool isFree = false;        ///< some traction can change
  bool isRestricted = false;  ///< not all resultants are possible
  Wrenches possible;          ///< projection onto the possible resultants

  FaceTractions(const StarMesh<3>& mesh, int side);
};

}  // namespace suture
