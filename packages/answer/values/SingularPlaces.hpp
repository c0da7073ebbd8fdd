#pragma once
#include <suture/answer/PairResult.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <string>
#include <vector>

namespace suture {

/// A side of an element on the boundary of its body, near a place in question.
struct BoundarySide {
  int body = -1;
  std::vector<GlobalId> nodes;  ///< all nodes of the side
  std::vector<Point> vertices;  ///< in the order of SideGeometry.hpp; their nodes come first in `nodes`
  Point normal{0, 0, 0};        ///< unit outward normal, for a curved side at its middle

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.body), each(self.nodes), each(self.vertices), each(self.normal);
  }
};

/// Boundary sides that contain one of these nodes; ordered, on rank 0, empty elsewhere. Collective.
/// \param nodes  ascending, the same on all ranks
std::vector<BoundarySide> boundarySidesAt(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<int>& nodes);

/// True if two of the sides meet at an edge (2D: node) where the body has more than 225 degrees: stresses of linear elasticity are
/// unbounded there. Local.
bool haveReentrantEdge(const std::vector<BoundarySide>& sides, int dimension);

/// True if a body ends at a corner within a pair while the partner's boundary continues smoothly beyond: the edge of a punch, the end of a
/// hub on a longer shaft. The pressure is unbounded there. Local. \param sides  at the pair's nodes
bool endsOnPartner(const ContactPair& pair, const std::vector<BoundarySide>& sides, int dimension);

/// Location of a largest value that is to be examined.
struct PlaceInQuestion {
  std::vector<int> nodes;  ///< nodes of the location: one node, or those of an element
  int pair = -1;           ///< for a pressure: pair id; else -1
};

/// Reason why the exact value is infinite at each place: "a re-entrant corner", "the end of a contact side on a partner that continues";
/// empty: finite. Examines the elements around the place. The same on all ranks. Collective.
/// \param places  the same on all ranks;  \param closed  ids of the closed pairs, ascending, on rank 0
std::vector<std::string> singularities(const Comm& comm, const std::vector<SubdomainMesh>& meshes,
                                       const std::vector<PlaceInQuestion>& places, const std::vector<int>& closed);

}  // namespace suture
