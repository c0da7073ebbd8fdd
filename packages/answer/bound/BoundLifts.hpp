#pragma once
#include <suture/answer/bound/BoundParts.hpp>

#include <map>

namespace suture {

/// Displacements of some nodes, of the degree of the elements on each simplex.
struct Lifts {
  Vector squares;       ///< square of the energy norm, for each simplex [energy]
  double energy = 0.0;  ///< change of the potential energy over this rank, without half the squares and the work of contact forces [energy]
};

/// Local; before other forces are added to those of the solution. \param lifts  node of the mesh -> displacement
template <int D>
Lifts liftParts(const BoundParts<D>& parts, const BoundedSolution& solution, const std::map<GlobalId, Point>& lifts);

}  // namespace suture
