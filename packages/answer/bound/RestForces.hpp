#pragma once
#include <suture/answer/bound/BoundParts.hpp>
#include <suture/answer/bound/ContactTractions.hpp>

namespace suture {

/// Carries nodal forces without resultant by displacements of the elements near their nodes: changes the forces of these elements, so that
/// together they are in balance with the given tractions again. Each patch (the elements at the nodes and one more layer) is free and
/// small; it is solved on rank 0. Collective. Returns false if a patch cannot carry its forces.
template <int D>
bool carryRestForces(const Comm& comm, const BoundedSolution& solution, const std::vector<UnbalancedForces>& rests, BoundParts<D>& parts);

}  // namespace suture
