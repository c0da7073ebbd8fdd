#include <suture/base/Point.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <queue>
#include <tuple>

#include "Proposal.hpp"

namespace suture::proposal {

namespace {

constexpr double kSoft = 1e-3;  // stiffness of an elastic support x extent of the geometry / Young modulus
constexpr double kPush = 1e-4;  // displacement beyond a gap / extent of the pushed body

/// Applies the rules of Supports step by step.
class Rule {
 public:
  Rule(const Mesh& mesh, const std::vector<Group>& groups, const Contacts& contacts, double youngModulus)
      : mesh_(mesh), groups_(groups), youngModulus_(youngModulus), boxes_(boxesOf(mesh)), up_(mesh.dimension - 1) {
    for (const std::pair<Point, Point>& box : boxes_)
      for (int k = 0; k < 3; ++k) {
        low_[k] = std::min(low_[k], box.first[k]);
        high_[k] = std::max(high_[k], box.second[k]);
      }
    for (const Contact& contact : contacts.all) {
      if (!contact.problems.empty()) continue;
      contacts_.push_back(contact);
      std::vector<const Group*> sides;
      for (const std::string& side : contact.sideA) sides.push_back(named(side));
      for (const std::string& side : contact.sideB) sides.push_back(named(side));
      sides_.push_back(sides);
    }
  }

  Supports propose() {
    if (const Group* held = chooseHeld()) {
      result_.held = held->name;
      result_.heldBody = mesh_.bodies[bodyOf(*held)];
      push(held, held->bodies);
      keepAllBut(held->bodies);
    } else {
      push(nullptr, {lowestOf(touching().empty() ? all() : touching())});
      keepAllBut({});
    }
    return result_;
  }

 private:
  const Group* named(const std::string& name) const {
    return &*std::find_if(groups_.begin(), groups_.end(), [&](const Group& group) { return group.name == name; });
  }
  double extent() const { return norm(minus(high_, low_)); }
  double extentOf(int body) const { return norm(minus(boxes_[body].second, boxes_[body].first)); }
  /// Drops the last digits, so that equal heights compare equal despite round-off.
  double rounded(double value) const { return std::round(value / (1e-9 * extent())); }
  double lowest(int body) const { return rounded(boxes_[body].first[up_]); }

  std::set<int> all() const {
    std::set<int> bodies;
    for (std::size_t b = 0; b < mesh_.bodies.size(); ++b) bodies.insert(static_cast<int>(b));
    return bodies;
  }
  /// Bodies in contact.
  std::set<int> touching() const {
    std::set<int> bodies;
    for (const auto& sides : sides_)
      for (const Group* side : sides) bodies.insert(side->body);
    return bodies;
  }
  int lowestOf(const std::set<int>& bodies) const {
    return *std::min_element(bodies.begin(), bodies.end(), [&](int a, int b) {
      return std::make_pair(lowest(a), mesh_.bodies[a]) < std::make_pair(lowest(b), mesh_.bodies[b]);
    });
  }
  int bodyOf(const Group& group) const { return lowestOf(group.bodies); }
  bool isSide(const Group& group) const {
    return std::any_of(sides_.begin(), sides_.end(), [&](const auto& sides) {
      return std::any_of(sides.begin(), sides.end(), [&](const Group* side) { return side == &group || within(group, *side); });
    });
  }
  static bool within(const Group& small, const Group& large) {
    return std::includes(large.nodes.begin(), large.nodes.end(), small.nodes.begin(), small.nodes.end());
  }
  static bool meet(const Group& a, const Group& b) {
    return std::any_of(a.nodes.begin(), a.nodes.end(), [&](int node) { return b.nodes.count(node) > 0; });
  }
  /// Indices of the contacts that contain nodes of a group.
  std::set<int> reached(const Group& group) const {
    std::set<int> result;
    for (std::size_t c = 0; c < sides_.size(); ++c)
      if (std::any_of(sides_[c].begin(), sides_[c].end(), [&](const Group* side) { return meet(group, *side); })) result.insert(int(c));
    return result;
  }

  /// True if a group contains nodes of both sides of a contact; where these overlap, their displacement cannot be prescribed.
  bool closes(const Group& group) const {
    return std::any_of(sides_.begin(), sides_.end(), [&](const auto& sides) {
      std::set<int> bodies;
      for (const Group* side : sides)
        if (meet(group, *side)) bodies.insert(side->body);
      return bodies.size() > 1;
    });
  }

  /// Chooses the group to hold. Prefers groups of one body over groups of several, then a body in contact, the lowest body, a side outside
  /// all contacts, the lowest side. Null if all groups are in contact.
  const Group* chooseHeld() const {
    using Rank = std::tuple<bool, bool, double, bool, double, std::string, std::string>;
    std::optional<Rank> least;
    const Group* best = nullptr;
    for (const Group& group : groups_) {
      if (isSide(group) || closes(group)) continue;
      const int body = bodyOf(group);
      const Rank rank{group.body < 0,
                      touching().count(body) == 0,
                      lowest(body),
                      !reached(group).empty(),
                      rounded(group.centre[up_]),
                      mesh_.bodies[body],
                      group.name};
      if (least && !(rank < *least)) continue;
      least = rank;
      best = &group;
    }
    return best;
  }

  /// Number of contacts between each body and `bodies`; unconnected bodies are left out.
  std::map<int, int> distancesFrom(const std::set<int>& bodies) const {
    std::map<int, int> steps;
    std::queue<int> next;
    for (const int body : bodies) {
      steps[body] = 0;
      next.push(body);
    }
    for (; !next.empty(); next.pop())
      for (const auto& sides : sides_) {
        if (std::none_of(sides.begin(), sides.end(), [&](const Group* side) { return side->body == next.front(); })) continue;
        for (const Group* side : sides)
          if (steps.try_emplace(side->body, steps[next.front()] + 1).second) next.push(side->body);
      }
    return steps;
  }

  /// Direction and distance from a body to the nearest body that is closer to the held one.
  std::pair<Point, double> wayFrom(int body, const std::map<int, int>& steps) const {
    std::pair<Point, double> result{{0, 0, 0}, 0.0};
    double least = 1e300;
    for (std::size_t c = 0; c < sides_.size(); ++c) {
      const bool first = sides_[c][0]->body == body;
      bool mine = first, closer = false;
      for (const Group* side : sides_[c]) {
        mine = mine || side->body == body;
        closer = closer || steps.at(side->body) < steps.at(body);
      }
      if (!mine || !closer || contacts_[c].gap >= least) continue;
      least = contacts_[c].gap;
      result = {first ? contacts_[c].normal : scaled(-1.0, contacts_[c].normal), std::max(least, 0.0)};
    }
    return result;
  }

  /// The rearmost group of a body in the direction `way`, among those that satisfy `fits`.
  template <class Fits>
  const Group* farthestBack(int body, const Point& way, const Fits& fits) const {
    const Group* best = nullptr;
    for (const Group& group : groups_)
      if (group.body == body && fits(group) && (!best || rounded(dot(way, group.centre)) < rounded(dot(way, best->centre)))) best = &group;
    return best;
  }

  void push(const Group* held, const std::set<int>& towards) {
    const std::set<int> fixed = held ? reached(*held) : std::set<int>();
    const auto movable = [&](const Group& group) {
      if (isSide(group) || (held && meet(group, *held))) return false;
      const std::set<int> own = reached(group);
      return std::none_of(own.begin(), own.end(), [&](int contact) { return fixed.count(contact) > 0; });
    };
    // Farthest first, then the highest, then by name.
    const std::map<int, int> steps = distancesFrom(towards);
    std::vector<std::tuple<int, double, std::string, int>> order;
    for (const auto& [body, count] : steps)
      if (count > 0) order.emplace_back(-count, -rounded(boxes_[body].second[up_]), mesh_.bodies[body], body);
    std::sort(order.begin(), order.end());
    for (const bool byForce : {false, true})
      for (const auto& entry : order) {
        const int body = std::get<3>(entry);
        const auto [way, gap] = wayFrom(body, steps);
        const Group* group = farthestBack(body, way, [&](const Group& own) { return byForce || movable(own); });
        if (!group) continue;
        const double distance = gap + kPush * extentOf(body);
        set(*group, body, byForce ? scaled(stiffness() * lengthOf(body) * distance, way) : scaled(distance, way), byForce);
        return;
      }
    if (!order.empty() || !held) return;
    Point down{0, 0, 0};
    down[up_] = -1.0;
    const int body = bodyOf(*held);
    if (const Group* group = farthestBack(body, down, movable)) set(*group, body, scaled(kPush * extentOf(body), down), false);
  }

  void set(const Group& group, int body, const Point& push, bool byForce) {
    result_.pushed = group.name;
    result_.pushedBody = mesh_.bodies[body];
    result_.push = push;
    result_.byForce = byForce;
  }

  double stiffness() const { return kSoft * youngModulus_ / extent(); }
  /// Total size of the sides of a body, over groups of this body alone.
  double lengthOf(int body) const {
    double length = 0.0;
    for (const Group& group : groups_)
      if (group.body == body) length += group.size;
    return length;
  }

  void keepAllBut(const std::set<int>& held) {
    result_.stiffness = stiffness();
    std::set<std::string> soft;
    for (std::size_t b = 0; b < mesh_.bodies.size(); ++b) {
      const int body = static_cast<int>(b);
      const bool pushed = mesh_.bodies[b] == result_.pushedBody && !result_.byForce;
      if (held.count(body) || pushed) continue;
      std::vector<std::string> own, shared;
      for (const Group& group : groups_)
        if (group.bodies.count(body)) (group.body == body ? own : shared).push_back(group.name);
      const std::vector<std::string>& sides = own.empty() ? shared : own;
      soft.insert(sides.begin(), sides.end());
      (sides.empty() ? result_.loose : result_.softBodies).push_back(mesh_.bodies[b]);
    }
    result_.soft.assign(soft.begin(), soft.end());
    std::sort(result_.softBodies.begin(), result_.softBodies.end());
  }

  const Mesh& mesh_;
  const std::vector<Group>& groups_;
  const double youngModulus_;
  std::vector<Contact> contacts_;
  const std::vector<std::pair<Point, Point>> boxes_;
  const int up_;
  Point low_{1e300, 1e300, 1e300}, high_{-1e300, -1e300, -1e300};
  std::vector<std::vector<const Group*>> sides_;
  Supports result_;
};

}  // namespace

Supports proposeSupports(const Mesh& mesh, const std::vector<Group>& groups, const Contacts& contacts, double youngModulus) {
  return Rule(mesh, groups, contacts, youngModulus).propose();
}

}  // namespace suture::proposal
