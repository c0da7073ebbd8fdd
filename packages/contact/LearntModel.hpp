#pragma once
#include <suture/contact/RigidContact.hpp>

#include <utility>
#include <vector>

namespace suture {

/// Compliance of the pairs learnt from previous solves: the diagonal of the pads, corrected by block BFGS to reproduce the differences of
/// gaps found for differences of forces. The solution of its small contact problem is proposed as the next set of closed pairs. Local.
class LearntModel {
 public:
  /// \param history  forces and penetrations of solves, latest last
  LearntModel(const RigidContact& rigid, const std::vector<std::pair<Vector, Vector>>& history);
  /// True if a dense model of so many pairs is cheap compared with an elastic solve.
  static bool fits(int pairs) { return pairs <= 500; }
  /// Empty: the model's own problem could not be solved.
  ClosedSet closedSet() const;

 private:
  const RigidContact& rigid_;
  Matrix compliance_;
  Vector open_;  // penetrations without forces
};

}  // namespace suture
