#pragma once
#include <suture/mesh/Surface.hpp>

#include <map>
#include <optional>
#include <vector>

namespace suture {

/// Finds the nodes of one surface that stand opposite to those of another, by the sides alone: two parts face each other where both have
/// the same sides with the same neighbours, and opposite sides run against each other. In the plane and in space. Local.
class FacingNodes {
 public:
  /// \param a, b  sound surfaces; they outlive this
  FacingNodes(const Surface& a, const Surface& b);

  int partsOfA() const { return static_cast<int>(partsA_.size()); }
  int partsOfB() const { return static_cast<int>(partsB_.size()); }

  /// Node of A -> node of B.
  using Partners = std::map<int, int>;
  /// Partners of the nodes of a part of A on a part of B; nothing if the parts differ. A part without a rim, and one that looks alike from
  /// several sides, fits in several ways: that of those with near first sides which has the least sum of squared distances.
  std::optional<Partners> between(int partOfA, int partOfB) const;
  /// Sum of the squared distances of partners. [length^2]
  double distance(const Partners& partners) const;

 private:
  /// Two sides laid upon each other: vertex k of the side of A upon vertex turn - k of that of B, modulo their number.
  struct Laid {
    int a, b, turn;
  };
  int opposite(const Laid& laid, int facet) const;
  bool sameRim(const Laid& laid) const;
  double distance(const Laid& laid) const;
  bool lay(const Laid& laid, Partners& partners) const;
  std::vector<Laid> starts(int partOfA, int partOfB) const;
  std::optional<Partners> from(const Laid& start) const;

  const Surface &a_, &b_;
  std::vector<std::vector<int>> partsA_, partsB_;  // sides of each part
};

}  // namespace suture
