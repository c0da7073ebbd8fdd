#include <suture/base/Point.hpp>
#include <suture/pairs/FacingNodes.hpp>

#include <algorithm>
#include <tuple>

namespace suture {

namespace {

constexpr std::size_t kStarts = 7;  // number of first placements of one part on another that are tried

std::vector<std::vector<int>> sidesOfParts(const Surface& surface) {
  std::vector<std::vector<int>> sides;
  const std::vector<int> part = surface.parts();
  for (int side = 0; side < surface.sides(); ++side) {
    if (part[side] >= static_cast<int>(sides.size())) sides.resize(part[side] + 1);
    sides[part[side]].push_back(side);
  }
  return sides;
}

/// Local number of the node of the other side that coincides with node i, for sides with this number of vertices.
int partner(int i, int turn, int vertices) {
  const auto wrapped = [vertices](int k) { return ((k % vertices) + vertices) % vertices; };
  if (i < vertices) return wrapped(turn - i);
  const bool isCentre = vertices == 2 || i == 2 * vertices;
  return isCentre ? i : vertices + wrapped(turn - (i - vertices) - 1);  // or the middle of an edge
}

}  // namespace

FacingNodes::FacingNodes(const Surface& a, const Surface& b) : a_(a), b_(b), partsA_(sidesOfParts(a)), partsB_(sidesOfParts(b)) {}

int FacingNodes::opposite(const Laid& laid, int facet) const {
  const int vertices = a_.facets(laid.a), behind = a_.dimension() == 2 ? 0 : 1;  // an edge begins where the opposite one ends
  return (((laid.turn - facet - behind) % vertices) + vertices) % vertices;
}

bool FacingNodes::sameRim(const Laid& laid) const {
  for (int facet = 0; facet < a_.facets(laid.a); ++facet)
    if ((a_.across(laid.a, facet).side < 0) != (b_.across(laid.b, opposite(laid, facet)).side < 0)) return false;
  return true;
}

double FacingNodes::distance(const Laid& laid) const {
  Partners partners;
  lay(laid, partners);
  return distance(partners);
}

double FacingNodes::distance(const Partners& partners) const {
  double sum = 0;
  for (const auto& [a, b] : partners) {
    const Point d = minus(b_.at(b).position, a_.at(a).position);
    sum += dot(d, d);
  }
  return sum;
}

/// Adds the nodes of two sides. False if one of them already has a different partner.
bool FacingNodes::lay(const Laid& laid, Partners& partners) const {
  const std::vector<int>&own = a_.nodesOf(laid.a), &other = b_.nodesOf(laid.b);
  const int nodes = static_cast<int>(own.size()), vertices = a_.facets(laid.a);
  for (int i = 0; i < nodes; ++i) {
    const int opposite = other[partner(i, laid.turn, vertices)];
    if (partners.emplace(own[i], opposite).first->second != opposite) return false;
  }
  return true;
}

/// First placements: the side of A with most edges on the rim, on the nearest sides of B with the same rim.
std::vector<FacingNodes::Laid> FacingNodes::starts(int partOfA, int partOfB) const {
  const auto rim = [this](int side) {
    int count = 0;
    for (int facet = 0; facet < a_.facets(side); ++facet) count += a_.across(side, facet).side < 0;
    return count;
  };
  int first = partsA_[partOfA].front();
  for (const int side : partsA_[partOfA])
    if (rim(side) > rim(first)) first = side;
  std::vector<std::tuple<double, int, int>> found;  // distance, side, turn
  for (const int side : partsB_[partOfB]) {
    if (b_.nodesOf(side).size() != a_.nodesOf(first).size()) continue;
    const int turns = a_.dimension() == 2 ? 1 : a_.facets(first);
    for (int k = 1; k <= turns; ++k) {
      const Laid laid{first, side, k % a_.facets(first)};
      if (sameRim(laid)) found.push_back({distance(laid), side, laid.turn});
    }
  }
  const std::size_t few = std::min(found.size(), kStarts);
  std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(few), found.end());
  std::vector<Laid> starts;
  for (std::size_t i = 0; i < few; ++i) starts.push_back({first, std::get<1>(found[i]), std::get<2>(found[i])});
  return starts;
}

/// Walks over both parts simultaneously, from side to neighbour.
std::optional<FacingNodes::Partners> FacingNodes::from(const Laid& start) const {
  Partners partners;
  std::map<int, std::pair<int, int>> seen{{start.a, {start.b, start.turn}}};
  std::vector<Laid> waiting{start};
  while (!waiting.empty()) {
    const Laid laid = waiting.back();
    waiting.pop_back();
    if (!sameRim(laid) || !lay(laid, partners)) return std::nullopt;
    for (int facet = 0; facet < a_.facets(laid.a); ++facet) {
      const Surface::Facet &own = a_.across(laid.a, facet), &other = b_.across(laid.b, opposite(laid, facet));
      if (own.side < 0) continue;
      if (a_.nodesOf(own.side).size() != b_.nodesOf(other.side).size()) return std::nullopt;
      const int vertices = a_.facets(own.side), behind = a_.dimension() == 2 ? 0 : 1;
      const Laid next{own.side, other.side, (own.facet + other.facet + behind) % vertices};
      const auto [at, isNew] = seen.emplace(next.a, std::make_pair(next.b, next.turn));
      if (!isNew && at->second != std::make_pair(next.b, next.turn)) return std::nullopt;
      if (isNew) waiting.push_back(next);
    }
  }
  return partners;
}

std::optional<FacingNodes::Partners> FacingNodes::between(int partOfA, int partOfB) const {
  if (partsA_[partOfA].size() != partsB_[partOfB].size()) return std::nullopt;
  std::optional<Partners> best;
  double least = 0;
  for (const Laid& start : starts(partOfA, partOfB)) {
    std::optional<Partners> partners = from(start);
    if (!partners) continue;
    const double sum = distance(*partners);
    if (best && sum >= least) continue;
    best = std::move(partners);
    least = sum;
  }
  return best;
}

}  // namespace suture
