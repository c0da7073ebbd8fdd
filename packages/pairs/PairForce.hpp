#pragma once
#include <suture/base/Types.hpp>
#include <suture/pairs/ContactState.hpp>

namespace suture {

/// A solver's decision about a pair; gap and pressure follow from the displacements.
struct PairForce {
  int id = -1;
  ContactState state;
  double force = 0.0;         ///< > 0 compressive [force]
  Point tangential{0, 0, 0};  ///< friction force on side B from the sliding of A, Cartesian [force]
};

}  // namespace suture
