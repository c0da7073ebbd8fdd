#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/SurfaceOrder.hpp>
#include <suture/pairs/FacingNodes.hpp>
#include <suture/pairs/MatchingPairs.hpp>
#include <suture/pairs/PairSearch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <optional>
#include <set>

namespace suture {

namespace {

const double pi = 3.14159265358979323846;
const double parallel = 1e-9;    // angle up to which the normals of sides count as equal: the sides are straight
const double coincident = 1e-9;  // relative to the mesh size: nodes closer than this define no direction

// Relative position of two nodes, one of each side.
struct Standing {
  Point normal{0, 0, 0};
  double gap = 0;
  double excess = 0;  ///< tangential distance beyond the allowance for curved sides [length]
  bool facing = false;
};

/// Normals of the sides within two steps of each node: how much the normals vary there.
class NormalsNear {
 public:
  explicit NormalsNear(const Surface& surface) {
    for (const auto& entry : surface.nodes())
      for (const int near : surface.nodesNear(entry.first)) {
        const std::vector<Point>& more = surface.at(near).sideNormals;
        std::vector<Point>& own = normals_[entry.first];
        own.insert(own.end(), more.begin(), more.end());
      }
  }
  const std::vector<Point>& at(int node) const { return normals_.at(node); }

 private:
  std::map<int, std::vector<Point>> normals_;
};

class Matcher {
 public:
  Matcher(const Mesh& mesh, const ContactSurface& contact, Problems* problems)
      : mesh_(mesh),
        contact_(contact),
        problems_(problems),
        a_(*contact.a.surface),
        b_(*contact.b.surface),
        nearA_(a_),
        nearB_(b_),
        facing_(a_, b_) {}

  std::optional<PairedSurface> match() {
    if (!sameOrder() || !nodesCarryPressure()) return std::nullopt;
    const std::optional<FacingNodes::Partners> partners = partnersOfAll();
    if (!partners) {
      if (problems_) reportCounts();
      return std::nullopt;
    }
    PairedSurface result;
    for (const OrderedNode& own : inOrder(a_, [](int) { return true; }))
      if (const int partner = partners->at(own.node); partner != own.node) append(own, partner, result);  // not at the tip of a crack
    if (!verify(result.pairs)) return std::nullopt;
    result.cells = cellsOf(a_, result.pairs);
    return result;
  }

 private:
  // Nodes of first- and second-order sides may coincide, but their forces do not correspond.
  bool sameOrder() const {
    const auto isLinear = [](const Surface& surface) { return int(surface.nodesOf(0).size()) == surface.facets(0); };
    const bool same = isLinear(a_) == isLinear(b_);
    if (!same && problems_)
      problems_->add(contact_.path, contact_.a.name() + " and " + contact_.b.name() + " have sides of " +
                                        std::to_string(a_.nodesOf(0).size()) + " and " + std::to_string(b_.nodesOf(0).size()) +
                                        " nodes and cannot match; choose Coupling = Mortar");
    return same;
  }

  bool nodesCarryPressure() const {
    const bool carry = contact_.a.nodesCarryPressure();
    if (!carry && problems_)
      problems_->add(contact_.path, "a pressure on " + contact_.a.name() +
                                        ", which has six- or eight-node sides, exerts no force or an opposite force at the vertices: no "
                                        "pair of nodes can carry it; choose Coupling = Mortar");
    return carry;
  }

  /// Partners of all nodes of A: each part is paired with the nearest unused part of B that has the same sides.
  std::optional<FacingNodes::Partners> partnersOfAll() const {
    if (facing_.partsOfA() != facing_.partsOfB()) return std::nullopt;
    std::vector<int> free(facing_.partsOfB());
    std::iota(free.begin(), free.end(), 0);
    FacingNodes::Partners all;
    for (int part = 0; part < facing_.partsOfA(); ++part) {
      std::optional<FacingNodes::Partners> best;
      std::size_t taken = 0;
      for (std::size_t k = 0; k < free.size(); ++k) {
        std::optional<FacingNodes::Partners> partners = facing_.between(part, free[k]);
        if (!partners || sameBody(*partners) || (best && facing_.distance(*partners) >= facing_.distance(*best))) continue;
        best = std::move(partners);
        taken = k;
      }
      if (!best) return std::nullopt;
      free.erase(free.begin() + static_cast<std::ptrdiff_t>(taken));
      all.merge(*best);
    }
    return all;
  }

  /// True if two parts cannot meet: they lie on the same body of several.
  bool sameBody(const FacingNodes::Partners& partners) const {
    const auto& [a, b] = *partners.begin();
    return !contact_.isWithinOneBody() && mesh_.bodyOfNode[a] == mesh_.bodyOfNode[b];
  }

  Standing standing(int nodeA, int nodeB) const {
    Standing s;
    const Point nA = a_.normal(nodeA), nB = b_.normal(nodeB);
    const Point sum = minus(nA, nB);
    s.facing = angleBetween(nA, scaled(-1.0, nB)) < pi / 3;
    if (!s.facing) return s;
    s.normal = unit(sum);
    const Point d = minus(b_.at(nodeB).position, a_.at(nodeA).position);
    s.gap = dot(d, s.normal);
    double theta = 0;
    for (const Point& n : nearA_.at(nodeA)) theta = std::max(theta, angleBetween(n, s.normal));
    for (const Point& n : nearB_.at(nodeB)) theta = std::max(theta, angleBetween(scaled(-1.0, n), s.normal));
    s.excess = std::max(0.0, norm(cross(d, s.normal)) - std::abs(s.gap) * std::tan(std::min(theta, pi / 3)));
    // Between curved sides the nodes may be opposite along any direction between the normals. Forces along d have no moment.
    if (theta > parallel && s.excess == 0 && norm(d) > coincident * meshSize(nodeA, nodeB)) {
      s.normal = unit(s.gap > 0 ? d : scaled(-1.0, d));
      s.gap = dot(d, s.normal);
    }
    return s;
  }

  double meshSize(int nodeA, int nodeB) const { return std::min(a_.at(nodeA).spacing, b_.at(nodeB).spacing); }

  void append(const OrderedNode& own, int partner, PairedSurface& result) const {
    const Standing s = standing(own.node, partner);
    ContactPair pair;
    pair.id = static_cast<int>(result.pairs.size());
    pair.line = contact_.number;
    pair.ends = matchingEnds(own.node, partner);
    pair.normal = s.normal;
    pair.position = a_.at(own.node).position;
    pair.gap = contact_.initialGap ? contact_.initialGap->at(pair.position) : s.gap;
    pair.length = a_.at(own.node).tributary;
    pair.arc = own.arc;
    result.pairs.push_back(pair);
  }

  bool verify(const std::vector<ContactPair>& pairs) {
    int apart = 0, averted = 0;
    double worst = 0;
    const ContactPair* where = nullptr;
    const ContactPair* whereAverted = nullptr;
    for (const ContactPair& pair : pairs) {
      const int nodeA = pair.ends[0].node, nodeB = pair.ends[1].node;
      const Standing s = standing(nodeA, nodeB);
      if (!s.facing) {
        if (averted++ == 0) whereAverted = &pair;
        continue;
      }
      const double relative = s.excess / meshSize(nodeA, nodeB);
      if (relative <= contact_.tolerance) continue;
      ++apart;
      if (relative > worst) worst = relative, where = &pair;
    }
    if (averted > 0 && problems_)
      problems_->add(contact_.path, "the sides " + contact_.a.name() + " and " + contact_.b.name() + " do not face each other: at " +
                                        std::to_string(averted) + " of " + std::to_string(pairs.size()) +
                                        " nodes their normals differ by more than 60 degrees (the first at " +
                                        placeText(whereAverted->position, mesh_.dimension) +
                                        "). Do the bodies lie on opposite sides of the " + line() + "?");
    if (apart > 0 && problems_) reportMismatch(apart, apart, worst, where->node(), where->position);
    return apart == 0 && averted == 0;
  }

  struct Lonely {
    int count = 0;
    double worst = 0;  ///< relative to the mesh size
    int node = -1;
  };

  /// Nodes of one face that have no opposite node on the other.
  Lonely lonely(const Surface& own, const Surface& other, bool ownIsA) const {
    std::vector<std::vector<Point>> sides(other.sides());
    std::vector<BoundingBox> places;
    std::vector<int> nodes;
    for (int side = 0; side < other.sides(); ++side)
      for (const int node : other.nodesOf(side)) sides[side].push_back(other.at(node).position);
    for (const auto& [node, data] : other.nodes()) {
      nodes.push_back(node);
      places.emplace_back();
      places.back().include(data.position);
    }
    const PairSearch search(sides);
    const BoxTree tree(places);
    Lonely result;
    for (const auto& [node, data] : own.nodes()) {
      const Point& from = data.position;
      std::set<int> candidates{nodes[tree.nearest(from, [&](int i) { return norm(minus(places[i].low, from)); })]};
      for (const int side : search.along({from}, own.normal(node)))
        candidates.insert(other.nodesOf(side).begin(), other.nodesOf(side).end());
      double least = std::numeric_limits<double>::infinity();
      for (const int candidate : candidates) {
        const Standing s = ownIsA ? standing(node, candidate) : standing(candidate, node);
        // Normals that differ too much for a projection: the full distance counts.
        const double away = s.facing ? s.excess : norm(minus(from, other.at(candidate).position));
        least = std::min(least, away / data.spacing);
      }
      if (least <= contact_.tolerance) continue;
      ++result.count;
      if (least > result.worst) result.worst = least, result.node = node;
    }
    return result;
  }

  void reportCounts() {
    const Lonely a = lonely(a_, b_, true), b = lonely(b_, a_, false);
    const Lonely& worse = a.worst >= b.worst ? a : b;
    reportMismatch(a.count, b.count, worse.worst, worse.node, worse.node >= 0 ? mesh_.point(worse.node) : Point{0, 0, 0});
  }

  std::string line() const { return mesh_.dimension == 2 ? "line" : "surface"; }

  static std::string sizes(const ContactFace& face, int parts) {
    return face.name() + " has " + std::to_string(face.surface->nodes().size()) + " nodes" +
           (parts > 1 ? " in " + std::to_string(parts) + " connected parts" : "");
  }

  void reportMismatch(int lonelyA, int lonelyB, double worst, int node, const Point& place) {
    std::string text = "the sides do not match: " + sizes(contact_.a, facing_.partsOfA()) + ", " + sizes(contact_.b, facing_.partsOfB()) +
                       "; " + std::to_string(lonelyA) + " and " + std::to_string(lonelyB) + " of them have no partner on the other side";
    if (node >= 0) {
      const Surface& own = a_.nodes().count(node) > 0 ? a_ : b_;
      char far[120];
      std::snprintf(far, sizeof far, ", shifted by %.3g along the %s = %.3g of the local mesh size (Tolerance %.3g)",
                    worst * own.at(node).spacing, line().c_str(), worst, contact_.tolerance);
      text += "; the worst at " + placeText(place, mesh_.dimension) + far;
    }
    problems_->add(contact_.path, text + ". Mesh both sides with the same nodes, or choose Coupling = Mortar");
  }

  const Mesh& mesh_;
  const ContactSurface& contact_;
  Problems* problems_;
  const Surface &a_, &b_;
  NormalsNear nearA_, nearB_;
  FacingNodes facing_;
};

}  // namespace

std::optional<PairedSurface> matchingPairs(const Mesh& mesh, const ContactSurface& contact, Problems* problems) {
  return Matcher(mesh, contact, problems).match();
}

}  // namespace suture
