#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/SideGeometry.hpp>
#include <suture/pairs/FaceCheck.hpp>

#include <algorithm>
#include <cstdio>
#include <set>

namespace suture {

namespace {

/// The sharpest corner of a surface.
struct Turn {
  double angle = 0;
  int node = -1;
};

Turn sharpestTurn(const Surface& line) {
  Turn turn;
  for (const auto& [node, data] : line.nodes()) {
    turn = {0, node};
    for (const Point& normal : data.sideNormals) turn.angle = std::max(turn.angle, angleBetween(data.sideNormals[0], normal));
    if (turn.angle > kSharpAngle) break;
  }
  return turn;
}

/// The same in 3D, between sides that share an edge.
Turn sharpestEdge(const Surface& surface) {
  std::vector<std::vector<NodeNormal>> normals;
  for (int side = 0; side < surface.sides(); ++side) {
    std::vector<Point> points;
    for (const int node : surface.nodesOf(side)) points.push_back(surface.at(node).position);
    normals.push_back(nodeNormals(points, 3));
  }
  for (int side = 0; side < surface.sides(); ++side)
    for (int facet = 0; facet < surface.facets(side); ++facet) {
      const Surface::Facet& other = surface.across(side, facet);
      if (other.side < side) continue;
      // The edge runs from the facet's vertex to the next one, in the other side in the opposite order.
      const int next = (facet + 1) % surface.facets(side), otherNext = (other.facet + 1) % surface.facets(other.side);
      for (const auto& [own, its] : {std::make_pair(facet, otherNext), std::make_pair(next, other.facet)}) {
        const Turn turn{angleBetween(normals[side][own].density, normals[other.side][its].density), surface.nodesOf(side)[own]};
        if (turn.angle > kSharpAngle) return turn;
      }
    }
  return {};
}

/// Reads and checks one face of one contact.
class FaceCheck {
 public:
  FaceCheck(const Mesh& mesh, const SideTable& table, const std::string& path, Problems& problems)
      : mesh_(mesh), table_(table), path_(path), problems_(problems) {}

  /// The face; without a surface after a problem.
  ContactFace read(const std::vector<std::string>& groups) {
    ContactFace face;
    face.groups = groups;
    if (groups.empty() || std::count(groups.begin(), groups.end(), "") > 0) return face;
    bool known = true;
    for (const std::string& group : groups) known = exists(group) && known;
    if (!known) return face;
    const std::vector<Side> sides = sidesOf(mesh_.sideGroups, groups);
    std::set<int> bodies;
    std::set<int> orders;
    for (const Side& side : sides) {
      bodies.insert(mesh_.bodyOfElement[side.element]);
      orders.insert(cellInfo(mesh_.cells[side.element]).order);
      if (table_.onBoundary(side)) continue;
      wrong(face.name() + " lies inside the material near " + placeText(centreOf(mesh_, side.element), mesh_.dimension) +
            "; expected a part of the boundary of bodies");
      return face;
    }
    face.bodies.assign(bodies.begin(), bodies.end());
    if (orders.size() > 1) {
      wrong(face.name() + (mesh_.dimension == 2 ? " has two-node and three-node sides" : " has first-order and second-order sides") +
            "; expected elements of one order along a contact side");
      return face;
    }
    Surface surface(mesh_, sides);
    if (isSound(face, surface)) face.surface = std::move(surface);
    return face;
  }

 private:
  void wrong(const std::string& what) { problems_.add(path_, what); }

  bool exists(const std::string& group) {
    const std::string problem = sideGroupProblem(mesh_, group);
    if (!problem.empty()) wrong(problem);
    return problem.empty();
  }

  bool isSound(const ContactFace& face, const Surface& surface) {
    const bool inPlane = mesh_.dimension == 2;
    const auto place = [&](int node) { return placeText(mesh_.point(node), mesh_.dimension); };
    if (!surface.branchings().empty()) {
      wrong(face.name() +
            (inPlane ? " is not a line: more than two of its elements meet at "
                     : " is not a surface: more than two of its sides meet along the edge at ") +
            place(surface.branchings()[0]));
      return false;
    }
    const Turn turn = inPlane ? sharpestTurn(surface) : sharpestEdge(surface);
    if (turn.angle <= kSharpAngle) return true;
    char degrees[20];
    std::snprintf(degrees, sizeof degrees, "%.0f", turn.angle * 180 / 3.14159265358979);
    wrong(face.name() + " turns by " + degrees + " degrees at " + place(turn.node) + "; the contact has no normal there. Make each " +
          (inPlane ? "leg a separate contact line" : "face a separate contact"));
    return false;
  }

  const Mesh& mesh_;
  const SideTable& table_;
  std::string path_;
  Problems& problems_;
};

}  // namespace

ContactFace readFace(const Mesh& mesh, const SideTable& table, const std::vector<std::string>& groups, const std::string& path,
                     Problems& problems) {
  return FaceCheck(mesh, table, path, problems).read(groups);
}

}  // namespace suture
