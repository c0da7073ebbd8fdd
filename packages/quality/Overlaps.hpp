#pragma once
#include <suture/partition/SubdomainMesh.hpp>

#include <set>
#include <string>
#include <vector>

namespace suture {

/// Two bodies of which one reaches into the other.
struct Overlap {
  int body = -1, into = -1;    ///< places in ElasticModel::bodies
  std::string group, nearest;  ///< side group of `body` that is deepest inside, and of `into` nearest to it; empty: in none
  double depth = 0.0;          ///< its distance from the surface of `into` [length]
  Point place{0, 0, 0};        ///< where, as the body lies
  int contact = -1;            ///< line of a contact between both there; -1: none is declared
  int dimension = 2;

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.body), each(self.into), each(self.group), each(self.nearest), each(self.depth), each(self.place), each(self.contact);
    each(self.dimension);
  }
};

/// A warning about it. \param contacts  names of the contact lines  \param drawn  the bodies are as they are drawn
std::string inWords(const Overlap& overlap, const std::vector<std::string>& bodies, const std::vector<std::string>& contacts, bool drawn,
                    const std::string& unit);

/// Finds bodies that reach into each other, whatever the scene says of contact. The outlines of the bodies are sides whose nodes are joined
/// by straight lines and triangles. A node of an outline, and each piece of its edges between two places where it passes through another
/// outline, is inside a body by the sense of the nearest side's normal; trees of boxes find nearest sides.
///
/// Costs one pass over the elements, once; else only what outlines inside the boxes of other bodies do: n log n of their sides, which each
/// rank has all of.
class OverlapSearch {
 public:
  /// Local. \param meshes  of this rank; must outlive it  \param bodies  number of bodies  \param given  lines of contacts whose gap the
  /// scene gives instead of the mesh: bodies that they join are not where they are drawn, and are left out
  OverlapSearch(const std::vector<SubdomainMesh>& meshes, int bodies, const std::set<int>& given = {});

  /// For each two bodies the deepest place without a contact, by more than a hundredth of a side and what straight sides cut off curved
  /// bodies; and the deepest with one, by more than half a side. The same on all ranks. Collective.
  /// \param displacement  of each mesh, beside its lift, node-major; empty: bodies as they are drawn
  std::vector<Overlap> find(const Comm& comm, const std::vector<Vector>& displacement = {}) const;

 private:
  struct LinearSide {
    std::vector<int> nodes;  // two, in 3D three or four
    int group;
  };
  struct MeshOutline {
    std::vector<LinearSide> sides;
    std::vector<int> nodes;                  // of them, ascending
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
