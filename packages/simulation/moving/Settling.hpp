#pragma once

namespace suture {

/// Follows the shapes of moving bodies from round to round of a load step: when they have settled, and how accurately the next round needs
/// to be solved. Local.
class Settling {
 public:
  // The change of shape of a round is of second order in the motion of the round before. Below this part of the largest displacement
  // beside the frames it changes forces by less than the default tolerances of the verdict.
  static constexpr double kSettled = 1e-6;

  /// \param extent  of the scene: below its round-off bodies without strain do not change [length]
  /// \param contraction  expected one, see contraction(): that of the last step
  explicit Settling(double extent, double contraction = 1.0) : extent_(extent), contraction_(contraction) {}

  /// Takes a round into account. \param change  largest change of place of a node in it [length]
  /// \param beside  see scale() \param sameStates  no pair changed its state
  void add(double change, double beside, bool sameStates);
  /// Displacement to which changes are compared. \param beside  largest displacement beside the frames [length]
  double scale(double beside) const;
  /// True if another round would change neither shapes nor states.
  bool isSettled() const { return isSettled_; }
  /// Tolerance of the next round: a part of the change that it is expected to make. Zero, so that the round is solved to the tolerance of
  /// the scene, if it is expected to be the last one.
  double tolerance() const;
  /// Change of the second round as a part of that of the first; the expected one before.
  double contraction() const { return contraction_; }

 private:
  double extent_, contraction_;
  int rounds_ = 0;
  double last_ = 0.0;  // change of the last round [length]
  double next_ = 1.0;  // expected change of the next one, in scales
  bool isSettled_ = false;
};

}  // namespace suture
