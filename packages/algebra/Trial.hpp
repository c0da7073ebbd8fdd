#pragma once
#include <suture/base/Types.hpp>

#include <cmath>

namespace suture {

/// Changes an operator and tells by how much that changed an image, relative to it. The vector that is applied has no symmetry, and all
/// frequencies. An operator without rows: 0.
/// \param size    rows of the vector
/// \param apply   apply(ConstLocalView, LocalView) of the operator, as it is when it is called
/// \param change  replaces what apply uses
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
