#pragma once
#include <suture/base/Types.hpp>
#include <suture/interface/TpetraTypes.hpp>
#include <suture/pairs/PairForce.hpp>

#include <vector>

namespace suture {

/// A displacement field that may jump between local problems: the trace of a state plus a correction for each local problem, extended to
/// the interiors in equilibrium, with the forces that it causes for the pair states and friction forces of that state. Plain.
struct BrokenField {
  std::vector<Vector> freeValues;  ///< per subdomain of this rank, without rigid motions that the state keeps apart [length]
  MultiVectorPtr residual;         ///< external minus internal forces in the space of the state's linearisation [force]
  double largestForce = 0.0;       ///< largest force of a local problem at one unknown of the interface, over all ranks [force]
  std::vector<PairForce> pairs;    ///< all pairs that this rank sees
};

}  // namespace suture
