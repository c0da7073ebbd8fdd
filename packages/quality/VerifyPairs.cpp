#include <suture/base/Point.hpp>
#include <suture/quality/VerifyPairs.hpp>

#include <algorithm>
#include <limits>
#include <map>

namespace suture {

namespace {

bool isPassive(const BodyScale& body) { return body.loads == 0.0 && body.prescribed == 0.0; }

}  // namespace

void lendForce(const std::vector<PairEndShare>& ends, std::vector<BodyScale>& bodies) {
  std::map<int, std::pair<int, int>> bodiesOf;  // lowest and highest of a pair
  for (const PairEndShare& end : ends) {
    auto& both = bodiesOf.try_emplace(end.pair, end.body, end.body).first->second;
    both.first = std::min(both.first, end.body);
    both.second = std::max(both.second, end.body);
  }
  const std::vector<BodyScale> own = bodies;
  const auto lend = [&](int from, int to) {
    if (!isPassive(own[to])) return;
    bodies[to].lent = std::max(bodies[to].lent, Bounds::passive * own[from].force);
    bodies[to].force = std::max(bodies[to].force, bodies[to].lent);
    bodies[to].largestContact = std::max(bodies[to].largestContact, Bounds::passive * own[from].largestContact);
  };
  for (const auto& [pair, both] : bodiesOf) {
    lend(both.first, both.second);
    lend(both.second, both.first);
  }
}

void verifyPairs(std::vector<PairEndShare> ends, const std::vector<PairResult>& pairs, const std::vector<BodyScale>& bodies, double bound,
                 Findings& findings) {
  const auto before = [](const PairEndShare& a, const PairEndShare& b) { return a.pair != b.pair ? a.pair < b.pair : a.end < b.end; };
  std::sort(ends.begin(), ends.end(), before);
  std::map<int, const PairResult*> said;
  for (const PairResult& pair : pairs) said[pair.id] = &pair;
  std::size_t found = 0;
  for (std::size_t first = 0, last = 0; first < ends.size(); first = last) {
    Finding where;
    where.pair = ends[first].pair;
    where.place = ends[first].place;
    where.body = where.other = ends[first].body;
    double gap = ends[first].gap, moved = std::abs(gap), lifted = 0.0, compliance = 0.0, rounding = 0.0,
           force = bodies[ends[first].body].force;
    double roundings = Bounds::rounding;
    bool unloaded = false;
    for (last = first; last < ends.size() && ends[last].pair == where.pair; ++last) {
      const PairEndShare& end = ends[last];
      gap -= end.closing;
      moved += end.moved;
      lifted += end.lifted;
      compliance += end.weight * end.weight / end.stiffness;
      rounding = std::max(rounding, end.rounding);
      force = std::min(force, bodies[end.body].force);
      roundings = std::max(roundings, bodies[end.body].roundings());
      unloaded = unloaded || bodies[end.body].isUnloaded();
      if (end.body != where.body) where.other = end.body;
    }
    const auto pair = said.find(where.pair);
    if (pair == said.end()) {
      findings.take(Quantity::Status, std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0, where);
      continue;
    }
    ++found;
    const double pressing = pair->second->force, asForce = gap / compliance;
    // Where no force is to compare with, two bodies are as far apart as digits of their ways and places tell.
    const double ways = unloaded ? Bounds::nothing * unitRoundoff * (lifted + norm(where.place)) / compliance : 0.0;
    const double slack = roundings * (rounding + unitRoundoff * moved / compliance) + ways, allowed = bound * force + slack;
    const bool open = !pair->second->state.closed();
    // Zero unless the sign is wrong; NaN stays NaN.
    findings.take(Quantity::Penetration, asForce > 0.0 ? 0.0 : -asForce, allowed, force, where);
    findings.take(Quantity::Tension, pressing > 0.0 ? 0.0 : -pressing, allowed, force, where);
    findings.take(Quantity::Complementarity, std::min(std::abs(pressing), std::abs(asForce)), allowed, force, where);
    findings.take(Quantity::Status, std::abs(open ? pressing : asForce), allowed, force, where);
  }
  if (found != pairs.size()) findings.take(Quantity::Status, std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0, Finding());
}

}  // namespace suture
