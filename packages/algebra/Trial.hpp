#pragma once
#include <suture/base/Types.hpp>

#include <cmath>

namespace suture {

/// Changes an operator and returns the relative change of its image of a vector without symmetry that contains all frequencies; 0 for an
/// operator without rows.
/// \param size    rows of the vector
/// \param apply   apply(ConstLocalView, LocalView) of the operator in its current state
/// \param change  replaces the data used by `apply`
template <typename Apply, typename Change>
double effectOf(int size, const Apply& apply, const Change& change) {
  Matrix given(size, 1), before(size, 1), after(size, 1);
  for (int i = 0; i < size; ++i) given(i) = std::sin(1.0 + 7.0 * i);
  apply(given, before);
  change();
  apply(given, after);
  const double difference = (after - before).norm();
  return difference > 0.0 ? difference / before.norm() : 0.0;
}

}  // namespace suture
