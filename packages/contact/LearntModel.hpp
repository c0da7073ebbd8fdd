#pragma once
#include <suture/contact/RigidContact.hpp>

#include <utility>
#include <vector>

namespace suture {

/// Compliance of the pairs as solves have shown it: the pads' diagonal, corrected by block BFGS so that differences of forces give the
/// differences of gaps that were found. Its small contact problem proposes a set of closed pairs. Local.
class LearntModel {
 public:
  /// \param history  forces and penetrations of solves, the last one last
  LearntModel(const RigidContact& rigid, const std::vector<std::pair<Vector, Vector>>& history);
  /// True if a dense model of so many pairs is cheap beside an elastic solve.
  static bool fits(int pairs) { return pairs <= 500; }
  /// Empty: the model's own problem was not solved.
  ClosedSet closedSet() const;

 private:
  const RigidContact& rigid_;
  Matrix compliance_;
  Vector open_;  // penetrations without forces
};

}  // namespace suture
