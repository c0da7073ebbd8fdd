#pragma once
#include <suture/partition/SubdomainMesh.hpp>

#include <set>
#include <string>
#include <vector>

namespace suture {

/// Two bodies of which one penetrates the other.
struct Overlap {
  int body = -1, into = -1;    ///< indices in ElasticModel::bodies
  std::string group, nearest;  ///< deepest side group of `body`, and the side group of `into` nearest to it; empty: none
  double depth = 0.0;          ///< its distance from the surface of `into` [length]
  Point place{0, 0, 0};        ///< deformed position
  int contact = -1;            ///< line of a contact between both bodies there; -1: none is declared
  int dimension = 2;

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.body), each(self.into), each(self.group), each(self.nearest), each(self.depth), each(self.place), each(self.contact);
    each(self.dimension);
  }
};

/// Warning about an overlap. \param contacts  names of the contact lines  \param drawn  the bodies are undeformed
std::string inWords(const Overlap& overlap, const std::vector<std::string>& bodies, const std::vector<std::string>& contacts, bool drawn,
                    const std::string& unit);

/// Finds bodies that penetrate each other, with or without a contact between them. The outlines of the bodies are sides whose nodes are
/// joined by straight lines and triangles. A node of an outline, and each piece of its edges between two intersections with another
/// outline, is inside a body according to the normal of the nearest side, which is found by bounding-box trees.
///
/// Costs one pass over the elements, once; after that only the parts of outlines inside the boxes of other bodies count: O(n log n) for
/// their n sides, all of which are on each rank.
class OverlapSearch {
 public:
  /// Local. \param meshes  of this rank; must outlive this object  \param bodies  number of bodies  \param given  lines of contacts with a
  /// gap given by the scene instead of the mesh: the bodies that they join are not at their drawn positions and are left out
  OverlapSearch(const std::vector<SubdomainMesh>& meshes, int bodies, const std::set<int>& given = {});

  /// For each pair of bodies the deepest point without a contact, if deeper than a hundredth of a side plus the distance between straight
  /// sides and curved bodies; and the deepest point with a contact, if deeper than half a side. The same on all ranks. Collective.
  /// \param displacement  of each mesh, without its lift, node-major; empty: undeformed bodies
  std::vector<Overlap> find(const Comm& comm, const std::vector<Vector>& displacement = {}) const;

 private:
  struct LinearSide {
    std::vector<int> nodes;  // two, in 3D three or four
    int group;
  };
  struct MeshOutline {
    std::vector<LinearSide> sides;
    std::vector<int> nodes;                  // nodes of the sides, ascending
    std::vector<std::vector<int>> contacts;  // lines of the contacts at each of the mesh's nodes; empty: the mesh has none
  };
  class Search;

  const std::vector<SubdomainMesh>& meshes_;
  int bodies_;
  std::set<int> given_;
  std::vector<std::string> groups_;
  std::vector<MeshOutline> outlines_;
};

}  // namespace suture
