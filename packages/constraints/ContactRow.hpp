#pragma once
#include <suture/constraints/Constraints.hpp>

#include <vector>

namespace suture {

struct Mesh;

/// The condition (u_A - u_B) . n <= gap of one contact pair in the free unknowns of its nodes, whatever their axes: one coefficient on
/// a node whose axes are the pair's, several on another. The gap includes the contribution of prescribed components.
struct ContactRow {
  ContactPair pair;
  std::vector<GlobalId> dofs;  ///< node of the mesh x dimension + component in the axes of the node (as Subdomain::globalDof), ascending;
                               ///< none where all nodes are held along the normal: nothing can change such a pair
  std::vector<double> coefficients;  ///< coefficient of each dof; mere rounding is left out
  double gap = 0.0;                  ///< initial gap less the part closed by prescribed components [length]
  int cluster = -1;                  ///< rows that share a dof, and those that share one with them: lowest pair id among them
  std::vector<Point> points;         ///< coordinates of each dof's node

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.pair), each(self.dofs), each(self.coefficients), each(self.gap), each(self.cluster), each(self.points);
  }
};

/// The rows of all pairs, in their order. Cost in proportion to nodes and pairs. Local (rank 0).
std::vector<ContactRow> contactRows(const Mesh& mesh, const Constraints& constraints);

}  // namespace suture
