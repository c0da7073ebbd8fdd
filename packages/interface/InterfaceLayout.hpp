#pragma once
#include <suture/partition/EntityGraph.hpp>

#include <vector>

namespace suture {

/// Unknowns and entities of an interface, as far as one rank knows them; input of InterfaceSpace.
struct InterfaceLayout {
  /// An interface unknown. `id`: any distinct numbers, the same on all ranks. On the finest level it is the displacement of a point along a
  /// unit direction. In general it is a sum of displacements, defined by its values under rigid motions: the motion with translation t at
  /// the point and rotation w (a vector) about it gives direction . t + moment . w; `direction` then has any length.
  struct Unknown {
    GlobalId id;
    Point point, direction;
    Point moment{0, 0, 0};  ///< [length]
    /// Volume that a unit displacement moves through the seam or the contact line, out of the local problem of lower id (contact: out of
    /// side A). Set only for nearly incompressible bodies on the finest level, else zero. [area; volume if axisymmetric]
    double flux = 0.0;
  };
  /// A vertex, edge or face of the decomposition, in unknowns (see SeamEntity). All ranks that know it list its unknowns in the same order.
  struct Entity {
    EntityKind kind;
    std::vector<int> sharers;        ///< ids of the local problems, ascending
    std::vector<GlobalId> unknowns;  ///< each unknown is in one entity
    std::vector<GlobalId> ends;      ///< an edge's unknowns at ends without a vertex
  };

  int dimension = 0;        ///< dimension of the scene, 2 or 3; 0 on a rank without local problems (the space gets it from other ranks)
  std::vector<int> locals;  ///< ids of this rank's local problems, numbered over the whole scene
  std::vector<std::vector<GlobalId>> boundaries;  ///< unknowns of each local problem
  std::vector<Unknown> unknowns;                  ///< unknowns of `boundaries`; over all ranks each at least once, in any order
  std::vector<GlobalId> partners;                 ///< unknowns of other ranks' boundaries that relations of this rank may use
  std::vector<Entity> entities;                   ///< entities that touch local problems of this rank, in an order common to all ranks
};

}  // namespace suture
