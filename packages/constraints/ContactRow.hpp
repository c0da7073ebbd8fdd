#pragma once
#include <suture/constraints/Constraints.hpp>

#include <vector>

namespace suture {

struct Mesh;

/// The rows of one contact pair, a block: what its law restricts, in the frame of the pair (PairFrame). The first is the condition
/// (u_A - u_B) . normal <= gap; a law that restricts sliding adds (u_A - u_B) . tangent, which vanishes where the pair sticks.
struct ContactRow {
  /// A row in the free unknowns of the pair's nodes, whatever their axes: one coefficient on a node whose axes are the pair's, several on
  /// another.
  struct Equation {
    std::vector<GlobalId> dofs;  ///< node of the mesh x dimension + component in the axes of the node (as Subdomain::globalDof), ascending;
                                 ///< none where all nodes are held along the row's direction: nothing can change there
    std::vector<double> coefficients;  ///< coefficient of each dof; mere rounding is left out
    double gap = 0.0;  ///< initial gap, along tangents slip before the load step, less the part closed by prescribed components [length]
    std::vector<Point> points;  ///< coordinates of each dof's node

    template <typename Self, typename Each>
    static void forEachField(Self& self, const Each& each) {
      each(self.dofs), each(self.coefficients), each(self.gap), each(self.points);
    }
  };
  ContactPair pair;
  std::vector<Equation> equations;  ///< the normal one, then those of the tangents
  bool separates = true;            ///< false of a law that never opens a pair (ContactLaw::separates)
  int cluster = -1;                 ///< rows that share a dof, and those that share one with them: lowest pair id among them

  const Equation& normal() const { return equations.front(); }
  Equation& normal() { return equations.front(); }
  /// True if the pair can open and close: some node of it can move along the normal.
  bool able() const { return !normal().dofs.empty(); }
  /// True if the law restricts sliding.
  bool restrictsSliding() const { return equations.size() > 1; }

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.pair), each(self.equations), each(self.separates), each(self.cluster);
  }
};

/// Directions of a pair's rows: its frame (PairFrame), the tangents less what is along directions in which nothing slides.
std::vector<Point> rowDirections(const ContactPair& pair, int dimension);

/// The rows of all pairs, in their order, as many of each as its law restricts. Cost in proportion to nodes and pairs. Local (rank 0).
std::vector<ContactRow> contactRows(const Mesh& mesh, const Constraints& constraints);

}  // namespace suture
