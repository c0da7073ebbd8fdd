#pragma once
#include <suture/base/Types.hpp>

#include <array>
#include <vector>

namespace suture {

/// Unknowns and edges of an interface, as far as one rank knows them: the input of InterfaceSpace.
struct InterfaceLayout {
  /// An interface unknown. `id`: the same on all ranks, any distinct numbers. On the finest level the displacement of a point along a unit
  /// direction. In general a sum of displacements, known by its values under rigid motions: the motion with translation t at the point and
  /// rotation w about it gives direction . t + moment w; `direction` then has any length.
  struct Unknown {
    GlobalId id;
    Point point, direction;
    double moment = 0.0;  ///< [length]
    /// Volume that a unit displacement carries through the seam or the contact line, out of the local problem of lower id (contact: out of
    /// side A), where a nearly incompressible body cares; else zero, and on coarse levels. [area; volume if axisymmetric]
    double flux = 0.0;
  };
  /// Edge of the decomposition: the unknowns between two local problems and two corners. Unknowns in an order and sense that both share.
  struct Edge {
    std::array<int, 2> locals;  ///< ids, ascending
    std::vector<GlobalId> unknowns;
  };

  std::vector<int> locals;                        ///< ids of the local problems of this rank, of all local problems of the scene
  std::vector<std::vector<GlobalId>> boundaries;  ///< unknowns of each of them
  std::vector<Unknown> unknowns;                  ///< those in `boundaries`; each at least once over all ranks, in any order
  std::vector<GlobalId> partners;                 ///< unknowns of other ranks' boundaries that relations may name here
  std::vector<GlobalId> corners;                  ///< unknowns at cross points and end points of edges
  std::vector<Edge> edges;                        ///< those that touch local problems of this rank
};

}  // namespace suture
