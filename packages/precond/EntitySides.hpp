#pragma once
#include <suture/interface/InterfaceOperator.hpp>

#include <functional>
#include <vector>

namespace suture {

/// One side of an interface entity: the rows of its unknowns in the trace of a local problem of this rank.
struct EntitySide {
  int entity;             ///< index in the list of entities
  int side;               ///< index among the entity's sharers
  int local;              ///< index of that local problem, in the order of the space's couplings
  std::vector<int> rows;  ///< rows of the trace, one per unknown of the entity
  Vector coefficients;    ///< trace value divided by the unknown
};

/// The space's entities without the unknowns that are primal alone, in the same order; entities may be empty. Local.
/// \param alone  see PrimalChoice
std::vector<InterfaceEntity> withoutAlone(const InterfaceSpace& space, const std::vector<char>& alone);

/// Sides on this rank, by entity, then side; without those of empty entities. Local.
std::vector<EntitySide> entitySides(const InterfaceSpace& space, const std::vector<InterfaceEntity>& entities);

/// Unknowns that are primal alone and that act on a single trace row of every sharer of an entity: its end points, and other points common
/// to the sharers. One entry per side.
struct AloneRows {
  std::vector<GlobalId> ids;
  std::vector<int> rows;  ///< rows of the trace
  Vector coefficients;
};
/// An unknown that acts on a sharer only through a relation of several unknowns has no row there and is omitted on all sides. Collective.
std::vector<AloneRows> aloneRows(const InterfaceSpace& space, const std::vector<InterfaceEntity>& entities,
                                 const std::vector<EntitySide>& sides, const std::vector<char>& alone);

/// A matrix per side of each entity that this rank touches, by entity and sharer. Collective.
/// \param own  makes the matrix of a side of this rank from its index in `sides`
std::vector<std::vector<Matrix>> exchangeSides(const InterfaceSpace& space, const std::vector<InterfaceEntity>& entities,
                                               const std::vector<EntitySide>& sides, const std::function<Matrix(std::size_t)>& own);

}  // namespace suture
