#pragma once
#include <suture/pairs/ContactPair.hpp>
#include <suture/pairs/ContactState.hpp>

#include <map>
#include <utility>

namespace suture {

/// States of contact pairs from one set of pairs to the next, by contact and carrying node. The direction of slip turns with the normal of
/// the pair: the tangents of a pair's frame in 3D (pairFrame) may be others after the least change of the normal. Local.
class KeptStates {
 public:
  explicit KeptStates(int dimension = 2) : dimension_(dimension) {}

  void keep(const ContactPair& pair, const ContactState& state);
  /// Status of the pair at the same node, open if it had none.
  PairStatus statusOf(const ContactPair& pair) const;
  bool contains(const ContactPair& pair) const { return states_.count({pair.line, pair.node()}) > 0; }
  /// State in the frame of the pair, open if it had none.
  ContactState of(const ContactPair& pair) const;
  bool anyClosed() const;

 private:
  struct Kept {
    ContactState state;
    Point normal;     // unit normal of the pair
    Point direction;  // direction of slip in Cartesian axes
  };
  std::map<std::pair<int, int>, Kept> states_;
  int dimension_;
};

}  // namespace suture
