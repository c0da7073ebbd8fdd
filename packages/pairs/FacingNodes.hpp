#pragma once
#include <suture/mesh/Surface.hpp>

#include <map>
#include <optional>
#include <vector>

namespace suture {

/// Finds the opposite nodes of two surfaces by topology alone: two parts face each other where both have the same sides with the same
/// neighbours, and opposite sides have opposite orientation. 2D and 3D. Local.
class FacingNodes {
 public:
  /// \param a, b  valid surfaces; must outlive this object
  FacingNodes(const Surface& a, const Surface& b);

  int partsOfA() const { return static_cast<int>(partsA_.size()); }
  int partsOfB() const { return static_cast<int>(partsB_.size()); }

  /// Node of A -> node of B.
  using Partners = std::map<int, int>;
  /// Partners of the nodes of a part of A on a part of B; nothing if the parts differ. A closed or symmetric part fits in several ways: of
  /// the fits with nearby first sides, the one with the least sum of squared distances is taken.
  std::optional<Partners> between(int partOfA, int partOfB) const;
  /// Sum of the squared distances of partners. [length^2]
  double distance(const Partners& partners) const;

 private:
  /// Two sides placed on each other: vertex k of the side of A on vertex turn - k of the side of B, modulo the number of vertices.
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
