#pragma once
#include <suture/base/Errors.hpp>
#include <suture/base/Types.hpp>

#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Node of a body near a point. Trivially copyable.
struct NearNode {
  double distance = 0.0;  ///< [length]
  GlobalId node = -1;
  int body = -1;
  Point place{0, 0, 0};
};

/// The node at a point of the scene, on which a point load or a point support acts: the nearest node of each body is collected, on any
/// number of ranks, and then one of them is chosen. Local.
class NodeAtPoint {
 public:
  /// \param extent  diagonal of the box around all bodies: differences in distance at its round-off do not count [length]
  NodeAtPoint(const Point& point, double extent) : point_(point), extent_(extent) {}

  /// Offers a node: it replaces a farther one of its body, or one of the same distance and a larger number.
  void offer(const NearNode& node);
  /// The nearest node of each body, in the order in which bodies were first offered.
  const std::vector<NearNode>& candidates() const { return candidates_; }

  /// The nearest node within a tolerance; nothing if there is none, or if nodes of several bodies are equally near.
  /// \param tolerance  [length]; 0: 1e-6 of the extent \param bodies  names \param path  of the condition, for messages
  std::optional<NearNode> choose(double tolerance, const std::vector<std::string>& bodies, int dimension, const std::string& path,
                                 Problems& problems) const;

 private:
  bool isNearer(const NearNode& a, const NearNode& b) const;

  Point point_;
  double extent_;
  std::vector<NearNode> candidates_;
};

}  // namespace suture
