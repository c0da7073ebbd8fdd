#pragma once
#include <suture/partition/EntityGraph.hpp>

#include <vector>

namespace suture {

/// Unknowns and entities of an interface, as far as one rank knows them: the input of InterfaceSpace.
struct InterfaceLayout {
  /// An interface unknown. `id`: the same on all ranks, any distinct numbers. On the finest level the displacement of a point along a unit
  /// direction. In general a sum of displacements, known by its values under rigid motions: the motion with translation t at the point and
  /// rotation w (a vector) about it gives direction . t + moment . w; `direction` then has any length.
  struct Unknown {
    GlobalId id;
    Point point, direction;
    Point moment{0, 0, 0};  ///< [length]
    /// Volume that a unit displacement carries through the seam or the contact line, out of the local problem of lower id (contact: out of
    /// side A), where a nearly incompressible body cares; else zero, and on coarse levels. [area; volume if axisymmetric]
    double flux = 0.0;
  };
  /// A vertex, an edge or a face of the decomposition in unknowns, see SeamEntity. All who know it list its unknowns in the same order.
  struct Entity {
    EntityKind kind;
    std::vector<int> sharers;        ///< ids of the local problems, ascending
    std::vector<GlobalId> unknowns;  ///< each in one entity
    std::vector<GlobalId> ends;      ///< those of an edge's unknowns where it ends at no vertex
  };

  int dimension = 0;        ///< of the scene: 2 or 3; a rank without local problems leaves 0, the space knows it everywhere
  std::vector<int> locals;  ///< ids of the local problems of this rank, of all local problems of the scene
  std::vector<std::vector<GlobalId>> boundaries;  ///< unknowns of each of them
  std::vector<Unknown> unknowns;                  ///< those in `boundaries`; each at least once over all ranks, in any order
  std::vector<GlobalId> partners;                 ///< unknowns of other ranks' boundaries that relations may name here
  std::vector<Entity> entities;                   ///< those that touch local problems of this rank, in an order that all ranks share
};

}  // namespace suture
