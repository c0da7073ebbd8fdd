#pragma once
#include <suture/interface/InterfaceOperator.hpp>

#include <array>
#include <functional>
#include <vector>

namespace suture {

/// One side of an edge of the interface: how its unknowns stand in the trace of a local problem of this rank.
struct EdgeSide {
  int edge;                     ///< in space.edges()
  int side;                     ///< 0 or 1: which of the edge's two local problems
  int local;                    ///< place of that local problem, in the order of the space's couplings
  std::vector<int> rows;        ///< rows of the trace, one an unknown of the edge
  Vector coefficients;          ///< the trace there is this times the unknown
  std::vector<int> cornerRows;  ///< rows of the trace for corner unknowns that both local problems feel (the edge's end points), by id
  Vector cornerCoefficients;
  std::vector<GlobalId> cornerIds;
};

/// Sides that lie on this rank, by edge. Local.
std::vector<EdgeSide> edgeSides(const InterfaceSpace& space);

/// Leaves those corners to each side that are single rows of both traces: one that the other side feels through a relation of several
/// unknowns only has no row there. Collective.
void keepCommonCorners(const InterfaceSpace& space, std::vector<EdgeSide>& sides);

/// A matrix for each side of each edge of the space, both sides known to both ranks. Collective.
/// \param own  makes the matrix of a side of this rank
std::vector<std::array<Matrix, 2>> exchangeEdges(const InterfaceSpace& space, const std::vector<EdgeSide>& sides,
                                                 const std::function<Matrix(const EdgeSide&)>& own);

}  // namespace suture
