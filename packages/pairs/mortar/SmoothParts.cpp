#include <suture/base/Point.hpp>
#include <suture/pairs/mortar/SmoothParts.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

namespace suture {

namespace {

constexpr double kCoplanar = 1e-6;                                 // angle up to which two sides are coplanar
constexpr double kCreaseAngle = 5 * 3.14159265358979323846 / 180;  // least angle of a crease
constexpr double kCreaseRatio = 3.0;                               // least ratio of the angle of a crease to other angles nearby

class Division {
 public:
  Division(const Surface& surface, const std::vector<int>& groupOf) : surface_(surface), groupOf_(groupOf) {
    for (int side = 0; side < surface.sides(); ++side) {
      std::vector<Point> p;
      for (const int node : surface.nodesOf(side)) p.push_back(surface.at(node).drawn), sidesAt_[node].push_back(side);
      const bool isTriangle = p.size() == 3;
      const Point area = cross(minus(p[isTriangle ? 1 : 2], p[0]), minus(p[isTriangle ? 2 : 3], p[isTriangle ? 0 : 1]));
      normals_.push_back(unit(area));
      planar_.push_back(isTriangle || std::abs(dot(minus(p[1], p[0]), normals_[side])) <= kCoplanar * norm(minus(p[1], p[0])));
    }
  }

  SmoothParts find() {
    const std::vector<int> plane = flood([this](int a, int b) { return areCoplanar(a, b); });
    // A region counts as a plane if it continues around a node or is the whole surface.
    std::vector<char> goesOn(plane.size(), 0), ends(plane.size(), 0);
    std::set<int> rim;
    for (int side = 0; side < surface_.sides(); ++side)
      for (int facet = 0; facet < surface_.facets(side); ++facet) {
        const int other = surface_.across(side, facet).side;
        if (other >= 0 && plane[other] != plane[side] && group(other) == group(side)) ends[plane[side]] = 1;
        if (other >= 0 && group(other) == group(side)) continue;
        const std::vector<int>& nodes = surface_.nodesOf(side);
        rim.insert({nodes[facet], nodes[(facet + 1) % surface_.facets(side)]});
      }
    for (const auto& [node, sides] : sidesAt_) {
      const int first = plane[sides.front()];
      if (!rim.count(node) && std::all_of(sides.begin(), sides.end(), [&](int side) { return plane[side] == first; })) goesOn[first] = 1;
    }
    const auto isFlat = [&](int side) { return planar_[side] && (goesOn[plane[side]] || !ends[plane[side]]); };
    SmoothParts parts;
    parts.partOf = flood([&](int a, int b) {
      if (plane[a] == plane[b]) return group(a) == group(b);
      return group(a) == group(b) && !isFlat(a) && !isFlat(b) && !isCrease(a, b);
    });
    for (int side = 0; side < surface_.sides(); ++side) parts.isFlat.push_back(isFlat(side));
    return parts;
  }

 private:
  int group(int side) const { return groupOf_.empty() ? 0 : groupOf_[side]; }
  double angle(int a, int b) const { return angleBetween(normals_[a], normals_[b]); }
  bool areCoplanar(int a, int b) const { return planar_[a] && planar_[b] && group(a) == group(b) && angle(a, b) <= kCoplanar; }

  /// Compares the angle at the edge of two sides with those at nearby edges that do not touch it.
  bool isCrease(int a, int b) const {
    const double own = angle(a, b);
    if (own <= kCreaseAngle) return false;
    std::set<int> common, near;
    const std::vector<int>& others = surface_.nodesOf(b);
    for (const int node : surface_.nodesOf(a))
      if (std::count(others.begin(), others.end(), node)) common.insert(node);
    for (const int side : {a, b})
      for (const int node : surface_.nodesOf(side)) near.insert(sidesAt_.at(node).begin(), sidesAt_.at(node).end());
    double most = 0;
    bool found = false;
    for (const int side : near)
      for (int facet = 0; facet < surface_.facets(side); ++facet) {
        const std::vector<int>& nodes = surface_.nodesOf(side);
        const int other = surface_.across(side, facet).side;
        if (other < 0 || common.count(nodes[facet]) || common.count(nodes[(facet + 1) % surface_.facets(side)])) continue;
        most = std::max(most, angle(side, other));
        found = true;
      }
    return found && own > kCreaseRatio * most;
  }

  /// Numbers the connected regions of sides that satisfy `together`.
  std::vector<int> flood(const std::function<bool(int, int)>& together) const {
    std::vector<int> number(surface_.sides(), -1);
    int count = 0;
    for (int seed = 0; seed < surface_.sides(); ++seed) {
      if (number[seed] >= 0) continue;
      std::vector<int> open{seed};
      number[seed] = count;
      while (!open.empty()) {
        const int side = open.back();
        open.pop_back();
        for (int facet = 0; facet < surface_.facets(side); ++facet) {
          const int other = surface_.across(side, facet).side;
          if (other < 0 || number[other] >= 0 || !together(side, other)) continue;
          number[other] = count;
          open.push_back(other);
        }
      }
      ++count;
    }
    return number;
  }

  const Surface& surface_;
  const std::vector<int>& groupOf_;
  std::vector<Point> normals_;
  std::vector<char> planar_;
  std::map<int, std::vector<int>> sidesAt_;  // by node
};

}  // namespace

SmoothParts smoothParts(const Surface& surface, const std::vector<int>& groupOf) { return Division(surface, groupOf).find(); }

}  // namespace suture
