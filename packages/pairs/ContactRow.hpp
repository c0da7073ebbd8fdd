#pragma once
#include <suture/base/Types.hpp>
#include <suture/pairs/ContactLaw.hpp>
#include <suture/pairs/ContactPair.hpp>
#include <suture/pairs/ContactState.hpp>

#include <vector>

namespace suture {

/// Block of rows of one contact pair: the restrictions of its law, in the frame of the pair (PairFrame). The first row is the condition
/// (u_A - u_B) . normal <= gap; a law that restricts sliding adds (u_A - u_B) . tangent, which vanishes where the pair sticks.
struct ContactRow {
  /// Row in the free unknowns of the pair's nodes: one coefficient per node whose axes are those of the pair, several for a node with other
  /// axes.
  struct Equation {
    std::vector<GlobalId> dofs;  ///< node of the mesh x dimension + component in the axes of the node (as Subdomain::globalDof), ascending;
                                 ///< empty if all nodes are held along the row's direction: nothing can change there
    std::vector<double> coefficients;  ///< coefficient of each dof, without those that are mere round-off
    double gap = 0.0;  ///< initial gap (along tangents, slip before the load step) minus the part closed by prescribed components [length]
    std::vector<Point> points;  ///< coordinates of each dof's node

    template <typename Self, typename Each>
    static void forEachField(Self& self, const Each& each) {
      each(self.dofs), each(self.coefficients), each(self.gap), each(self.points);
    }
  };
  ContactPair pair;
  std::vector<Equation> equations;  ///< the normal one, then the tangential ones
  bool separates = true;            ///< false for a law that never opens a pair (ContactLaw::separates)
  int cluster = -1;                 ///< lowest pair id among the rows that are connected to this one by common dofs

  const Equation& normal() const { return equations.front(); }
  Equation& normal() { return equations.front(); }
  /// True if the pair can open and close: at least one of its nodes can move along the normal.
  bool canChange() const { return !normal().dofs.empty(); }
  /// True if the law restricts sliding.
  bool restrictsSliding() const { return equations.size() > 1; }

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.pair), each(self.equations), each(self.separates), each(self.cluster);
  }
};

/// Directions of a pair's rows: its frame (PairFrame), with the tangents reduced to the directions in which the pair can slide.
std::vector<Point> rowDirections(const ContactPair& pair, int dimension);

/// State of a row's pair in a set of closed pairs: without friction, except for pairs that never open; open if nothing can change.
ContactState pressedState(const ContactRow& row, const ContactLaw& law);

}  // namespace suture
