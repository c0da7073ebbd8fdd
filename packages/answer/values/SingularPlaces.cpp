#include <suture/answer/values/SingularPlaces.hpp>
#include <suture/base/Gather.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/SideGeometry.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace suture {

namespace {

constexpr double kSharp = 0.70709;  // cosine of 45.001 degrees between normals: a ring of eight sides counts as round
constexpr double kBeyond = 0.05;    // distance beyond an edge at which a partner continues, relative to the side there

/// A facet of a side: in 2D a vertex, in 3D an edge.
struct SideFacet {
  const BoundarySide* side;
  Point middle;
  Point along;  // unit vector of the edge; zero in 2D
};

Point middleOf(const std::vector<Point>& points) {
  Point middle{0, 0, 0};
  for (const Point& point : points) middle = plus(middle, scaled(1.0 / double(points.size()), point));
  return middle;
}

double sizeOf(const BoundarySide& side) { return norm(minus(side.vertices[1], side.vertices[0])); }

/// Calls visit(one, other) for each pair of sides of one body that share a facet.
template <typename Visit>
void forEachEdge(const std::vector<BoundarySide>& sides, int dimension, const Visit& visit) {
  std::map<std::vector<GlobalId>, std::vector<SideFacet>> facets;
  for (const BoundarySide& side : sides) {
    const std::size_t vertices = side.vertices.size();
    for (std::size_t i = 0; i < vertices; ++i) {
      const std::size_t next = (i + 1) % vertices;
      std::vector<GlobalId> key{side.nodes[i]};
      SideFacet facet{&side, side.vertices[i], {0, 0, 0}};
      if (dimension == 3) {
        key = {std::min(side.nodes[i], side.nodes[next]), std::max(side.nodes[i], side.nodes[next])};
        facet.middle = scaled(0.5, plus(side.vertices[i], side.vertices[next]));
        facet.along = unit(minus(side.vertices[next], side.vertices[i]));
      }
      facets[key].push_back(facet);
    }
  }
  for (const auto& [key, meeting] : facets)
    if (meeting.size() == 2) visit(meeting[0], meeting[1]);
}

/// True if the middle of the second side is in front of the first: the edge is concave.
bool isHollow(const SideFacet& one, const SideFacet& other) {
  return dot(minus(middleOf(other.side->vertices), one.middle), one.side->normal) > 0;
}

bool isSharp(const SideFacet& one, const SideFacet& other) { return dot(one.side->normal, other.side->normal) < kSharp; }

/// True if a side that faces `normal` continues beyond an edge, in the direction `out`.
bool goesOn(const BoundarySide& side, const Point& normal, const Point& edge, const Point& out, double size) {
  if (dot(side.normal, normal) < kSharp) return false;
  return std::any_of(side.vertices.begin(), side.vertices.end(),
                     [&](const Point& vertex) { return dot(minus(vertex, edge), out) > kBeyond * size; });
}

bool shares(const BoundarySide& side, const std::vector<int>& nodes) {
  return std::any_of(side.nodes.begin(), side.nodes.end(),
                     [&](GlobalId node) { return std::binary_search(nodes.begin(), nodes.end(), int(node)); });
}

/// Calls visit(element) for the elements that contain one of some nodes. \param nodes  of the whole mesh, ascending
template <typename Visit>
void forEachElementAt(const SubdomainMesh& mesh, const std::vector<int>& nodes, const Visit& visit) {
  std::vector<char> wanted;
  for (const int node : nodes) {
    const auto at = std::lower_bound(mesh.globalNodes.begin(), mesh.globalNodes.end(), GlobalId(node));
    if (at == mesh.globalNodes.end() || *at != node) continue;
    if (wanted.empty()) wanted.assign(mesh.globalNodes.size(), 0);
    wanted[std::size_t(at - mesh.globalNodes.begin())] = 1;
  }
  for (int element = 0; !wanted.empty() && element < mesh.elements(); ++element) {
    const Span<const int> own = mesh.nodesOf(element);
    if (std::any_of(own.begin(), own.end(), [&](int node) { return wanted[std::size_t(node)] != 0; })) visit(element);
  }
}

/// Pairs with an end at one of some nodes, by id. The same on all ranks. Collective.
std::map<int, ContactPair> pairsAt(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<int>& nodes,
                                   const std::vector<int>& wanted) {
  std::vector<ContactPair> mine;
  for (const SubdomainMesh& mesh : meshes)
    for (const ContactRow& row : mesh.contactRows) {
      const auto isNear = [&](const PairEnd& end) { return std::binary_search(nodes.begin(), nodes.end(), end.node); };
      if (std::binary_search(wanted.begin(), wanted.end(), row.pair.id) || std::any_of(row.pair.ends.begin(), row.pair.ends.end(), isNear))
        mine.push_back(row.pair);
    }
  std::map<int, ContactPair> all;
  for (ContactPair& pair : joinEverywhere(comm, mine)) all.emplace(pair.id, std::move(pair));
  return all;
}

}  // namespace

std::vector<BoundarySide> boundarySidesAt(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<int>& nodes) {
  std::vector<BoundarySide> mine;
  for (const SubdomainMesh& mesh : meshes)
    forEachElementAt(mesh, nodes, [&](int element) {
      for (int number = 0; number < int(cellInfo(mesh.cells[std::size_t(element)]).sideNodes.size()); ++number) {
        BoundarySide side;
        side.body = mesh.body;
        const std::vector<int> local = mesh.nodesOf(Side{element, number});
        for (const int node : local) side.nodes.push_back(mesh.globalNodes[std::size_t(node)]);
        if (!shares(side, nodes)) continue;
        const int vertices = sideVertices(int(local.size()), mesh.dimension);
        for (int v = 0; v < vertices; ++v) side.vertices.push_back(mesh.point(local[std::size_t(v)]));
        for (const NodeNormal& normal : nodeNormals(side.vertices, mesh.dimension))
          side.normal = plus(side.normal, scaled(normal.weight, normal.density));
        side.normal = unit(side.normal);
        mine.push_back(std::move(side));
      }
    });
  std::map<std::vector<GlobalId>, std::vector<BoundarySide>> owners;
  for (BoundarySide& side : joinOnRoot(comm, mine)) {
    std::vector<GlobalId> key(side.nodes.begin(), side.nodes.begin() + std::ptrdiff_t(side.vertices.size()));
    std::sort(key.begin(), key.end());
    owners[key].push_back(std::move(side));
  }
  std::vector<BoundarySide> boundary;
  for (auto& [key, sides] : owners)
    if (sides.size() == 1) boundary.push_back(std::move(sides.front()));
  return boundary;
}

bool haveReentrantEdge(const std::vector<BoundarySide>& sides, int dimension) {
  bool found = false;
  forEachEdge(sides, dimension,
              [&](const SideFacet& one, const SideFacet& other) { found = found || (isSharp(one, other) && isHollow(one, other)); });
  return found;
}

bool endsOnPartner(const ContactPair& pair, const std::vector<BoundarySide>& sides, int dimension) {
  std::vector<int> nodes;
  for (const PairEnd& end : pair.ends) nodes.push_back(end.node);
  std::sort(nodes.begin(), nodes.end());
  const auto carrying = std::find_if(sides.begin(), sides.end(), [&](const BoundarySide& side) { return shares(side, {pair.node()}); });
  const int own = carrying == sides.end() ? -1 : carrying->body;
  // The normal points out of side A; it is the carrying node's outward normal if this node is on side A.
  const Point outOfOwn = pair.ends.front().weight > 0 ? pair.normal : scaled(-1, pair.normal);
  bool found = false;
  for (const bool ofOwn : {true, false}) {
    const Point out = ofOwn ? outOfOwn : scaled(-1, outOfOwn);
    std::vector<BoundarySide> ending;
    std::vector<const BoundarySide*> partners;
    for (const BoundarySide& side : sides) {
      if (!shares(side, nodes)) continue;
      if ((side.body == own) == ofOwn)
        ending.push_back(side);
      else
        partners.push_back(&side);
    }
    forEachEdge(ending, dimension, [&](const SideFacet& one, const SideFacet& other) {
      if (!isSharp(one, other)) return;
      for (const auto& [facing, beyond] : {std::pair(&one, &other), std::pair(&other, &one)}) {
        if (found || dot(facing->side->normal, out) < kSharp || dot(beyond->side->normal, out) >= kSharp || isHollow(*facing, *beyond))
          continue;
        Point way = minus(facing->middle, middleOf(facing->side->vertices));
        way = minus(way, scaled(dot(way, facing->along), facing->along));
        way = minus(way, scaled(dot(way, out), out));
        if (!(norm(way) > 0)) continue;
        for (const BoundarySide* partner : partners)
          found = found || goesOn(*partner, scaled(-1, out), facing->middle, unit(way), sizeOf(*facing->side));
      }
    });
  }
  return found;
}

std::vector<std::string> singularities(const Comm& comm, const std::vector<SubdomainMesh>& meshes,
                                       const std::vector<PlaceInQuestion>& places, const std::vector<int>& closed) {
  std::vector<std::string> all;
  for (const PlaceInQuestion& place : places) {
    std::vector<int> nodes = place.nodes;
    std::sort(nodes.begin(), nodes.end());
    const std::map<int, ContactPair> pairs =
        pairsAt(comm, meshes, nodes, place.pair < 0 ? std::vector<int>() : std::vector<int>{place.pair});
    std::vector<int> wanted = nodes;
    for (const auto& [id, pair] : pairs)
      for (const PairEnd& end : pair.ends) wanted.push_back(end.node);
    std::sort(wanted.begin(), wanted.end());
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    const std::vector<BoundarySide> sides = boundarySidesAt(comm, meshes, wanted);
    std::string what;
    collectivelyOnRoot(comm, "looking at the places of largest values", [&] {
      if (sides.empty()) return;
      const int dimension = sides.front().vertices.size() == 2 ? 2 : 3;
      std::vector<BoundarySide> near;
      for (const BoundarySide& side : sides)
        if (shares(side, nodes)) near.push_back(side);
      if (haveReentrantEdge(near, dimension)) what = "a re-entrant corner";
      for (const auto& [id, pair] : pairs)
        if (what.empty() && std::binary_search(closed.begin(), closed.end(), id) && endsOnPartner(pair, sides, dimension))
          what = "the end of a contact side on a partner that continues";
    });
    all.push_back(broadcast(comm, what));
  }
  return all;
}

}  // namespace suture
