#include <suture/answer/bound/ContactNodes.hpp>
#include <suture/base/Point.hpp>
#include <suture/pairs/PairFrame.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// Distances of opposite nodes relative to the size of a side, and differences of their forces relative to the largest force, that are
// round-off.
constexpr double kSamePlace = 1e-8;
// Round-off of the weights of pairs.
constexpr double kWeight = 1e-12;
// Differences of gaps of the pairs of a contact, and gaps that are round-off, relative to its size.
constexpr double kSameGap = 1e-10, kRoundOffOfGap = 1e-14;
// Sum of the weights of one side of a mortar pair, above round-off.
constexpr double kLeastWeight = 1e-3;

}  // namespace

TouchingPair touchingPair(const ContactRow& row) {
  TouchingPair own{row.pair.id, row.pair.line};
  own.normal = row.pair.normal;
  own.ends = row.pair.ends;
  own.separates = row.separates;
  own.restrictsSliding = row.restrictsSliding();
  own.isSimple = row.pair.ends.size() <= 2;
  for (const PairEnd& end : row.pair.ends) {
    (end.weight > 0 ? own.a : own.b) = end.node;
    own.isSimple = own.isSimple && std::abs(std::abs(end.weight) - 1) < kWeight;
  }
  own.isSimple = own.isSimple && own.a >= 0 && (row.pair.ends.size() == 1 || own.b >= 0);
  return own;
}

void ContactNodes::addPairs(const std::vector<Pair>& pairs) {
  for (const Pair& pair : pairs) {
    ContactNode node{pair.pair.a, pair.pair.b, {0, 0, 0}, pair.pair.normal, 0.0, pair.result.gap};
    node.slip = pair.result.stepSlip();
    node.shortening = pair.result.shortening;
    node.isClosed = pair.result.state.closed();
    node.slips = pair.result.state.status == PairStatus::Slip;
    if (node.isClosed) {
      node.force = pair.result.force;
      node.tangential = pair.tangential;
      node.bound = pair.bound;
      node.boundOfLaw = pair.result.bound;
    }
    add(node);
  }
}

std::string ContactNodes::addPlaces(const std::vector<Pair>& pairs, bool ignoresDistance) {
  std::map<GlobalId, const Point*> placeOfB, movedOfB;
  std::map<GlobalId, ContactNode> forces;
  for (const Pair& pair : pairs) {
    if (pair.pair.restrictsSliding && norm(pair.result.past.slip) > 0.0) return "it has slid in an earlier load step";
    for (const PairEnd& end : pair.pair.ends) {
      ContactNode& own = forces[end.node];
      if (!pair.result.state.closed()) continue;
      own.force += end.weight * pair.result.force;
      own.tangential = plus(own.tangential, scaled(end.weight, pair.tangential));
      own.bound += std::max(0.0, end.weight) * pair.bound;
      own.boundOfLaw += std::max(0.0, end.weight) * pair.result.bound;
      own.slips = own.slips || pair.result.state.status == PairStatus::Slip;
      own.isClosed = true;
    }
  }
  for (const TouchingSide* side : b_)
    for (int j = 0; j < sideNodes_; ++j) placeOfB[side->nodes[j]] = &side->places[j], movedOfB[side->nodes[j]] = &side->moved[j];
  if (a_.empty()) return "no side of it faces another";
  double widened = 0.0;
  if (!findWidening(pairs, widened)) return "its gap is not that between its sides, and varies";
  const Point normal = a_.front()->normal, along = pairFrame(normal, 3)[1];
  const auto isTilted = [](const Sides& sides, const Point& direction) {
    return std::any_of(sides.begin(), sides.end(),
                       [&](const TouchingSide* side) { return norm(minus(side->normal, direction)) > kSamePlace; });
  };
  if (isTilted(a_, normal) || isTilted(b_, scaled(-1.0, normal))) return "it is curved, or its sides are not parallel";
  std::vector<std::pair<double, GlobalId>> sorted;
  for (const auto& [node, place] : placeOfB) sorted.push_back({dot(*place, along), node});
  std::sort(sorted.begin(), sorted.end());
  double largest = 0.0;
  for (const auto& [node, value] : forces) largest = std::max({largest, std::abs(value.force), norm(value.tangential)});
  for (const TouchingSide* side : a_)
    for (int j = 0; j < sideNodes_; ++j) {
      if (indexOf_.count(side->nodes[j])) continue;
      const double near = kSamePlace * std::sqrt(side->size), at = dot(side->places[j], along);
      auto candidate = std::lower_bound(sorted.begin(), sorted.end(), std::make_pair(at - near, GlobalId(-1)));
      ContactNode node = forces[side->nodes[j]];
      node.a = side->nodes[j];
      node.place = side->places[j];
      node.normal = normal;
      for (; candidate != sorted.end() && candidate->first <= at + near; ++candidate) {
        const Point apart = minus(*placeOfB.at(candidate->second), side->places[j]);
        if (norm(minus(apart, scaled(dot(apart, normal), normal))) > near) continue;
        node.b = candidate->second;
        const Point jump = minus(side->moved[j], *movedOfB.at(node.b));
        const double drawn = givenGaps_.empty() ? dot(apart, normal) : givenGaps_.at(node.a);
        node.gap = (ignoresDistance ? 0.0 : widened + drawn) - dot(jump, normal);
        node.slip = minus(jump, scaled(dot(jump, normal), normal));
      }
      if (node.b < 0) continue;  // faces nothing
      const ContactNode& opposite = forces[node.b];
      if (std::max(std::abs(node.force + opposite.force), norm(plus(node.tangential, opposite.tangential))) > kSamePlace * largest)
        return "its sides do not match";
      add(node);
    }
  return "";
}

bool ContactNodes::findWidening(const std::vector<Pair>& pairs, double& widened) const {
  std::map<GlobalId, Point> placeOfA, placeOfB;
  double size = 0.0;
  for (const auto* sides : {&a_, &b_})
    for (const TouchingSide* side : *sides)
      for (int j = 0; j < sideNodes_; ++j) {
        (sides == &a_ ? placeOfA : placeOfB)[side->nodes[j]] = side->places[j];
        size = std::max(size, norm(minus(side->places[j], a_.front()->places[0])));
      }
  bool isFirst = true;
  for (const Pair& pair : pairs) {
    double between = 0.0, weightOfA = 0.0;
    bool isKnown = true;
    for (const PairEnd& end : pair.pair.ends) {
      const auto onA = placeOfA.find(end.node), onB = placeOfB.find(end.node);
      isKnown = isKnown && (onA == placeOfA.end()) != (onB == placeOfB.end());
      if (!isKnown) break;
      if (onA != placeOfA.end()) weightOfA += end.weight;
      if (givenGaps_.empty())
        between -= end.weight * dot(pair.pair.normal, onA != placeOfA.end() ? onA->second : onB->second);
      else if (onA != placeOfA.end())
        between += end.weight * givenGaps_.at(end.node);
    }
    if (!isKnown || std::abs(weightOfA) < kLeastWeight) continue;
    const double own = (pair.result.initialGap - between) / weightOfA;
    if (!isFirst && std::abs(own - widened) > kSameGap * size) return false;
    if (isFirst) widened = own;
    isFirst = false;
  }
  if (std::abs(widened) < kRoundOffOfGap * size) widened = 0.0;
  return true;
}

int ContactNodes::indexOf(GlobalId a) const {
  const auto found = indexOf_.find(a);
  return found == indexOf_.end() ? -1 : found->second;
}

void ContactNodes::add(const ContactNode& node) {
  indexOf_[node.a] = int(nodes_.size());
  nodes_.push_back(node);
}

}  // namespace suture
