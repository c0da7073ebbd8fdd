#pragma once
#include <suture/answer/bound/BoundElements.hpp>

#include <vector>

namespace suture {

/// A side with four vertices of a cell in 3D, cut into two triangles along a diagonal: the functions of the cell's nodes on the side
/// (bilinear map) and those of the triangles' nodes, as integrals with the normal. Local.
///
/// Nodes of the triangles: those of the side, without its centre, then for degree 2 the middle of the diagonal (newNode()). Both sets of
/// functions sum to one, and with the places of their nodes to the place. On a plane side, therefore, the forces of a linear stress on both
/// sets of nodes have the same resultants; on a warped side those of a constant stress.
class SplitSide {
 public:
  /// Integrals of a node's function times the normal, and times the place relative to centre(): 3 x 4.
  using Moment = Eigen::Matrix<double, 3, 4>;

  /// \param points  nodes of the side in the order of SideGeometry.hpp, seen from outside \param isOdd  the diagonal is (1, 3), not (0, 2)
  SplitSide(const std::vector<Point>& points, bool isOdd);

  int nodes() const { return int(ofCell_.size()); }
  int order() const { return nodes() == 4 ? 1 : 2; }
  /// Number of the middle of the diagonal among the nodes of the triangles; none for degree 1.
  int newNode() const { return nodes(); }
  const Eigen::Vector3d& centre() const { return centre_; }  ///< mean of the vertices
  bool isPlane() const { return isPlane_; }
  /// Vertices of the triangles, counter-clockwise from outside, then the middles of their edges (0, 1), (1, 2), (0, 2).
  const std::array<int, 6>& triangle(int t) const { return triangles_[t]; }
  double area(int t) const { return areas_[t]; }

  const std::vector<Moment>& ofCell() const { return ofCell_; }
  const std::vector<Moment>& ofTriangles() const { return ofTriangles_; }
  /// Force of a stress on a node. \param linear  false: without its derivatives
  static Eigen::Vector3d force(const LinearStress& stress, const Moment& moment, bool linear);

  /// Volume between the bilinear side and the triangles, positive if the cell is larger than its tetrahedra there, and the integral of the
  /// place relative to centre() over it. Zero for a plane side.
  double lens() const { return lens_; }
  const Eigen::Vector3d& lensMoment() const { return lensMoment_; }

 private:
  void addTriangles(const std::vector<Point>& points);
  void addCell(const std::vector<Point>& points);

  Eigen::Vector3d centre_;
  bool isPlane_ = true;
  std::array<std::array<int, 6>, 2> triangles_;
  std::array<double, 2> areas_{};
  std::vector<Moment> ofCell_, ofTriangles_;
  double lens_ = 0.0;
  Eigen::Vector3d lensMoment_ = Eigen::Vector3d::Zero();
};

}  // namespace suture
