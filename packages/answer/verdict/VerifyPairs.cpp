#include <suture/answer/verdict/VerifyPairs.hpp>
#include <suture/base/Point.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace suture {

namespace {

/// Deviations of a pair from its friction law. [force]
struct SlidingErrors {
  double friction = 0.0, slip = 0.0, dissipation = 0.0;
};

/// \param slip  tangential jump divided by the compliance of the facing nodes [force]
SlidingErrors slidingErrors(const PairResult& pair, const PairEndShare& carrier, const Point& slip) {
  const Point& t = pair.tangential;
  const double size = length(t);
  SlidingErrors errors;
  errors.friction = size;  // without resistance the force must vanish
  if (!carrier.kind.restrictsSliding || !pair.state.closed()) return errors;
  const double bound = pair.state.largest(pair.force);
  if (pair.state.status == PairStatus::Slip) {
    // The force is the projection of itself plus the slip onto the disc of the bound (Alart and Curnier 1991), and lies on the rim. A slip
    // at round-off level has no direction, and no effect.
    const Point trial = plus(t, slip);
    const double reach = length(trial);
    errors.friction = std::max(length(minus(t, scaled(reach > bound ? bound / reach : 1.0, trial))), std::abs(size - bound));
  } else {
    errors.slip = length(slip);
    errors.friction = size - bound;
    if (!carrier.kind.separates || errors.friction < 0.0) errors.friction = 0.0 * size;  // glued sides have no bound; NaN stays NaN
  }
  errors.friction += std::abs(dot(t, carrier.normal));
  // The least change, of force or slip, after which the force does not act against the slip.
  const double against = -dot(t, slip);
  errors.dissipation = against > 0.0 ? std::min(size, against / size) : std::abs(0.0 * against);
  return errors;
}

}  // namespace

void scaleForces(const std::vector<PairEndShare>& ends, const std::vector<BodyForces>& now, const std::vector<BodyForces>& past,
                 std::vector<BodyScale>& bodies) {
  std::map<int, std::pair<int, int>> bodiesOf;  // lowest and highest body of a pair
  for (const PairEndShare& end : ends) {
    auto& both = bodiesOf.try_emplace(end.pair, end.body, end.body).first->second;
    both.first = std::min(both.first, end.body);
    both.second = std::max(both.second, end.body);
  }
  std::set<std::pair<int, int>> joined;
  for (const auto& [pair, both] : bodiesOf) joined.insert(both);
  const std::vector<std::pair<int, int>> neighbours(joined.begin(), joined.end());
  const std::vector<ForceScale> scales = ForceScale::of(now, past, neighbours);
  const std::vector<char> idle = idleBodies(now, past);
  std::vector<double> contact;
  for (const BodyScale& body : bodies) contact.push_back(body.largestContact);
  const std::vector<double> lent = lentValues(contact, idle, kLentForce, neighbours);
  std::map<int, double> compliance;
  for (const PairEndShare& end : ends) compliance[end.pair] += end.weight * end.weight / end.stiffness;
  for (const PairEndShare& end : ends)
    if (end.end == 0)
      for (const int b : {bodiesOf.at(end.pair).first, bodiesOf.at(end.pair).second})
        if (idle[b]) bodies[b].places += Bounds::places * unitRoundoff * norm(end.place) / compliance.at(end.pair);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    bodies[b].force = scales[b].force;
    bodies[b].lent = scales[b].lent;
    bodies[b].rounded = scales[b].rounded;
    bodies[b].largestContact = std::max(bodies[b].largestContact, lent[b]);
  }
}

void verifyPairs(std::vector<PairEndShare> ends, const std::vector<PairResult>& pairs, const std::vector<BodyScale>& bodies,
                 double tolerance, Findings& findings) {
  const double bound = Bounds::pair.at(tolerance);
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
           force = bodies[ends[first].body].force, rounded = 0.0;
    double roundings = Bounds::rounding;
    bool unloaded = false;
    Point shift{0, 0, 0};
    for (last = first; last < ends.size() && ends[last].pair == where.pair; ++last) {
      const PairEndShare& end = ends[last];
      gap -= end.closing;
      moved += end.moved;
      lifted += end.lifted;
      shift = plus(shift, end.shift);
      compliance += end.weight * end.weight / end.stiffness;
      rounding = std::max(rounding, end.rounding);
      force = std::min(force, bodies[end.body].force);
      roundings = std::max(roundings, bodies[end.body].roundings());
      unloaded = unloaded || bodies[end.body].isUnloaded();
      rounded = std::max(rounded, Bounds::pair.ofRounding(bodies[end.body]));
      if (end.body != where.body) where.other = end.body;
    }
    const auto pair = said.find(where.pair);
    if (pair == said.end()) {
      findings.take(Quantity::Status, std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0, where);
      continue;
    }
    ++found;
    const double pressing = pair->second->force, asForce = gap / compliance;
    // The gap has round-off of the positions, and of the rigid motions if there is no force to compare with.
    const double ways =
        (unloaded ? Bounds::nothing * (lifted + norm(where.place)) : Bounds::places * norm(where.place)) * unitRoundoff / compliance;
    const double slack = roundings * (rounding + unitRoundoff * moved / compliance) + ways + rounded, allowed = bound * force + slack;
    const bool open = !pair->second->state.closed();
    const PairEndShare& carrier = ends[first];
    if (carrier.kind.separates) {
      // Zero unless the sign is wrong; NaN stays NaN.
      findings.take(Quantity::Penetration, asForce > 0.0 ? 0.0 : -asForce, allowed, force, where);
      findings.take(Quantity::Tension, pressing > 0.0 ? 0.0 : -pressing, allowed, force, where);
      findings.take(Quantity::Complementarity, std::min(std::abs(pressing), std::abs(asForce)), allowed, force, where);
      findings.take(Quantity::Status, std::abs(open ? pressing : asForce), allowed, force, where);
    } else {  // the gap is an equation, and such pairs are never open
      findings.take(Quantity::Status, open ? std::max(std::abs(asForce), force) : std::abs(asForce), allowed, force, where);
    }
    const double slideSlack = roundings * unitRoundoff * lifted / compliance;
    const Point slip = scaled(1.0 / compliance, shift);
    const SlidingErrors sliding = slidingErrors(*pair->second, carrier, slip);
    if (carrier.kind.restrictsSliding || sliding.friction != 0.0)
      findings.take(Quantity::Friction, sliding.friction, allowed + slideSlack, force, where);
    if (!carrier.kind.restrictsSliding) continue;
    findings.take(Quantity::Slip, sliding.slip, allowed + slideSlack, force, where);
    findings.take(Quantity::Dissipation, sliding.dissipation, allowed + slideSlack, force, where);
  }
  if (found != pairs.size()) findings.take(Quantity::Status, std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0, Finding());
}

}  // namespace suture
