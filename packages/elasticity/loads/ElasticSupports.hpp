#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/SideGroups.hpp>

#include <functional>
#include <map>
#include <vector>

namespace suture {

/// Elastic supports on the sides of a block: integrals over each side of N_a N_b (normal n n^T + tangential (1 - n n^T)), n the outward
/// normal at each point; per unit thickness in 2D, of the whole circle in axisymmetric blocks. Local.
class ElasticSupports {
 public:
  /// \param groups  side groups of the block
  ElasticSupports(const CellBlock& block, const SideGroups& groups, const ElasticModel& model);

  bool empty() const { return sides_.empty(); }
  /// Adds the stiffness of the supports on an element's sides to its stiffness matrix, in Cartesian components, node-major.
  void addStiffness(int element, LocalView stiffness) const;

  /// Forces needed to displace the nodes against the supports.
  struct Forces {
    Vector nodal;      ///< node-major, Cartesian [force]
    Vector stiffness;  ///< stiffness of each node for a unit displacement of this node alone [force / length]
    Vector rounding;   ///< round-off of each node's force [force]
  };
  /// \param displacement  node-major, Cartesian
  Forces forces(const Vector& displacement) const;

  /// Forces of the supports on the block, one support after the other: calls take(number, forces) for every support of the model that acts
  /// on the block; forces are node-major, Cartesian, and valid during the call only.
  void forEachSupport(const Vector& displacement, const std::function<void(int number, const Vector& forces)>& take) const;

 private:
  struct OnSide {
    std::vector<int> nodes;   // numbers in the block
    std::vector<int> places;  // local numbers in the element
    int support;              // index in ElasticModel::supports
    Matrix stiffness;
  };
  Vector forceOf(const OnSide& side, const Vector& displacement) const;
  // Components of a nodal vector at a node.
  template <typename Nodal>
  auto ofNode(Nodal& vector, int node) const {
    return vector.segment(Eigen::Index(node) * block_.dimension, block_.dimension);
  }

  const CellBlock& block_;
  std::multimap<int, OnSide> sides_;  // by element
};

/// elementStiffnesses() with the model's elastic supports on the block's sides.
void supportedStiffnesses(const CellBlock& block, const SideGroups& groups, const std::function<const Material&(int element)>& materialOf,
                          const ElasticModel& model, const std::function<void(int element, ConstLocalView stiffness)>& take);

}  // namespace suture
