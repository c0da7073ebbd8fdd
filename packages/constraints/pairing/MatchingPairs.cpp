#include <suture/constraints/pairing/MatchingPairs.hpp>
#include <suture/mesh/CellGeometry.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

namespace suture {

namespace {

using Chain = BoundaryLine::Chain;

const double pi = 3.14159265358979323846;
const double parallel = 1e-9;    // angle between the normals of sides that are straight
const double coincident = 1e-9;  // relative to the mesh size: nodes nearer than this have no direction between them

// Relative position of two nodes, one of each side.
struct Standing {
  Point normal{0, 0, 0};
  double gap = 0;
  double excess = 0;  ///< tangential distance beyond that by the curvature of the sides [length]
  bool facing = false;
};

/// One side of the line: its chains, and how much the normals turn near each node.
class SideOfLine {
 public:
  SideOfLine(const Mesh& mesh, const std::string& group) : line_(mesh, mesh.sideGroups.at(group)) {
    for (const Chain& chain : line_.chains()) {
      const int n = static_cast<int>(chain.nodes.size());
      for (int i = 0; i < n; ++i) {
        std::vector<Point>& normals = nearby_[chain.nodes[i]];
        for (int step = -2; step <= 2; ++step) {
          int j = i + step;
          if (chain.closed) j = (j % n + n) % n;
          if (j < 0 || j >= n) continue;
          const std::vector<Point>& more = line_.at(chain.nodes[j]).sideNormals;
          normals.insert(normals.end(), more.begin(), more.end());
        }
      }
    }
  }
  const BoundaryLine& line() const { return line_; }
  const std::vector<Point>& normalsNear(int node) const { return nearby_.at(node); }

 private:
  BoundaryLine line_;
  std::map<int, std::vector<Point>> nearby_;
};

class Matcher {
 public:
  Matcher(const Mesh& mesh, const ContactLine& line, Problems* problems)
      : mesh_(mesh), line_(line), problems_(problems), a_(mesh, line.groupA), b_(mesh, line.groupB) {}

  std::optional<PairedLine> match() {
    if (!sameOrder()) return std::nullopt;
    PairedLine result;
    std::vector<const Chain*> free;
    for (const Chain& chain : b_.line().chains()) free.push_back(&chain);
    bool sound = a_.line().chains().size() == free.size();
    for (const Chain& chainA : a_.line().chains()) {
      if (!sound) break;
      const auto partners = bestPartners(chainA, free);
      sound = partners.has_value();
      if (sound) append(chainA, *partners, result);
    }
    if (sound)
      sound = verify(result.pairs);
    else if (problems_)
      reportCounts();
    if (!sound) return std::nullopt;
    return result;
  }

 private:
  // Nodes of sides of two and of three nodes may coincide, but their forces do not belong to each other.
  bool sameOrder() const {
    const auto nodes = [&](const std::string& group) { return mesh_.nodesOf(mesh_.sideGroups.at(group).front()).size(); };
    const bool same = nodes(line_.groupA) == nodes(line_.groupB);
    if (!same && problems_)
      problems_->add(line_.path, "'" + line_.groupA + "' and '" + line_.groupB + "' have sides of " + std::to_string(nodes(line_.groupA)) +
                                     " and " + std::to_string(nodes(line_.groupB)) +
                                     " nodes, which match nowhere; choose Coupling = Mortar");
    return same;
  }

  Standing standing(int nodeA, int nodeB) const {
    Standing s;
    const Point nA = a_.line().normal(nodeA), nB = b_.line().normal(nodeB);
    const Point sum = minus(nA, nB);
    s.facing = angleBetween(nA, {-nB[0], -nB[1], 0}) < pi / 3;
    if (!s.facing) return s;
    s.normal = unit(sum);
    const Point d = minus(mesh_.point(nodeB), mesh_.point(nodeA));
    s.gap = dot(d, s.normal);
    double theta = 0;
    for (const Point& n : a_.normalsNear(nodeA)) theta = std::max(theta, angleBetween(n, s.normal));
    for (const Point& n : b_.normalsNear(nodeB)) theta = std::max(theta, angleBetween({-n[0], -n[1], 0}, s.normal));
    s.excess = std::max(0.0, norm(cross(d, s.normal)) - std::abs(s.gap) * std::tan(std::min(theta, pi / 3)));
    // Between curved sides the nodes may stand opposite along any direction between the normals. Forces along it have no moment.
    if (theta > parallel && s.excess == 0 && norm(d) > coincident * meshSize(nodeA, nodeB)) {
      s.normal = unit(s.gap > 0 ? d : Point{-d[0], -d[1], 0});
      s.gap = dot(d, s.normal);
    }
    return s;
  }

  double meshSize(int nodeA, int nodeB) const { return std::min(a_.line().at(nodeA).spacing, b_.line().at(nodeB).spacing); }

  // Sum of squared distances of facing nodes; what chooses between chains and between starts on a ring.
  double distance(const std::vector<int>& nodesA, const std::vector<int>& nodesB) const {
    double sum = 0;
    for (std::size_t i = 0; i < nodesA.size(); ++i) {
      const Point d = minus(mesh_.point(nodesB[i]), mesh_.point(nodesA[i]));
      sum += dot(d, d);
    }
    return sum;
  }

  // Nodes of B in the order of A's, from the nearest chain of the same kind, which is taken out of `free`.
  std::optional<std::vector<int>> bestPartners(const Chain& chainA, std::vector<const Chain*>& free) const {
    std::optional<std::vector<int>> best;
    std::size_t taken = 0;
    for (std::size_t c = 0; c < free.size(); ++c) {
      if (free[c]->closed != chainA.closed || free[c]->nodes.size() != chainA.nodes.size()) continue;
      const std::vector<int> candidate = facingOrder(chainA, *free[c]);
      if (best && distance(chainA.nodes, candidate) >= distance(chainA.nodes, *best)) continue;
      best = candidate;
      taken = c;
    }
    if (best) free.erase(free.begin() + static_cast<std::ptrdiff_t>(taken));
    return best;
  }

  // Both bodies lie on the left of their chains, so facing chains run against each other. A ring may begin anywhere: its first node is
  // looked for around the one nearest to A's.
  std::vector<int> facingOrder(const Chain& chainA, const Chain& chainB) const {
    std::vector<int> nodes(chainB.nodes.rbegin(), chainB.nodes.rend());
    if (!chainB.closed) return nodes;
    const int n = static_cast<int>(nodes.size());
    const Point first = mesh_.point(chainA.nodes[0]);
    const auto away = [&](int node) { return norm(minus(mesh_.point(node), first)); };
    const int nearest =
        static_cast<int>(std::min_element(nodes.begin(), nodes.end(), [&](int x, int y) { return away(x) < away(y); }) - nodes.begin());
    std::vector<int> best;
    for (int shift = -3; shift <= 3; ++shift) {
      std::vector<int> turned = nodes;
      std::rotate(turned.begin(), turned.begin() + ((nearest + shift) % n + n) % n, turned.end());
      if (best.empty() || distance(chainA.nodes, turned) < distance(chainA.nodes, best)) best = turned;
    }
    return best;
  }

  void append(const Chain& chainA, const std::vector<int>& partners, PairedLine& result) const {
    result.chains.push_back({static_cast<int>(result.pairs.size()), static_cast<int>(partners.size()), chainA.closed});
    for (std::size_t i = 0; i < partners.size(); ++i) {
      const Standing s = standing(chainA.nodes[i], partners[i]);
      ContactPair pair;
      pair.id = static_cast<int>(result.pairs.size());
      pair.line = line_.number;
      pair.ends = matchingEnds(chainA.nodes[i], partners[i]);
      pair.normal = s.normal;
      pair.gap = line_.initialGap ? line_.initialGap->at(mesh_.point(pair.node())) : s.gap;
      pair.length = a_.line().at(pair.node()).tributary;
      pair.arc = chainA.arc[i];
      pair.position = mesh_.point(pair.node());
      result.pairs.push_back(pair);
    }
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
      if (relative <= line_.tolerance) continue;
      ++apart;
      if (relative > worst) worst = relative, where = &pair;
    }
    if (averted > 0 && problems_)
      problems_->add(line_.path, "the sides '" + line_.groupA + "' and '" + line_.groupB + "' do not face each other: at " +
                                     std::to_string(averted) + " of " + std::to_string(pairs.size()) +
                                     " nodes their normals differ by more than 60 degrees (the first at " +
                                     placeText(whereAverted->position) + "). Do the bodies lie on opposite sides of the line?");
    if (apart > 0 && problems_) reportMismatch(apart, apart, worst, where->node(), where->position);
    return apart == 0 && averted == 0;
  }

  struct Lonely {
    int count = 0;
    double worst = 0;  ///< relative to the mesh size
    int node = -1;
  };

  // Nodes of one side that no node of the other stands opposite to.
  Lonely lonely(const SideOfLine& own, const SideOfLine& other, bool ownIsA) const {
    Lonely result;
    for (const auto& entry : own.line().nodes()) {
      double least = std::numeric_limits<double>::infinity();
      for (const auto& candidate : other.line().nodes()) {
        const int nodeA = ownIsA ? entry.first : candidate.first, nodeB = ownIsA ? candidate.first : entry.first;
        const Standing s = standing(nodeA, nodeB);
        // Normals that differ too much to project: the whole way counts.
        const double away = s.facing ? s.excess : norm(minus(mesh_.point(nodeA), mesh_.point(nodeB)));
        least = std::min(least, away / entry.second.spacing);
      }
      if (least <= line_.tolerance) continue;
      ++result.count;
      if (least > result.worst) result.worst = least, result.node = entry.first;
    }
    return result;
  }

  void reportCounts() {
    const Lonely a = lonely(a_, b_, true), b = lonely(b_, a_, false);
    const Lonely& worse = a.worst >= b.worst ? a : b;
    reportMismatch(a.count, b.count, worse.worst, worse.node, worse.node >= 0 ? mesh_.point(worse.node) : Point{0, 0, 0});
  }

  static std::string sizes(const std::string& group, const BoundaryLine& line) {
    const std::size_t chains = line.chains().size();
    return "'" + group + "' has " + std::to_string(line.nodes().size()) + " nodes" +
           (chains > 1 ? " in " + std::to_string(chains) + " connected parts" : "");
  }

  void reportMismatch(int lonelyA, int lonelyB, double worst, int node, const Point& place) {
    std::string text = "the sides do not match: " + sizes(line_.groupA, a_.line()) + ", " + sizes(line_.groupB, b_.line()) + "; " +
                       std::to_string(lonelyA) + " and " + std::to_string(lonelyB) + " of them have no partner opposite";
    if (node >= 0) {
      const auto& own = a_.line().nodes().count(node) ? a_.line() : b_.line();
      char far[120];
      std::snprintf(far, sizeof far, ", %.3g away along the line = %.3g of the mesh size there (Tolerance %.3g)",
                    worst * own.at(node).spacing, worst, line_.tolerance);
      text += "; the worst at " + placeText(place) + far;
    }
    problems_->add(line_.path, text + ". Mesh both sides with the same nodes, or choose Coupling = Mortar");
  }

  const Mesh& mesh_;
  const ContactLine& line_;
  Problems* problems_;
  SideOfLine a_, b_;
};

}  // namespace

std::optional<PairedLine> matchingLine(const Mesh& mesh, const ContactLine& line, Problems* problems) {
  return Matcher(mesh, line, problems).match();
}

}  // namespace suture
