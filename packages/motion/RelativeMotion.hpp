#pragma once
#include <suture/motion/BodyFrame.hpp>

namespace suture {

/// Nodes of a body in a step, as a weighted sum: the frames of the body at both ends of the step, and the places of the nodes on the drawn
/// body there, which differ by the displacements beside the frames.
struct MovedNodes {
  BodyFrame from, to;
  double weight = 0.0;                  ///< sum of the weights
  Point before{0, 0, 0}, now{0, 0, 0};  ///< sums of weight times place [length]

  /// \param x  place on the drawn body at the beginning of the step \param y  and at its end
  void add(double nodeWeight, const Point& x, const Point& y);
  /// Sum after a part of the step: strains change in proportion.
  Point drawnAfter(double part) const { return plus(scaled(1.0 - part, before), scaled(part, now)); }
};

/// Motion of two bodies against each other in a step, at nodes that face each other at its end. The weights of body A add up to a number w,
/// those of body B to -w; of an obstacle, which rests, to zero. Between the ends of the step the bodies turn and move apart at constant
/// rates; rotations that both share are no motion. All vectors are seen from body B at the end of the step. Local.
class RelativeMotion {
 public:
  RelativeMotion(const MovedNodes& a, const MovedNodes& b);

  /// Sum of weight times place after a part of the step: the vector from B to A, or from the origin to A. [length]
  Point at(double part) const;
  /// Part of the step after which a gap closes: 0 if it was closed at the beginning, nearly 1 if it is open until the end. \param normal
  /// unit normal at the end, so that the gap decreases as at() increases along it \param gap  at the end [length]
  double closing(const Point& normal, double gap) const;
  /// Tangential motion after a part of the step, divided by the rest of the step: if the nodes are moved by x at the end, it changes by x,
  /// as in a step that begins with contact. Where the bodies turn against each other about the normal, it has the direction of sliding at
  /// the end (endOfArc()). [length]
  Point slipAfter(double part, const Point& normal) const;

 private:
  BodyFrame frameA(double part) const;
  BodyFrame frameB(double part) const;

  MovedNodes a_, b_;
  Point turnA_, turnB_;     // rotation vectors in the step
  Point common_;            // the part of them that both share
  Point distance_, shift_;  // between the frames at the beginning, and its change without the common rotation
  Point end_{0, 0, 0};
};

}  // namespace suture
