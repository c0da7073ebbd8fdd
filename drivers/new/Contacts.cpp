#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/BoxTree.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/SideTable.hpp>
#include <suture/mesh/Surface.hpp>
#include <suture/pairs/ContactSurface.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <set>

#include "Proposal.hpp"

namespace suture::proposal {

namespace {

constexpr double kOpposite = -0.5;  // largest cosine between normals that face each other
constexpr double kReach = 0.05;     // largest clearance over the diagonal of the smaller body
constexpr int kFewest = 3;          // smallest number of facing nodes in a contact
constexpr double kCorner = 0.2;     // smallest fraction of facing nodes in a group; below, it is the end of a neighbouring contact
constexpr double kSpacings = 1.5;   // largest distance between facing nodes over the node spacing
constexpr double kEnd = 0.1;        // distance beyond the end of a side over the node spacing
constexpr double kDrawn = 1e-3;     // overlap over the node spacing below which it is an inaccuracy of the drawing
constexpr double kSense = 0.1;      // length of the mean normal below which a side faces all around

using Key = std::pair<int, int>;
Key keyOf(const Side& side) { return {side.element, side.side}; }

/// A group as nodes with normals, and a search tree for them.
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
  double gap = std::numeric_limits<double>::infinity();  // < 0: the sides overlap
  Point sum{0, 0, 0};                                    // sum of the normals at these nodes
  Point normal{0, 0, 0}, place{0, 0, 0};                 // at the smallest gap
};

/// Distance of two facing nodes along both normals, < 0 for an overlap, 0 for an overlap within the accuracy of a drawing.
/// The mean of the distances to both tangents is exact for concentric arcs; otherwise the angle between the tangents bounds its error.
double distanceOf(const Point& way, const Point& own, const Point& other, double spacing) {
  const double distance = (dot(way, own) - dot(way, other)) / 2;
  const double aside = norm(minus(way, scaled(dot(way, own), own)));
  return distance < -(aside * norm(plus(own, other)) + kDrawn * spacing) ? distance : std::max(distance, 0.0);
}

/// True if a point lies beyond the end of a surface: the nearest node there has no neighbour on that side.
bool isBeyond(const Surface& surface, const Surface::Node& nearest, const Point& aside) {
  return std::isfinite(nearest.spacing) && norm(aside) > kEnd * nearest.spacing &&
         std::all_of(nearest.beside.begin(), nearest.beside.end(),
                     [&](int node) { return dot(minus(surface.at(node).position, nearest.position), aside) < 0; });
}

/// Nodes of `a` that face `b` within reach.
Facing facing(const Face& a, const Face& b, double reach) {
  Facing result;
  for (const int node : a.nodes) {
    const Surface::Node& own = a.surface.at(node);
    const int at = b.tree->nearest(own.position, [&](int i) { return norm(minus(b.surface.at(b.nodes[i]).position, own.position)); });
    if (at < 0) continue;
    const Surface::Node& other = b.surface.at(b.nodes[at]);
    const Point way = minus(other.position, own.position), n = a.surface.normal(node), m = b.surface.normal(b.nodes[at]);
    if (dot(n, m) > kOpposite) continue;
    const Point aside = minus(way, scaled(dot(way, n), n));
    if (isBeyond(b.surface, other, scaled(-1.0, aside))) continue;
    const double along = std::abs(dot(way, n));
    const double spacing =
        kSpacings * std::max(std::isfinite(own.spacing) ? own.spacing : 0.0, std::isfinite(other.spacing) ? other.spacing : 0.0);
    if (along > std::max(reach, spacing) || norm(aside) > std::max(spacing, along / 2)) continue;
    ++result.nodes;
    result.sum = plus(result.sum, n);
    const double distance = distanceOf(way, n, m, std::isfinite(own.spacing) ? own.spacing : 0.0);
    if (distance < result.gap) {
      result.gap = distance;
      result.normal = n;
      result.place = own.position;
    }
  }
  return result;
}

double diagonal(const std::pair<Point, Point>& box) { return norm(minus(box.second, box.first)); }

/// Sides on the boundary of the bodies that belong to no group, by body.
std::map<int, std::vector<Side>> unnamedSides(const Mesh& mesh, const std::vector<Group>& groups) {
  std::set<Key> named;
  for (const Group& group : groups)
    for (const Side& side : group.all) named.insert(keyOf(side));
  const SideTable table(mesh, std::vector<char>(mesh.nodes(), 1));
  std::map<int, std::vector<Side>> result;
  for (int e = 0; e < mesh.elements(); ++e)
    forEachSide(mesh, e, [&](const SideKey&, const Side& side) {
      if (!named.count(keyOf(side)) && table.onBoundary(side)) result[mesh.bodyOfElement[e]].push_back(side);
    });
  return result;
}

bool within(const Group& small, const Group& large) {
  if (small.all.size() > large.all.size() || small.bodies != large.bodies) return false;
  std::set<Key> keys;
  for (const Side& side : large.all) keys.insert(keyOf(side));
  return std::all_of(small.all.begin(), small.all.end(), [&](const Side& side) { return keys.count(keyOf(side)) > 0; });
}
bool strictlyWithin(const Group& small, const Group& large) { return small.all.size() < large.all.size() && within(small, large); }

/// True if another group with a shorter name has the same sides; the shorter name counts, as for bodies.
bool isAnotherName(const Group& group, const std::vector<Group>& groups) {
  const auto rank = [](const Group& one) { return std::make_pair(one.name.size(), one.name); };
  return std::any_of(groups.begin(), groups.end(), [&](const Group& other) {
    return other.all.size() == group.all.size() && rank(other) < rank(group) && within(group, other);
  });
}

/// Runs the checks of suture_solve.
void check(const Mesh& mesh, std::vector<Contact>& proposed) {
  std::vector<suture::Contact> contacts;
  for (const Contact& contact : proposed) {
    suture::Contact one;
    one.path = nameOf(contact);
    one.groupsA = contact.sideA;
    one.groupsB = contact.sideB;
    contacts.push_back(one);
  }
  Problems problems;
  contactsOn(mesh, contacts, problems);
  for (const Problem& problem : problems.list())
    for (Contact& contact : proposed)
      if ((problem.path + "/").rfind(nameOf(contact) + "/", 0) == 0) contact.problems.push_back(problem.message);
}

/// A contact under construction, extended side by side.
struct Growing {
  Contact contact;
  int body;      // body of Side A
  Facing whole;  // nodes of Side A that face Side B

  bool faces(const std::string& group) const { return std::find(contact.sideB.begin(), contact.sideB.end(), group) != contact.sideB.end(); }
  void add(const std::string& group, const Facing& facing, double gap) {
    if (!faces(group)) contact.sideB.push_back(group);
    if (gap < contact.gap) {
      contact.gap = gap;
      contact.normal = facing.normal;
    }
    whole.nodes += facing.nodes;
    whole.sum = plus(whole.sum, facing.sum);
  }
};

}  // namespace

std::string nameOf(const Contact& contact) {
  const auto first = [](const std::vector<std::string>& side) { return side[0] + (side.size() > 1 ? " and others" : ""); };
  return first(contact.sideA) + " on " + first(contact.sideB);
}

std::vector<Group> groupsOf(const Mesh& mesh) {
  std::vector<Group> result;
  for (const auto& [name, sides] : mesh.sideGroups) {
    if (sides.empty()) continue;
    Group group;
    group.name = name;
    group.sides = static_cast<int>(sides.size());
    group.all = sides;
    BoundingBox box;
    for (const Side& side : sides) group.bodies.insert(mesh.bodyOfElement[side.element]);
    if (group.bodies.size() == 1) group.body = *group.bodies.begin();
    const Surface surface(mesh, sides);
    for (const auto& [node, own] : surface.nodes()) {
      group.nodes.insert(node);
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
  const auto reach = [&](int a, int b) { return kReach * std::min(diagonal(boxes[a]), diagonal(boxes[b])); };
  std::vector<std::unique_ptr<Face>> faces;
  for (const Group& group : groups)
    faces.push_back(group.body >= 0 && !isAnotherName(group, groups) ? std::make_unique<Face>(mesh, group.all) : nullptr);

  std::map<std::pair<int, int>, Facing> found;  // in both directions
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
  // A group inside another one is more specific.
  for (auto pair = found.begin(); pair != found.end();) {
    const auto [i, j] = pair->first;
    const bool coarse = std::any_of(found.begin(), found.end(), [&, i = i, j = j](const auto& other) {
      const auto [k, l] = other.first;
      return (l == j && k != i && strictlyWithin(groups[k], groups[i])) || (k == i && l != j && strictlyWithin(groups[l], groups[j]));
    });
    pair = coarse ? found.erase(pair) : std::next(pair);
  }

  std::vector<Growing> growing;
  std::set<std::pair<int, int>> open;
  for (const auto& [pair, facing] : found)
    if (found.count({pair.second, pair.first})) open.insert(pair);
  while (!open.empty()) {
    std::map<int, int> partners;
    for (const auto& [i, j] : open) ++partners[i];
    int widest = open.begin()->first;
    for (const auto& [i, count] : partners)
      if (count > partners[widest]) widest = i;
    // A side belongs to one contact only: another group of the same body that faces the same sides joins its contact.
    auto one = std::find_if(growing.begin(), growing.end(), [&, widest = widest](const Growing& other) {
      return other.body == groups[widest].body && std::any_of(open.begin(), open.end(), [&](const std::pair<int, int>& pair) {
               return pair.first == widest && other.faces(groups[pair.second].name);
             });
    });
    if (one == growing.end()) {
      one = growing.insert(growing.end(), {Contact(), groups[widest].body, Facing()});
      one->contact.gap = std::numeric_limits<double>::infinity();
    }
    one->contact.sideA.push_back(groups[widest].name);
    for (const auto& [pair, facing] : found) {
      if (pair.first != widest || !open.count(pair)) continue;
      const double rounding = 1e-12 * reach(groups[widest].body, groups[pair.second].body) / kReach;
      one->add(groups[pair.second].name, facing, std::abs(facing.gap) > rounding ? facing.gap : 0.0);
      open.erase(pair);
      open.erase({pair.second, pair.first});
    }
  }
  Contacts result;
  for (Growing& one : growing) {
    if (norm(one.whole.sum) > kSense * one.whole.nodes) one.contact.normal = unit(one.whole.sum);
    result.all.push_back(std::move(one.contact));
  }

  check(mesh, result.all);
  for (std::size_t a = 0; a < boxes.size(); ++a)
    for (std::size_t b = a + 1; b < boxes.size(); ++b)
      result.reach = std::max(result.reach, reach(static_cast<int>(a), static_cast<int>(b)));

  // Once per pair of bodies. Sides beyond the ends of a proposed contact also face each other, but are no part of it.
  std::set<std::pair<int, int>> told;
  for (const auto& [pair, facing] : found) told.insert(std::minmax(groups[pair.first].body, groups[pair.second].body));
  struct Unusable {
    int body;
    Face face;
    std::string why;
  };
  std::vector<Unusable> unusable;
  for (const auto& [body, sides] : unnamedSides(mesh, groups))
    unusable.push_back({body, Face(mesh, sides), "in no " + mesh.sideGroupKind() + ": name them if they may touch"});
  for (const Group& group : groups) {
    std::map<int, std::vector<Side>> parts;
    for (const Side& side : group.all) parts[mesh.bodyOfElement[side.element]].push_back(side);
    if (parts.size() < 2) continue;
    for (const auto& [body, sides] : parts)
      unusable.push_back({body, Face(mesh, sides),
                          "in the " + mesh.sideGroupKind() + " '" + group.name +
                              "', which is on several bodies: each side of a contact needs its own group"});
  }
  const auto tell = [&](const Unusable& one, int other, const Face& face) {
    if (one.body == other) return;
    const Facing there = facing(one.face, face, reach(one.body, other));
    if (there.nodes < kFewest || !told.insert(std::minmax(one.body, other)).second) return;
    result.notes.push_back("'" + mesh.bodies[one.body] + "' and '" + mesh.bodies[other] + "' face each other near " +
                           placeText(there.place, mesh.dimension) + " with sides " + one.why);
  };
  for (const Unusable& one : unusable) {
    for (std::size_t j = 0; j < groups.size(); ++j)
      if (faces[j]) tell(one, groups[j].body, *faces[j]);
    for (const Unusable& other : unusable)
      if (other.body > one.body) tell(one, other.body, other.face);
  }
  return result;
}

}  // namespace suture::proposal
