#pragma once
#include <suture/answer/PairResult.hpp>
#include <suture/answer/bound/ContactSides.hpp>
#include <suture/pairs/ContactRow.hpp>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace suture {

/// A pair, as sent to rank 0.
struct TouchingPair {
  int id = -1, line = -1;
  GlobalId a = -1, b = -1;  // nodes; b = -1: an obstacle
  Point normal{0, 0, 0};
  bool separates = true, restrictsSliding = false;
  bool isSimple = false;  // at most one node on each side, with weights 1
  std::vector<PairEnd> ends{};

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.id), each(self.line), each(self.a), each(self.b), each(self.normal), each(self.separates), each(self.restrictsSliding),
        each(self.isSimple);
    each(self.ends);
  }
};

/// Local.
TouchingPair touchingPair(const ContactRow& row);

/// A node of side A.
struct ContactNode {
  GlobalId a = -1, b = -1;  // and the opposite node; -1: an obstacle
  Point place{0, 0, 0}, normal{0, 0, 0};
  double force = 0.0, gap = 0.0;             // compressive force; gap of the displacement
  Point tangential{0, 0, 0}, slip{0, 0, 0};  // force on B; slip of the load step
  double bound = 0.0, boundOfLaw = 0.0;      // largest tangential force: given, and that of the law for `force`
  double shortening = 0.0;                   // change of length of the spring of a softened contact
  bool isClosed = false, slips = false;
};

/// The nodes of one contact with the forces and gaps that a solution has there, on rank 0.
class ContactNodes {
 public:
  using Sides = std::vector<const TouchingSide*>;
  struct Pair {
    TouchingPair pair;
    PairResult result;
    Point tangential{0, 0, 0};
    double bound = 0.0;  ///< given largest tangential force
  };
  /// \param a, b  sides of the contact \param givenGaps  TouchingSides::gaps; all must outlive this object
  ContactNodes(int sideNodes, const Sides& a, const Sides& b, const std::map<GlobalId, double>& givenGaps)
      : sideNodes_(sideNodes), a_(a), b_(b), givenGaps_(givenGaps) {}

  /// Nodes of pairs of one node on each side.
  void addPairs(const std::vector<Pair>& pairs);
  /// Nodes of mortar pairs on sides that match: gaps from places and displacements, forces from the weights of the pairs. Returns what
  /// prevents it; empty if nothing does. \param ignoresDistance  sides are glued where they are drawn
  std::string addPlaces(const std::vector<Pair>& pairs, bool ignoresDistance);

  const std::vector<ContactNode>& all() const { return nodes_; }
  void addForce(std::size_t node, double compressive) { nodes_[node].force += compressive; }
  /// Place in all(); -1 for a node that faces nothing.
  int indexOf(GlobalId a) const;

 private:
  void add(const ContactNode& node);
  /// By how much the initial gap of mortar pairs is larger than the given one, or than the distance of the sides, as where ForceIntervals
  /// changes it. False: it varies.
  bool findWidening(const std::vector<Pair>& pairs, double& widened) const;

  int sideNodes_;
  const Sides &a_, &b_;
  const std::map<GlobalId, double>& givenGaps_;
  std::vector<ContactNode> nodes_;
  std::map<GlobalId, int> indexOf_;
};

}  // namespace suture
