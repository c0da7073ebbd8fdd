#pragma once
#include <suture/interface/InterfaceOperator.hpp>

#include <functional>
#include <vector>

namespace suture {

/// One side of an entity of the interface: how its unknowns stand in the trace of a local problem of this rank.
struct EntitySide {
  int entity;             ///< in the list of entities
  int side;               ///< which of the entity's sharers
  int local;              ///< place of that local problem, in the order of the space's couplings
  std::vector<int> rows;  ///< rows of the trace, one an unknown of the entity
  Vector coefficients;    ///< the trace there is this times the unknown
};

/// The space's entities less the unknowns that are primal alone, at the same places; they may be empty. Local.
/// \param alone  see PrimalChoice
std::vector<InterfaceEntity> withoutAlone(const InterfaceSpace& space, const std::vector<char>& alone);

/// Sides that lie on this rank, by entity, then side; none of empty entities. Local.
std::vector<EntitySide> entitySides(const InterfaceSpace& space, const std::vector<InterfaceEntity>& entities);

/// Unknowns that are primal alone and that all sharers of an entity feel by a single row of their traces: its end points, and where the
/// sharers meet elsewhere. One entry a side.
struct AloneRows {
  std::vector<GlobalId> ids;
  std::vector<int> rows;  ///< rows of the trace
  Vector coefficients;
};
/// An unknown that a sharer feels through a relation of several unknowns only has no row there and is left out on all sides. Collective.
std::vector<AloneRows> aloneRows(const InterfaceSpace& space, const std::vector<InterfaceEntity>& entities,
                                 const std::vector<EntitySide>& sides, const std::vector<char>& alone);

/// A matrix for each side of each entity that this rank touches, by entity and sharer. Collective.
/// \param own  makes the matrix of a side of this rank, from its place in `sides`
std::vector<std::vector<Matrix>> exchangeSides(const InterfaceSpace& space, const std::vector<InterfaceEntity>& entities,
                                               const std::vector<EntitySide>& sides, const std::function<Matrix(std::size_t)>& own);

}  // namespace suture
