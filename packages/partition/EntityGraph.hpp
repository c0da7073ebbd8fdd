#pragma once
#include <suture/base/Types.hpp>

#include <map>
#include <vector>

namespace suture {

enum class EntityKind : int { Vertex = 0, Edge = 1, Face = 2 };

/// A maximal connected set of seam nodes that the same subdomains share. Seams between bodies in the plane are edges, those in space faces.
struct SeamEntity {
  EntityKind kind = EntityKind::Vertex;
  std::vector<int> sharers;     ///< ids of the subdomains, ascending; two or more
  std::vector<GlobalId> nodes;  ///< nodes of an edge in order along it, where that is known; else ascending
  std::vector<GlobalId> ends;   ///< those of an edge's nodes where it ends at no vertex (at the boundary of the body), in order
  std::vector<int> boundary;    ///< entities that bound it, as places in the list; of an edge with an order first those at its front
};

/// Nodes that several subdomains share, and the sides through which they hang together. Gives the entities that the sides leave.
///
/// The sharers of a side, or of an edge of a side, are the subdomains that have it as a side (an edge) of an element. Two nodes hang
/// together when they lie on a common side or edge with the same sharers as they have. The dimension of that side is the kind of the
/// entity; a node that lies on no such side is a vertex by itself. So is a node through which an edge passes more than once. The same for
/// subdomains in the plane and in space, for closed pairs of a contact line, and for coarse unknowns of clusters. Local.
class EntityGraph {
 public:
  /// \param sharers  ascending, two or more
  /// \param single   true: a vertex by itself, whatever its sides
  void addNode(GlobalId node, std::vector<int> sharers, bool single = false);

  /// A side that two subdomains (or more) share: a segment, a triangle or a quadrilateral. A side that comes again counts once.
  /// \param nodes     added before: the vertices in their order around the side, then the middle nodes of its edges in the same order (of
  ///                  a segment the one in the middle), then one inside
  /// \param vertices  how many of them are vertices: 2, 3 or 4
  /// \param sharers   ascending
  void addSide(const std::vector<GlobalId>& nodes, int vertices, const std::vector<int>& sharers);

  /// Nodes that hang together without order, as an edge or a face. \param nodes  added before
  void addSet(std::vector<GlobalId> nodes, std::vector<int> sharers, EntityKind kind);

  /// Vertices by node, then edges and faces, each by sharers and first node. The sense of an edge follows from its numbers alone: from the
  /// lower end; a ring begins at its lowest node, towards the lower neighbour. A part of a side without a node of its own is no entity.
  std::vector<SeamEntity> entities() const;

 private:
  struct Node {
    std::vector<int> sharers;
    bool single;
  };
  struct Face {
    EntityKind kind;
    bool ordered;                 // neighbours in `nodes` are neighbours on the edge
    std::vector<GlobalId> nodes;  // of an edge in order
    std::vector<int> sharers;
  };
  class Finder;

  void addFace(EntityKind kind, std::vector<GlobalId> key, const std::vector<GlobalId>& nodes, const std::vector<int>& sharers);

  std::map<GlobalId, Node> nodes_;
  std::map<std::vector<GlobalId>, Face> faces_;  // by vertices, ascending
  std::vector<Face> sets_;
};

}  // namespace suture
