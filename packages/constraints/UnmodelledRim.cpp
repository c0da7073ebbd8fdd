#include <suture/base/Point.hpp>
#include <suture/constraints/Conditions.hpp>
#include <suture/constraints/UnmodelledRim.hpp>
#include <suture/mesh/SideGeometry.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace suture {

namespace {

constexpr double kSmooth = 0.866;  // cosine of 30 degrees, between normals of sides: a circle of twelve sides is smooth

/// Nodes of the facets (end points, in 3D edges) that belong to only one side.
std::set<int> rimNodes(const Surface& surface) {
  std::set<int> rim;
  for (int side = 0; side < surface.sides(); ++side)
    for (int facet = 0; facet < surface.facets(side); ++facet) {
      if (surface.across(side, facet).side >= 0) continue;
      const std::vector<int>& nodes = surface.nodesOf(side);
      const std::size_t vertices = surface.facets(side), at = facet;
      rim.insert(nodes[at]);
      if (surface.dimension() == 2) continue;
      rim.insert(nodes[(at + 1) % vertices]);
      if (nodes.size() > vertices) rim.insert(nodes[vertices + at]);  // the middle of the edge
    }
  return rim;
}

/// Pairs of the facets that belong to only one cell.
std::set<int> rimPairs(const std::vector<std::vector<int>>& cells) {
  std::map<std::set<int>, int> uses;
  for (const std::vector<int>& cell : cells)
    for (std::size_t i = 0; i < cell.size(); ++i)
      ++uses[cell.size() == 2 ? std::set<int>{cell[i]} : std::set<int>{cell[i], cell[(i + 1) % cell.size()]}];
  std::set<int> rim;
  for (const auto& [facet, count] : uses)
    if (count == 1) rim.insert(facet.begin(), facet.end());
  return rim;
}

/// Vertices of a side, ascending: the same from both elements that share it.
std::vector<int> verticesOf(const Mesh& mesh, const Side& side) {
  std::vector<int> vertices = mesh.nodesOf(side);
  vertices.resize(sideVertices(static_cast<int>(vertices.size()), mesh.dimension));
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

/// Normals, at the given nodes, of boundary sides that are in no contact and no condition.
class FreeSides {
 public:
  FreeSides(const Mesh& mesh, const std::set<int>& nodes, const std::vector<Side>& taken) {
    std::vector<char> wanted(mesh.nodes(), 0);
    for (const int node : nodes) wanted[node] = 1;
    const auto isWanted = [&](int node) { return wanted[node] != 0; };
    std::map<std::vector<int>, std::vector<Side>> owners;
    for (int element = 0; element < mesh.elements(); ++element) {
      const Span<const int> own = mesh.nodesOf(element);
      if (std::none_of(own.begin(), own.end(), isWanted)) continue;
      for (int side = 0; side < static_cast<int>(cellInfo(mesh.cells[element]).sideNodes.size()); ++side) {
        const std::vector<int> vertices = verticesOf(mesh, {element, side});
        if (std::any_of(vertices.begin(), vertices.end(), isWanted)) owners[vertices].push_back({element, side});
      }
    }
    for (const Side& side : taken) owners.erase(verticesOf(mesh, side));
    for (const auto& [vertices, sides] : owners)
      if (sides.size() == 1) add(mesh, sides.front());
  }

  /// True if the normal of a free side at the node is within 30 degrees of `normal`.
  bool goOn(int node, const Point& normal) const {
    const auto at = normals_.find(node);
    return at != normals_.end() &&
           std::any_of(at->second.begin(), at->second.end(), [&](const Point& own) { return dot(own, normal) > kSmooth; });
  }

 private:
  void add(const Mesh& mesh, const Side& side) {
    const std::vector<int> nodes = mesh.nodesOf(side);
    std::vector<Point> points;
    for (const int node : nodes) points.push_back(mesh.point(node));
    const std::vector<NodeNormal> normals = nodeNormals(points, mesh.dimension);
    for (std::size_t i = 0; i < nodes.size(); ++i) normals_[nodes[i]].push_back(unit(normals[i].density));
  }

  std::map<int, std::vector<Point>> normals_;
};

}  // namespace

void findOpenEnds(const Mesh& mesh, const std::vector<Condition>& conditions, const std::vector<ContactSurface>& contacts,
                  Constraints& constraints) {
  if (contacts.empty()) return;
  std::vector<Side> taken;
  const auto take = [&](const std::vector<std::string>& groups) {
    const std::vector<Side> own = sidesOf(mesh.sideGroups, groups);
    taken.insert(taken.end(), own.begin(), own.end());
  };
  for (const Condition& condition : conditions) take(condition.groups);
  std::set<int> nodes;
  std::map<int, std::vector<std::pair<const Surface*, std::set<int>>>> faces;  // surfaces and their rims, by line
  for (const ContactSurface& contact : contacts)
    for (const ContactFace* face : {&contact.a, &contact.b}) {
      if (face->empty()) continue;
      take(face->groups);
      faces[contact.number].emplace_back(&*face->surface, rimNodes(*face->surface));
      nodes.insert(faces[contact.number].back().second.begin(), faces[contact.number].back().second.end());
    }
  const std::map<int, int> under = nodesUnderCoatings(mesh);
  const auto onBody = [&](int node) {
    const auto found = under.find(node);
    return found == under.end() ? node : found->second;
  };
  std::set<int> onBodies;
  for (const int node : nodes) onBodies.insert(onBody(node));
  const FreeSides free(mesh, onBodies, taken);
  std::set<int> last;
  for (const ContactPiece& piece : constraints.pieces) last.merge(rimPairs(piece.cells));
  for (const ContactPair& pair : constraints.pairs) {
    if (last.count(pair.id) == 0) continue;
    bool onRim = false, closedOff = false;
    for (const auto& [surface, rim] : faces[pair.line])
      for (const PairEnd& end : pair.ends) {
        if (rim.count(end.node) == 0) continue;
        onRim = true;
        closedOff = closedOff || !free.goOn(onBody(end.node), surface->normal(end.node));
      }
    if (onRim && !closedOff) constraints.pieces[pair.piece].openEnds.push_back(pair.id);
  }
}

}  // namespace suture
