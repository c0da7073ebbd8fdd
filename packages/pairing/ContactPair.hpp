#pragma once
#include <suture/base/Types.hpp>

#include <array>
#include <vector>

namespace suture {

/// A node's share in the condition of a contact pair: weight normal . u(node).
struct PairEnd {
  int node = -1;
  double weight = 0.0;  ///< weights of side A add up to a positive number, those of side B to a negative one

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.node), each(self.weight);
  }
};

/// One unilateral condition of a contact: sum over its ends of weight normal . u(node) <= gap, that is (u_A - u_B) . normal <= gap.
/// One unit normal a pair, from side A to side B. The first end is the node that carries the pair (its contact force acts there), with
/// weight 1 on side A, -1 on side B (others where a mortar has further nodes of its side: on quadratic elements covered in part, and in
/// space at the middles of six- and eight-node sides). Of matching sides a pair has one node of each; with mortar it has the mean of
/// several on the other side; with a rigid obstacle none.
struct ContactPair {
  int id = -1;     ///< 0..pairs-1 over the whole scene, in the order of the contacts
  int line = -1;   ///< contact of the scene (place in the list `Contact`)
  int piece = -1;  ///< connected component of Gamma_c
  std::vector<PairEnd> ends;
  Point normal{0, 0, 0};
  double gap = 0.0;         ///< initial gap along the normal [length]; negative: interference
  double length = 0.0;      ///< tributary: integral of the carrying node's hat function [length or area]; axisymmetric: times 2 pi r [area]
  double arc = 0.0;         ///< in the plane: arc length from the first node of its run of the carrying side [length]; for output
  Point position{0, 0, 0};  ///< where its force acts: carrying node, or beside it (MortarPairs)
  /// Tangents along which nothing slides, orthonormal: both sides are held there alike, as across a plane of symmetry. With mortar, whose
  /// means reach to one side of such a plane only, the jump along them is no zero, and means nothing.
  std::vector<Point> still = {};
  /// History of the pair at the beginning of a load step.
  struct Past {
    Point slip{0, 0, 0};      ///< u_A - u_B along the sides, from which the step's slip counts [length]
    bool slipped = false;     ///< it has slid under a bound
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
    each(self.id), each(self.line), each(self.piece), each(self.ends), each(self.normal);
    each(self.gap), each(self.length), each(self.arc), each(self.position), each(self.still);
    each(self.past);
  }
};

/// The part of a jump u_A - u_B, or of any vector, that is slip of a pair: less what is along its normal, and where nothing slides.
Point slidingPart(const ContactPair& pair, const Point& jump);

/// A pair of two nodes that stand opposite to each other.
std::vector<PairEnd> matchingEnds(int nodeA, int nodeB);

/// Resultant of a pair on the bodies as a whole: the force of a rigid obstacle on them; zero between bodies. [force]
/// \param onB  contact force that side B feels
Point obstacleForce(const ContactPair& pair, const Point& onB);

/// The end of a second-order side on the axis of a body of revolution. Its shape function has no integral over the circle: no pressure has
/// a force there, no pair stands for it, and nothing is decided by it. The values shown there follow from the two pairs beside it.
struct AxisPoint {
  std::array<int, 2> pairs{{-1, -1}};          ///< ids, the nearer one first
  std::array<double, 2> pressure{{1.0, 0.0}};  ///< weights of their pressures: of a + b r^2 whose means over both are these
  std::array<double, 2> value{{1.0, 0.0}};     ///< weights of their values at the nodes: of a + b r^2 through these
  int node = -1;
  double arc = 0.0;
  Point position{0, 0, 0}, normal{0, 0, 0};

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.pairs), each(self.pressure), each(self.value), each(self.node), each(self.arc), each(self.position), each(self.normal);
  }
};

/// Pairs beside each pair in cells, ascending. Local. \param pairs  their number, with ids from 0
std::vector<std::vector<int>> neighbourPairs(const std::vector<std::vector<int>>& cells, int pairs);

}  // namespace suture
