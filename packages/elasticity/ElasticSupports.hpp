#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/SideGroups.hpp>

#include <map>
#include <vector>

namespace suture {

/// The elastic supports on the sides of a block: integrals over each side of N_a N_b (normal n n^T + tangential (1 - n n^T)), n the outward
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
    Vector nodal;             ///< node-major, Cartesian [force]
    Vector stiffness;         ///< of each node when it alone moves by one [force / length]
    Point onBody{0, 0, 0};    ///< sum of the supports' forces on the block: opposite to the nodal ones
    double magnitudes = 0.0;  ///< sum of their magnitudes over the sides
  };
  /// \param displacement  node-major, Cartesian
  Forces forces(const Vector& displacement) const;

 private:
  struct OnSide {
    std::vector<int> nodes;   // of the block
    std::vector<int> places;  // in the element
    Matrix stiffness;
  };
  const CellBlock& block_;
  std::multimap<int, OnSide> sides_;  // by element
};

/// elementStiffnesses() with the model's elastic supports on the block's sides.
void supportedStiffnesses(const CellBlock& block, const SideGroups& groups, const std::function<const Material&(int element)>& materialOf,
                          const ElasticModel& model, const std::function<void(int element, ConstLocalView stiffness)>& take);

}  // namespace suture
