#pragma once
#include <Teuchos_DefaultComm.hpp>
#include <support/SmallScenes.hpp>
#include <suture/answer/verdict/Verify.hpp>
#include <suture/partition/Partition.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <Eigen/Geometry>

#include <functional>
#include <string>

/// 3D bodies with answers known by hand, for tests of the answer checks. Nothing is solved.
namespace suture::solids {

using scenes::Scene;
using Field = std::function<Point(const Point&)>;

inline CommPtr world() { return Teuchos::DefaultComm<int>::getComm(); }

const std::vector<Cell>& cells();
inline int orderOf(Cell cell) { return cellInfo(cell).order; }

/// Rotation by an angle about an axis.
Eigen::Matrix3d rotation(const Point& axis, double angle);
Point operator*(const Eigen::Matrix3d& matrix, const Point& p);

/// [0, 1]^3 of n cells along each axis, cut into blocks^3 named subdomains.
Box cube(Cell cell, int n, int blocks = 1);
Scene fromBoxes(const std::vector<Box>& boxes, double young, double poisson);

/// Moves the nodes inside the boxes together with the middles of edges: straight edges stay straight. \param bend  moves middle nodes
/// independently, too
void distort(Mesh& mesh, double size, bool bend = false);

/// The whole scene under x -> R x + shift. Rules get the rotated axes.
Scene turned(Scene scene, const Eigen::Matrix3d& rotation, const Point& shift);

std::vector<SubdomainMesh> distributed(const Scene& scene, const CommPtr& comm = world());
std::vector<Vector> atNodes(const std::vector<SubdomainMesh>& meshes, const Field& field);
Vector atNodes(const CellBlock& block, const Field& field);

/// Two stacked blocks, [0, 1]^2 x [-1, 0] and [0, 1]^2 x [0, 1], pressed together by a pressure on top. Rollers on three sides: the stress
/// is uniform, and displacements are linear.
struct PressedBlocks {
  Scene scene;
  std::vector<SubdomainMesh> meshes;
  std::vector<Vector> displacement;
  std::vector<PairResult> pairs;  ///< on rank 0
  double tolerance = 1e-8;
  Eigen::Matrix3d frame;
  Point origin;

  static constexpr double young = 200.0, poisson = 0.3, pressure = 0.5;

  PressedBlocks(Cell cell, const Eigen::Matrix3d& frame, const Point& origin);

  Verification verdict() const;
  /// Applies change(place in the frame of the blocks, displacement) to all nodes of a body.
  void move(int body, const std::function<void(const Point& place, Point& u)>& change);
};

}  // namespace suture::solids
