#pragma once
#include <suture/base/Types.hpp>

#include <array>
#include <vector>

namespace suture {

/// Contribution of one node to the condition of a contact pair: weight normal . u(node).
struct PairEnd {
  int node = -1;
  double weight = 0.0;  ///< weights of side A add up to a positive number, those of side B to a negative one

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.node), each(self.weight);
  }
};

/// One unilateral condition of a contact: sum over its ends of weight normal . u(node) <= gap, that is (u_A - u_B) . normal <= gap. Each
/// pair has one unit normal, from side A to side B. The first end is the node that carries the pair (its contact force acts there), with
/// weight 1 on side A, -1 on side B (other weights where a mortar pair has further nodes on its own side: on quadratic elements covered in
/// part, and in 3D at the mid-side nodes of six- and eight-node sides). A pair of matching sides has one node of each side; a mortar pair
/// has the mean of several nodes on the other side; a pair with a rigid obstacle has no node there.
struct ContactPair {
  int id = -1;     ///< 0..pairs-1 over the whole scene, in the order of the contacts
  int line = -1;   ///< contact of the scene (place in the list `Contact`)
  int piece = -1;  ///< connected component of Gamma_c
  std::vector<PairEnd> ends;
  int own = 1;  ///< number of ends on the carrying side, the first ones; single weights there may have either sign
  Point normal{0, 0, 0};
  double gap = 0.0;         ///< initial gap along the normal [length]; negative: interference
  double length = 0.0;      ///< tributary: integral of the carrying node's hat function [length or area]; axisymmetric: times 2 pi r [area]
  double arc = 0.0;         ///< 2D: arc length from the first node of its run of the carrying side [length]; for output
  Point position{0, 0, 0};  ///< point where its force acts: the carrying node, or a point near it (MortarPairs)
  /// Orthonormal tangents along which sliding is blocked, because both sides are constrained alike, as on a symmetry plane. With mortar,
  /// whose means extend to one side of such a plane only, the jump along these tangents is not zero but has no meaning.
  std::vector<Point> still = {};
  /// State of the pair at the beginning of a load step.
  struct Past {
    Point slip{0, 0, 0};      ///< tangential part of u_A - u_B from which the slip of the step is measured [length]
    bool slipped = false;     ///< true if it has slid under a friction bound
    double dissipated = 0.0;  ///< work of its tangential force [energy]

    template <typename Self, typename Each>
    static void forEachField(Self& self, const Each& each) {
      each(self.slip), each(self.slipped), each(self.dissipated);
    }
  };
  Past past = {};

  int node() const { return ends.front().node; }  ///< carrying node

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.id), each(self.line), each(self.piece), each(self.ends), each(self.own), each(self.normal);
    each(self.gap), each(self.length), each(self.arc), each(self.position), each(self.still);
    each(self.past);
  }
};

/// Slip part of a jump u_A - u_B, or of any vector: without the components along the normal and along blocked tangents (`still`).
Point slidingPart(const ContactPair& pair, const Point& jump);

/// Ends of a pair of two opposite nodes.
std::vector<PairEnd> matchingEnds(int nodeA, int nodeB);

/// Resultant of a pair on all bodies together: the force of a rigid obstacle on them; zero between bodies. [force]
/// \param onB  contact force on side B
Point obstacleForce(const ContactPair& pair, const Point& onB);

/// End of a second-order side on the axis of revolution. The integral of its shape function over the circle is zero: a pressure there
/// exerts no force, and the node has no pair. Its output values follow from the two nearest pairs.
struct AxisPoint {
  std::array<int, 2> pairs{{-1, -1}};          ///< ids, the nearer one first
  std::array<double, 2> pressure{{1.0, 0.0}};  ///< weights of their pressures: of a + b r^2 with these means over both tributary areas
  std::array<double, 2> value{{1.0, 0.0}};     ///< weights of their nodal values: of a + b r^2 through these values
  int node = -1;
  double arc = 0.0;
  Point position{0, 0, 0}, normal{0, 0, 0};

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.pairs), each(self.pressure), each(self.value), each(self.node), each(self.arc), each(self.position), each(self.normal);
  }
};

/// Neighbours of each pair in the cells, ascending. Local. \param pairs  number of pairs, with ids from 0
std::vector<std::vector<int>> neighbourPairs(const std::vector<std::vector<int>>& cells, int pairs);

}  // namespace suture
