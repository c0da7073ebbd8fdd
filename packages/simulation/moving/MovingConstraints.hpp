#pragma once
#include <suture/motion/MovingBodies.hpp>
#include <suture/simulation/Scene.hpp>
#include <suture/simulation/moving/SlipHistory.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// Constraints of bodies that move far, for displacements from the placed mesh (MovingBodies): prescribed places instead of displacements,
/// rigid groups that turn about their present points, and contact pairs found between the present shapes. Local (rank 0).
class MovingConstraints {
 public:
  /// The scene and the mesh must outlive it. \param constraints  of the drawn mesh
  MovingConstraints(const Scene& scene, const Mesh& drawn, Constraints constraints);

  /// Moves bodies to the places that rigid groups and displacements prescribe at a time: the start of the first round of a step.
  void drive(double time, MovingBodies& bodies) const;
  /// \param present  the bodies' present mesh \param choices  see buildConstraints() \throws InputError  as buildConstraints(), as if a
  /// contact has no facing sides any more
  Constraints at(double time, const MovingBodies& bodies, const Mesh& present, const SlipHistory& history, KeptChoices& choices) const;
  /// Contact pairs of the shapes of a mesh, with their gaps there. \param choices  see buildConstraints()
  std::vector<ContactPair> pairsOf(double time, const MovingBodies& bodies, const Mesh& present, KeptChoices choices) const;

 private:
  /// Motion of a rigid group that its condition still requires, about a present point; components that it leaves free are zero.
  struct Drive {
    Point drawn{0, 0, 0}, point{0, 0, 0}, shift{0, 0, 0}, turn{0, 0, 0};
    bool turnsAlong = false;  ///< the free motions turn with the body
  };
  using Drives = std::map<std::string, Drive>;  // by name of the condition

  /// Motions that rigid groups lack at a time. \param factors  of loads and motions at that time
  Drives drivesAt(const std::vector<double>& factors, const MovingBodies& bodies) const;
  /// Constraints of the present mesh, as if it were drawn so.
  Constraints ofPresent(const Mesh& present, const Drives& drives, KeptChoices& choices) const;
  Drive driveOf(const RigidGroup& group, const std::vector<double>& factors, const MovingBodies& bodies) const;
  /// Displacements that conditions prescribe at the nodes of the drawn mesh, from their drawn places, by node.
  std::map<int, Point> prescribedAt(const std::vector<double>& factors) const;
  std::vector<NodeRule> fromDrawn(std::vector<NodeRule> rules, const MovingBodies& bodies) const;
  NodeRule heldRule(const NodeRule& drawn, const Point& given, const MovingBodies& bodies) const;
  void setRules(const std::vector<double>& factors, const MovingBodies& bodies, const Mesh& present, const Drives& drives,
                Constraints& constraints) const;
  void setGroups(const MovingBodies& bodies, const Mesh& present, const Drives& drives, std::map<int, NodeRule>& rules,
                 Constraints& constraints) const;

  const Scene& scene_;
  const Mesh& drawn_;
  Constraints ofDrawn_;
  std::vector<int> touching_;  // nodes of the sides in contact, ascending
};

}  // namespace suture
