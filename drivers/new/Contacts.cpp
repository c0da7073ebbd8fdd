#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/BoxTree.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/SideTable.hpp>
#include <suture/mesh/Surface.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <set>

#include "Proposal.hpp"

namespace suture::proposal {

namespace {

constexpr double kOpposite = -0.5;  // cosine between normals that face each other
constexpr double kReach = 0.05;     // largest clearance over the diagonal of the smaller body
constexpr int kFewest = 3;          // least number of facing nodes of a contact
constexpr double kCorner = 0.2;     // least part of a group's facing nodes; a smaller one is the end of a neighbouring contact
constexpr double kSpacings = 1.5;   // largest distance between facing nodes over that between neighbours

using Key = std::pair<int, int>;
Key keyOf(const Side& side) { return {side.element, side.side}; }

/// A group as nodes with normals, and a tree to find them by.
struct Face {
  Surface surface;
  std::vector<int> nodes;
  std::unique_ptr<BoxTree> tree;

  Face(const Mesh& mesh, const std::vector<Side>& sides) : surface(mesh, sides) {
    std::vector<BoundingBox> boxes;
    for (const auto& [node, own] : surface.nodes()) {
      nodes.push_back(node);
      boxes.emplace_back();
      boxes.back().include(own.position);
    }
    tree = std::make_unique<BoxTree>(boxes);
  }
};

struct Facing {
  int nodes = 0;
  double gap = std::numeric_limits<double>::infinity();
  Point normal{0, 0, 0}, place{0, 0, 0};
};

/// Nodes of `a` that face `b` within reach.
Facing facing(const Face& a, const Face& b, double reach) {
  Facing result;
  for (const int node : a.nodes) {
    const Surface::Node& own = a.surface.at(node);
    const int at = b.tree->nearest(own.position, [&](int i) { return norm(minus(b.surface.at(b.nodes[i]).position, own.position)); });
    if (at < 0) continue;
    const Surface::Node& other = b.surface.at(b.nodes[at]);
    const Point way = minus(other.position, own.position), n = a.surface.normal(node);
    if (dot(n, b.surface.normal(b.nodes[at])) > kOpposite) continue;
    const double along = std::abs(dot(way, n));
    const double spacing =
        kSpacings * std::max(std::isfinite(own.spacing) ? own.spacing : 0.0, std::isfinite(other.spacing) ? other.spacing : 0.0);
    if (along > std::max(reach, spacing) || norm(minus(way, scaled(dot(way, n), n))) > std::max(spacing, along / 2)) continue;
    ++result.nodes;
    result.normal = plus(result.normal, n);
    if (along < result.gap) {
      result.gap = along;
      result.place = own.position;
    }
  }
  return result;
}

double smallestExtent(const std::pair<Point, Point>& box) { return norm(minus(box.second, box.first)); }

/// Sides on the boundary of the bodies that belong to no group, by body.
std::map<int, std::vector<Side>> unnamedSides(const Mesh& mesh, const std::vector<Group>& groups) {
  std::set<Key> named;
  for (const Group& group : groups)
    for (const Side& side : group.all) named.insert(keyOf(side));
  const SideTable table(mesh, std::vector<char>(mesh.nodes(), 1));
  std::map<int, std::vector<Side>> result;
  for (int e = 0; e < mesh.elements(); ++e)
    forEachSide(mesh, e, [&](const std::pair<int, int>&, const Side& side) {
      if (!named.count(keyOf(side)) && table.onBoundary(side)) result[mesh.bodyOfElement[e]].push_back(side);
    });
  return result;
}

bool strictlyWithin(const Group& small, const Group& large) {
  if (small.all.size() >= large.all.size()) return false;
  std::set<Key> keys;
  for (const Side& side : large.all) keys.insert(keyOf(side));
  return std::all_of(small.all.begin(), small.all.end(), [&](const Side& side) { return keys.count(keyOf(side)) > 0; });
}

}  // namespace

std::vector<Group> groupsOf(const Mesh& mesh) {
  std::vector<Group> result;
  for (const auto& [name, sides] : mesh.sideGroups) {
    if (sides.empty()) continue;
    Group group;
    group.name = name;
    group.sides = static_cast<int>(sides.size());
    group.all = sides;
    std::set<int> bodies;
    BoundingBox box;
    for (const Side& side : sides) bodies.insert(mesh.bodyOfElement[side.element]);
    if (bodies.size() == 1) group.body = *bodies.begin();
    const Surface surface(mesh, sides);
    for (const auto& [node, own] : surface.nodes()) {
      group.size += own.tributary;
      box.include(own.position);
      group.centre = plus(group.centre, scaled(1.0 / static_cast<double>(surface.nodes().size()), own.position));
    }
    group.low = box.low;
    group.high = box.high;
    result.push_back(std::move(group));
  }
  return result;
}

Contacts proposeContacts(const Mesh& mesh, const std::vector<Group>& groups) {
  const auto boxes = boxesOf(mesh);
  const auto reach = [&](int a, int b) { return kReach * std::min(smallestExtent(boxes[a]), smallestExtent(boxes[b])); };
  std::vector<std::unique_ptr<Face>> faces;
  for (const Group& group : groups) faces.push_back(group.body >= 0 ? std::make_unique<Face>(mesh, group.all) : nullptr);

  std::map<std::pair<int, int>, Facing> found;  // both ways
  for (std::size_t i = 0; i < groups.size(); ++i)
    for (std::size_t j = i + 1; j < groups.size(); ++j) {
      if (!faces[i] || !faces[j] || groups[i].body == groups[j].body) continue;
      const double near = reach(groups[i].body, groups[j].body);
      const Facing there = facing(*faces[i], *faces[j], near), back = facing(*faces[j], *faces[i], near);
      if (there.nodes + back.nodes < kFewest || there.nodes == 0 || back.nodes == 0) continue;
      found[{int(i), int(j)}] = there;
      found[{int(j), int(i)}] = back;
    }
  std::vector<int> most(groups.size(), 0);
  for (const auto& [pair, facing] : found) most[pair.first] = std::max(most[pair.first], facing.nodes);
  for (auto pair = found.begin(); pair != found.end();)
    pair = pair->second.nodes < kCorner * most[pair->first.first] ? found.erase(pair) : std::next(pair);
  // A group that lies within another one says more than that.
  for (auto pair = found.begin(); pair != found.end();) {
    const auto [i, j] = pair->first;
    const bool coarse = std::any_of(found.begin(), found.end(), [&, i = i, j = j](const auto& other) {
      const auto [k, l] = other.first;
      return (l == j && k != i && strictlyWithin(groups[k], groups[i])) || (k == i && l != j && strictlyWithin(groups[l], groups[j]));
    });
    pair = coarse ? found.erase(pair) : std::next(pair);
  }

  Contacts result;
  std::set<std::pair<int, int>> open;
  for (const auto& [pair, facing] : found)
    if (found.count({pair.second, pair.first})) open.insert(pair);
  while (!open.empty()) {
    std::map<int, int> partners;
    for (const auto& [i, j] : open) ++partners[i];
    int widest = open.begin()->first;
    for (const auto& [i, count] : partners)
      if (count > partners[widest]) widest = i;
    Contact contact;
    contact.sideA = groups[widest].name;
    contact.gap = std::numeric_limits<double>::infinity();
    for (const auto& [pair, facing] : found) {
      if (pair.first != widest || !open.count(pair)) continue;
      contact.sideB.push_back(groups[pair.second].name);
      const double rounding = 1e-12 * reach(groups[widest].body, groups[pair.second].body) / kReach;
      contact.gap = std::min(contact.gap, facing.gap > rounding ? facing.gap : 0.0);
      contact.normal = plus(contact.normal, facing.normal);
      open.erase(pair);
      open.erase({pair.second, pair.first});
    }
    if (norm(contact.normal) > 0.0) contact.normal = unit(contact.normal);
    result.all.push_back(std::move(contact));
  }

  // Once a pair of bodies; sides beyond the ends of a proposed contact face each other, too, and are none of it.
  std::set<std::pair<int, int>> told;
  for (const auto& [pair, facing] : found) told.insert(std::minmax(groups[pair.first].body, groups[pair.second].body));
  const auto tell = [&](int body, int other, const Facing& there) {
    if (there.nodes < kFewest || !told.insert(std::minmax(body, other)).second) return;
    result.notes.push_back("'" + mesh.bodies[body] + "' and '" + mesh.bodies[other] + "' face each other near " +
                           placeText(there.place, mesh.dimension) + " with sides in no curve group: name these, if they may touch");
  };
  const std::map<int, std::vector<Side>> unnamed = unnamedSides(mesh, groups);
  for (const auto& [body, sides] : unnamed) {
    const Face face(mesh, sides);
    for (std::size_t j = 0; j < groups.size(); ++j)
      if (faces[j] && groups[j].body != body) tell(body, groups[j].body, facing(face, *faces[j], reach(body, groups[j].body)));
    for (const auto& [other, theirs] : unnamed)
      if (other > body) tell(body, other, facing(face, Face(mesh, theirs), reach(body, other)));
  }
  return result;
}

std::vector<Support> proposeSupports(const Mesh& mesh, const std::vector<Group>& groups, const Contacts& contacts) {
  const auto boxes = boxesOf(mesh);
  const int up = mesh.dimension - 1;
  int ground = 0;
  for (std::size_t b = 1; b < boxes.size(); ++b)
    if (boxes[b].first[up] < boxes[ground].first[up]) ground = static_cast<int>(b);
  std::set<std::string> touching;
  std::map<int, Point> push;  // by body: direction towards the body that it faces
  const auto bodyOf = [&](const std::string& name) {
    return std::find_if(groups.begin(), groups.end(), [&](const Group& group) { return group.name == name; })->body;
  };
  for (const Contact& contact : contacts.all) {
    touching.insert(contact.sideA);
    push.try_emplace(bodyOf(contact.sideA), contact.normal);
    for (const std::string& side : contact.sideB) {
      touching.insert(side);
      push.try_emplace(bodyOf(side), scaled(-1.0, contact.normal));
    }
  }
  std::vector<Support> result;
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    const int body = static_cast<int>(b);
    const Point down = [&] {
      Point p{0, 0, 0};
      p[up] = -1.0;
      return p;
    }();
    const Point way = body == ground ? down : push.count(body) ? push[body] : scaled(-1.0, down);
    // The ground is held where it is lowest, another body on the side away from its contact.
    const Group* best = nullptr;
    for (const Group& group : groups) {
      if (group.body != body || touching.count(group.name)) continue;
      const double sign = body == ground ? 1.0 : -1.0;
      if (!best || sign * dot(way, group.centre) > sign * dot(way, best->centre)) best = &group;
    }
    if (!best) continue;
    Support support;
    support.body = mesh.bodies[b];
    support.group = best->name;
    if (body != ground && push.count(body)) support.displacement = scaled(1e-3 * smallestExtent(boxes[b]), way);
    result.push_back(std::move(support));
  }
  return result;
}

}  // namespace suture::proposal
