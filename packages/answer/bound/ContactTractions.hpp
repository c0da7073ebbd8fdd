#pragma once
#include <suture/answer/bound/BoundParts.hpp>

#include <map>

namespace suture {

/// Nodal forces of a contact that its admissible pressure does not balance, on one body: zero resultant. [force]
struct UnbalancedForces {
  std::vector<GlobalId> nodes;
  std::vector<Point> forces;
};

/// Admissible tractions on the sides of all contacts, the same on all ranks.
struct ContactTractions {
  std::map<GlobalId, Point> lifts;      ///< displacements to be added at mid-side nodes, so that no gap is negative [length]
  std::vector<UnbalancedForces> rests;  ///< to be carried by stresses near their nodes
  double liftWork = 0.0;                ///< work of the contact forces in the lifts, which they resist [energy]
  double gapWork = 0.0;  ///< 2 x integral of pressure times gap, negative where sides penetrate, and of what friction could dissipate more
                         ///< than it does [energy]
  double liftedGapWork = 0.0;   ///< the same with the lifts, at least 0 [energy]
  double layerWork = 0.0;       ///< square of the error norm of the springs of softened contacts, without penetration [energy]
  double layerEnergy = 0.0;     ///< square of their energy norm [energy]
  double layerLift = 0.0;       ///< change of their energy that removes penetration [energy]
  double frictionEnergy = 0.0;  ///< integral of the bound of the friction stress times the slip of the load step [energy]
  /// Differences between the given bounds of nodes and those that their laws have for the forces in equilibrium, their sum relative to the
  /// sum of the bounds, the largest of all contacts; negative: no friction that depends on the solution.
  double boundChange = -1.0;
};

/// Sets the tractions of the contacts' sides in `parts`: pressures p >= 0, equal and opposite on both sides, in balance with the forces of
/// the pairs (admissiblePressures), and friction stresses within their bounds (frictionTractions); where sides do not separate, stresses
/// of any sign. Contacts for which that is not possible (mortar, curved or distant sides) get unknown tractions, as if the displacements of
/// their sides were prescribed, and `reasons` of rank 0 names them. Collective.
/// \param contacts  the same on all ranks \param laws  of the contacts
template <int D>
ContactTractions contactTractions(const Comm& comm, const BoundedSolution& solution, const BoundaryParts& contacts, const ContactLaws& laws,
                                  BoundParts<D>& parts);

}  // namespace suture
