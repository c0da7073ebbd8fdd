#pragma once
#include <suture/adapt/ContactTwins.hpp>
#include <suture/mesh/Mesh.hpp>

#include <array>
#include <map>
#include <unordered_map>
#include <vector>

namespace suture {

/// Vertices of the coarse mesh between which a vertex lies: itself, the ends of an edge, the corners of a face or a tetrahedron. Ascending.
struct Carrier {
  std::array<int, 4> vertices{{-1, -1, -1, -1}};
  int count = 0;

  void add(int vertex);
  static Carrier of(int vertex);
  static Carrier ofBoth(const Carrier& a, const Carrier& b);
};

/// Edges of contact faces and their opposites on the other face, during one bisection of a mesh. A contact face counts where a side and the
/// side at the opposite nodes both lie on the boundary. Each face of a contact is a view (2 c: face A of contact c, 2 c + 1: face B), in
/// which a vertex has one opposite vertex. Local (rank 0).
class TwinEdges {
 public:
  TwinEdges(const Mesh& mesh, const std::vector<NodePairs>& contacts);

  /// Calls visit(view, p', q') for the opposite of edge p q in each view that the edge lies in. \param carrier  of both ends
  template <typename Visit>
  void forEachTwin(int p, int q, const Carrier& carrier, const Visit& visit) const {
    const auto found = views_.find(keyOf(carrier));
    if (found == views_.end()) return;
    for (const int view : found->second) visit(view, twinOf(p, view), twinOf(q, view));
  }
  bool empty() const { return views_.empty(); }
  /// Adds a new vertex and its opposite; also the other way round.
  void add(int view, int vertex, int twin);
  /// Mid-side node of an edge of a contact face in a mesh of second order; -1 in others.
  int middleOf(int p, int q) const;
  /// Calls visit(view, p, q, p', q') for each edge of a contact face and its opposite.
  template <typename Visit>
  void forEachEdge(const Visit& visit) const {
    for (const auto& [key, views] : views_) {
      if (key.rest > 0x7fffffff) continue;  // a face
      const int p = key.low, q = static_cast<int>(key.rest);
      for (const int view : views) visit(view, p, q, twinOf(p, view), twinOf(q, view));
    }
  }
  /// Opposite vertices of each contact.
  std::vector<NodePairs> pairs() const;

 private:
  static SideKey keyOf(const Carrier& carrier);
  int twinOf(int vertex, int view) const;
  void addSide(const Mesh& mesh, const Side& side, int view);

  int contacts_;
  std::map<SideKey, std::vector<int>> views_;  ///< views that contain an edge or side of a contact face
  std::unordered_map<long long, int> twins_;   ///< by vertex and view
  std::map<SideKey, int> middles_;
};

}  // namespace suture
