#pragma once
#include <suture/base/Types.hpp>

#include <map>
#include <vector>

namespace suture {

enum class EntityKind : int { Vertex = 0, Edge = 1, Face = 2 };

/// A maximal connected set of seam nodes that the same subdomains share. Seams between subdomains are edges in 2D and faces in 3D.
struct SeamEntity {
  EntityKind kind = EntityKind::Vertex;
  std::vector<int> sharers;     ///< ids of the subdomains, ascending; two or more
  std::vector<GlobalId> nodes;  ///< nodes of an edge in order along it, if that is known; otherwise ascending
  std::vector<GlobalId> ends;   ///< nodes of an edge where it ends without a vertex (at the boundary of the body), in order
  std::vector<int> boundary;    ///< bounding entities, as indices in the list; for an ordered edge first those at its front
};

/// Nodes that several subdomains share, and the sides that connect them. Finds the entities of this graph.
///
/// The sharers of a side, or of an edge of a side, are the subdomains that have it as a side (an edge) of an element. Two nodes are
/// connected if they lie on a common side or edge that has the same sharers as the nodes. The dimension of that side is the kind of the
/// entity. A node on no such side is a vertex, and so is a node through which an edge passes more than once. Used for subdomains in 2D and
/// 3D, for closed pairs of a contact line, and for coarse unknowns of clusters. Local.
class EntityGraph {
 public:
  /// \param sharers  ascending, two or more
  /// \param single   true: a separate vertex, regardless of its sides
  void addNode(GlobalId node, std::vector<int> sharers, bool single = false);

  /// Adds a side that two (or more) subdomains share: a segment, a triangle or a quadrilateral. A repeated side counts once.
  /// \param nodes     added before: the vertices in their order around the side, then the mid-edge nodes in the same order (for a segment
  ///                  its midpoint), then an interior node
  /// \param vertices  number of vertices among them: 2, 3 or 4
  /// \param sharers   ascending
  void addSide(const std::vector<GlobalId>& nodes, int vertices, const std::vector<int>& sharers);

  /// Adds nodes that are connected without order, as an edge or a face. \param nodes  added before
  void addSet(std::vector<GlobalId> nodes, std::vector<int> sharers, EntityKind kind);

  /// Vertices by node, then edges and faces, each by sharers and first node. The direction of an edge depends only on its numbers: from the
  /// lower end; a ring starts at its lowest node, towards the lower neighbour. A part of a side without nodes is no entity.
  std::vector<SeamEntity> entities() const;

 private:
  struct Node {
    std::vector<int> sharers;
    bool single;
  };
  struct Face {
    EntityKind kind;
    bool ordered;                 // neighbours in `nodes` are neighbours on the edge
    std::vector<GlobalId> nodes;  // nodes of an edge in order
    std::vector<int> sharers;
  };
  class Finder;

  void addFace(EntityKind kind, std::vector<GlobalId> key, const std::vector<GlobalId>& nodes, const std::vector<int>& sharers);

  std::map<GlobalId, Node> nodes_;
  std::map<std::vector<GlobalId>, Face> faces_;  // by vertices, ascending
  std::vector<Face> sets_;
};

}  // namespace suture
