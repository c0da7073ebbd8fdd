#pragma once
#include <suture/base/Point.hpp>

namespace suture {

// Infinitesimal rigid motions: a translation t and a rotation w (a vector along its axis). A point at `arm` from the centre of rotation
// moves by t + w x arm. In 2D only the third component of w is nonzero.

/// Number of rigid motions: translations along the axes, then rotations about them (in 2D about the third axis only).
inline int rigidMotions(int dimension) { return dimension == 2 ? 3 : 6; }

/// t + w x arm. Real may be a type of extended precision.
template <typename Real>
std::array<Real, 3> rigidDisplacement(const std::array<Real, 3>& translation, const std::array<Real, 3>& rotation,
                                      const std::array<Real, 3>& arm) {
  std::array<Real, 3> moved = translation;
  for (int k = 0; k < 3; ++k) moved[k] += rotation[(k + 1) % 3] * arm[(k + 2) % 3] - rotation[(k + 2) % 3] * arm[(k + 1) % 3];
  return moved;
}

/// Splits the amplitudes of the rigidMotions() into translation and rotation. \param amplitudes  anything with operator[]
template <typename Real, typename Amplitudes>
void splitAmplitudes(const Amplitudes& amplitudes, int dimension, std::array<Real, 3>& translation, std::array<Real, 3>& rotation) {
  translation = rotation = {0, 0, 0};
  for (int k = 0; k < dimension; ++k) translation[k] = amplitudes[k];
  for (int k = dimension == 2 ? 2 : 0; k < 3; ++k) rotation[k] = amplitudes[dimension == 2 ? k : 3 + k];
}

/// Displacement along `direction` under each of the rigidMotions() of unit amplitude; entries beyond their number are zero.
/// \param moment  value of the displacement under rotations about the point itself: nonzero only for sums of displacements
inline std::array<double, 6> rigidValues(int dimension, const Point& arm, const Point& direction, const Point& moment = {0, 0, 0}) {
  const Point turned = plus(cross(arm, direction), moment);
  if (dimension == 2) return {direction[0], direction[1], turned[2], 0.0, 0.0, 0.0};
  return {direction[0], direction[1], direction[2], turned[0], turned[1], turned[2]};
}

}  // namespace suture
