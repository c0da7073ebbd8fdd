#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/motion/BodyFrame.hpp>
#include <suture/motion/RigidMotion.hpp>

#include <map>
#include <vector>

namespace suture {

/// Bodies of a scene that move far while their strains stay small: a frame and the displacements beside it for each connected part of a
/// body. A solution is linear in the displacements from the placed mesh; absorb() makes its rigid motion a finite one. Local (rank 0).
class MovingBodies {
 public:
  MovingBodies() = default;
  /// \throws InputError  two rigid groups on one part that moves
  /// \param drawn  must outlive it \param constraints  of the drawn mesh: its rigid groups and fixed nodes determine the frames of their
  /// parts \param rests  by body: it stays near its drawn place, and its frames stay where they are; empty: none
  MovingBodies(const Mesh& drawn, const Constraints& constraints, std::vector<bool> rests = {});

  /// The mesh at the frames, without strain.
  Mesh placed() const;
  /// The mesh in its present shape.
  Mesh present() const;
  /// Displacements from the drawn to the placed mesh: node-major [length].
  Vector placement() const;
  /// Displacements from the placed to the present mesh: node-major [length].
  const Vector& beside() const { return beside_; }

  /// Frame of the part of a node.
  const BodyFrame& frameOf(int node) const { return frames_[static_cast<std::size_t>(partOf_[static_cast<std::size_t>(node)])]; }
  const std::vector<BodyFrame>& frames() const { return frames_; }
  /// Body of each part.
  const std::vector<int>& bodies() const { return bodies_; }
  int partOf(int node) const { return partOf_[static_cast<std::size_t>(node)]; }

  /// Rigid motion: a shift, and a rotation vector about a point of space.
  struct Motion {
    Point shift{0, 0, 0}, rotation{0, 0, 0}, about{0, 0, 0};
  };
  /// True if the frame of a part stays where it is drawn.
  bool rests(int part) const { return rests_[static_cast<std::size_t>(part)]; }
  /// True if conditions prescribe all displacements of the nodes that determine the frame of a part.
  bool isHeld(int part) const { return gauges_[static_cast<std::size_t>(part)].isHeld; }
  /// The rigid motion that fits displacements from the placed mesh at the nodes that determine the frame of a part; none if it rests.
  Motion motionOf(int part, const Vector& displacement) const;
  /// Motion of each part since these bodies were elsewhere, about the place of its centre then.
  std::vector<Motion> motionsFrom(const MovingBodies& before) const;
  /// Moves a part that does not rest, with its displacements: see BodyFrame::move().
  void move(int part, const Motion& motion);
  /// Forces on the nodes that determine the frame of a part whose sum is zero and whose moment about any point of the placed body is given:
  /// by node.
  std::map<int, Point> couple(int part, const Point& moment) const;
  /// Takes over frames, by part, and displacements beside them from a file. False, without a change, if their numbers are others.
  bool goOnFrom(const std::vector<BodyFrame>& frames, const std::vector<double>& beside);
  /// Makes the displacements of a solution, from the placed mesh, the present ones, and their rigid parts finite motions of the frames.
  void absorb(const Vector& displacement);
  /// Places these bodies between their places in `from` (part = 0) and their present places (part = 1).
  void goPartOfTheWay(const MovingBodies& from, double part);

 private:
  /// Nodes whose motion is that of the frame, with weights.
  struct Gauge {
    std::vector<int> nodes;
    std::vector<double> weights;
    bool isHeld = false;
  };
  Point centreOf(std::size_t part) const;
  Matrix inertiaOf(std::size_t part, const Point& centre) const;
  Mesh meshAt(const Vector& displacement) const;

  const Mesh* drawn_ = nullptr;
  std::vector<int> partOf_, bodies_;
  std::vector<bool> rests_;  // by part
  std::vector<Gauge> gauges_;
  std::vector<BodyFrame> frames_;
  Vector beside_;
};

}  // namespace suture
