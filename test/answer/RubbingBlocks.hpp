#pragma once
#include <answer/SolidScenes.hpp>

/// Answers with friction that are known by hand, in 2D and 3D. Nothing is solved.
namespace suture::solids {

/// Coupling between the sides of a contact.
enum class Rubs { Slip, TrescaSlip, Stick, Glued, Guided };

/// Two stacked blocks, or one on a rigid obstacle, of a material with zero Poisson's ratio, pressed together and sheared by a traction
/// along the joint: the stress is uniform, displacements are linear. Where the joint slips the upper block lies further along the traction.
/// Glued and guided blocks are pulled apart; guided ones (No Separation) without shear, slid by a displacement.
struct RubbingBlocks {
  Rubs way;
  bool onObstacle;
  int dimension;
  Scene scene;
  std::vector<SubdomainMesh> meshes;
  std::vector<Vector> displacement;
  std::vector<PairResult> pairs;  ///< on rank 0
  double tolerance = 1e-8;
  Eigen::Matrix3d frame;
  Point along;  ///< unit vector of the traction on the upper block's top, in the frame of the blocks

  static constexpr double young = 200.0, slid = 1e-3;

  RubbingBlocks(Rubs way, int dimension, bool onObstacle = false, const Eigen::Matrix3d& frame = Eigen::Matrix3d::Identity());

  double pressure() const { return way == Rubs::Glued || way == Rubs::Guided ? -0.5 : 0.5; }
  double shear() const { return way == Rubs::Guided ? 0.0 : 0.13; }
  bool slides() const { return way != Rubs::Stick && way != Rubs::Glued; }
  /// Force on side B per unit area of the joint, Cartesian.
  Point tangential() const { return frame * scaled(onObstacle ? shear() : -shear(), along); }
  int upper() const { return onObstacle ? 0 : 1; }

  Verification verdict() const;
  /// Applies change(displacement) to all nodes of the upper block, in the frame of the blocks.
  void moveUpper(const std::function<void(Point& u)>& change);
  /// The same motion of the whole upper block, taken out of its displacements (SubdomainMesh::lift).
  void lift();

 private:
  Point displacementAt(const Point& place, bool isUpper) const;
  void makeScene();
  void makePairs();
};

}  // namespace suture::solids
