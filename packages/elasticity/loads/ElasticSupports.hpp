#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/SideGroups.hpp>

#include <functional>
#include <map>
#include <vector>

namespace suture {

/// Elastic supports on the sides of a block: integrals over each side of N_a N_b (normal n n^T + tangential (1 - n n^T)), n the outward
/// normal at each point; per unit thickness in the plane, of the whole circle in axisymmetric blocks. Local.
class ElasticSupports {
 public:
  /// \param groups  side groups of the block
  ElasticSupports(const CellBlock& block, const SideGroups& groups, const ElasticModel& model);

  bool empty() const { return sides_.empty(); }
  /// Adds the stiffness of an element's sides to the element's, in Cartesian components, node-major.
  void addStiffness(int element, LocalView stiffness) const;

  /// Forces that displaced nodes need against the supports.
  struct Forces {
    Vector nodal;      ///< node-major, Cartesian [force]
    Vector stiffness;  ///< stiffness of each node when it alone moves by one [force / length]
    Vector rounding;   ///< rounding of each node's force [force]
  };
  /// \param displacement  node-major, Cartesian
  Forces forces(const Vector& displacement) const;

  /// The supports' forces on the block, one support after the other: take(number, forces) for every support of the model that acts on the
  /// block, the forces node-major, Cartesian, and valid during the call only.
  void forEachSupport(const Vector& displacement, const std::function<void(int number, const Vector& forces)>& take) const;

 private:
  struct OnSide {
    std::vector<int> nodes;   // numbers in the block
    std::vector<int> places;  // in the element
    int support;              // place in ElasticModel::supports
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
