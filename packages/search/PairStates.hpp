#pragma once
#include <suture/pairs/ContactState.hpp>

#include <vector>

namespace suture {

/// States of all pairs, by id.
using PairStates = std::vector<ContactState>;

/// Closed contact pairs: one entry per pair, nonzero if it is closed.
using ClosedSet = std::vector<char>;

/// States of frictionless pairs: closed ones slide freely.
inline PairStates statesOf(const ClosedSet& closed) {
  PairStates states(closed.size());
  for (std::size_t i = 0; i < closed.size(); ++i)
    if (closed[i]) states[i] = PairStatus::Slip;
  return states;
}

inline ClosedSet closedSet(const PairStates& states) {
  ClosedSet closed(states.size(), 0);
  for (std::size_t i = 0; i < states.size(); ++i) closed[i] = states[i].closed();
  return closed;
}

}  // namespace suture
