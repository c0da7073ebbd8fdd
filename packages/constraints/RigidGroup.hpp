#pragma once
#include <suture/base/Types.hpp>

#include <array>
#include <optional>
#include <unordered_map>
#include <vector>

namespace suture {

/// Nodes that move as one rigid body, by a condition `Rigid Group`. The motions that nothing prescribes are unknowns: components of some of
/// the nodes, the masters (at most six; in 2D three). Every other component of the nodes follows: it is the value of its NodeRule plus a
/// linear combination of the masters. All nodes have a rule with the axes of the group, which fixes all components except masters.
struct RigidGroup {
  int condition = -1;    ///< index in Constraints::conditions
  Point point{0, 0, 0};  ///< reference point
  /// Prescribed displacements of the point [length] and rotations [radians], as Condition::motions, and the number of their factor; on rank
  /// 0.
  std::array<std::optional<double>, 6> motions{};
  int factor = 0;
  Point moved{0, 0, 0};               ///< displacement of that point from the drawn body to the mesh, for bodies that move far [length]
  Point turned{0, 0, 0};              ///< rotation vector of the body, likewise [radians]
  std::vector<int> nodes;             ///< ascending
  std::vector<int> masterNodes;       ///< node of each master
  std::vector<int> masterComponents;  ///< component of each master
  /// On a body that moves far: two nodes, in 3D three, that determine the position of the group. The masters are among them wherever the
  /// body is, and a subdomain with a node of the group has all of them, so that no motion changes the nodes of subdomains. Else empty.
  std::vector<int> positionNodes;
  /// Axes of the components: Cartesian, or those of the drawn body, turned with it.
  std::array<Point, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::vector<double> coefficients;  ///< by node, component and master: derivative of the component; for a master itself 1 and 0

  int masters() const { return static_cast<int>(masterNodes.size()); }
  /// Derivatives of a component with respect to the masters. \param place  index in nodes
  const double* row(std::size_t place, int component, int dimension) const {
    return coefficients.data() + (place * static_cast<std::size_t>(dimension) + static_cast<std::size_t>(component)) * masterNodes.size();
  }

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.condition), each(self.point), each(self.moved), each(self.turned), each(self.nodes), each(self.masterNodes),
        each(self.masterComponents), each(self.positionNodes), each(self.axes), each(self.coefficients);
  }
};

/// Finds the rigid group of a node. Local; the groups must outlive it.
class RigidGroupNodes {
 public:
  RigidGroupNodes() = default;
  RigidGroupNodes(const std::vector<RigidGroup>& groups, int dimension);

  bool empty() const { return placeOf_.empty(); }
  bool contains(int node) const { return !placeOf_.empty() && placeOf_.count(node) > 0; }
  /// Calls each(node, component, coefficient) for every master that a component follows; none for nodes outside of rigid groups. A master
  /// follows itself.
  template <typename Each>
  void forEachMaster(int node, int component, const Each& each) const {
    if (placeOf_.empty()) return;
    const auto found = placeOf_.find(node);
    if (found == placeOf_.end()) return;
    const RigidGroup& group = *found->second.group;
    const double* row = group.row(found->second.place, component, dimension_);
    for (int m = 0; m < group.masters(); ++m)
      if (row[m] != 0.0) each(group.masterNodes[static_cast<std::size_t>(m)], group.masterComponents[static_cast<std::size_t>(m)], row[m]);
  }
  /// Axis of a component of a node in a group.
  const Point& axis(int node, int component) const { return placeOf_.at(node).group->axes[static_cast<std::size_t>(component)]; }
  /// True if the component of a node is a master.
  bool isMaster(int node, int component) const;
  /// True if the node is in a group of which some motion is free.
  bool moves(int node) const;

 private:
  struct Place {
    const RigidGroup* group;
    std::size_t place;
  };
  std::unordered_map<int, Place> placeOf_;
  int dimension_ = 2;
};

}  // namespace suture
