#include <suture/base/Point.hpp>
#include <suture/simulation/moving/MovingConstraints.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace suture {

namespace {

// Distance from a prescribed place that is round-off of frames and places: zero, so that bodies without forces count as such.
constexpr double kSamePlace = 32.0 * std::numeric_limits<double>::epsilon();
constexpr double kAlongAxis = 1e-12;  // part of a rotation vector off an axis that is round-off

/// A prescribed displacement at a place. \param drawn  place on the drawn body
double rounded(double value, const Point& drawn, const Point& place) {
  return std::abs(value) <= kSamePlace * (norm(drawn) + norm(place)) ? 0.0 : value;
}

/// True if motions of a rigid group that are prescribed along fixed axes leave the same free motions to the group turned by `rotation`.
bool freedomTurns(const std::array<std::optional<double>, 6>& motions, const Point& rotation, int dimension) {
  if (rotation == Point{0, 0, 0}) return true;
  const auto alike = [&](std::size_t a, std::size_t b) { return motions[a].has_value() == motions[b].has_value(); };
  if (dimension == 2) return alike(0, 1);
  if (alike(0, 1) && alike(1, 2) && alike(3, 4) && alike(4, 5)) return true;
  for (std::size_t k = 0; k < 3; ++k) {  // a rotation about an axis keeps it
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const bool isAbout = std::max(std::abs(rotation[i]), std::abs(rotation[j])) <= kAlongAxis * std::abs(rotation[k]);
    if (isAbout && alike(i, j) && alike(3 + i, 3 + j)) return true;
  }
  return false;
}

std::array<Point, 3> turnedAxes(const BodyFrame& frame, const std::array<Point, 3>& axes) {
  return {frame.turn(axes[0]), frame.turn(axes[1]), frame.turn(axes[2])};
}

bool holdsAll(const NodeRule& rule, int dimension) {
  return std::all_of(rule.fixed.begin(), rule.fixed.begin() + dimension, [](bool fixed) { return fixed; });
}

}  // namespace

MovingConstraints::MovingConstraints(const Scene& scene, const Mesh& drawn, Constraints constraints)
    : scene_(scene), drawn_(drawn), ofDrawn_(std::move(constraints)) {
  std::set<int> nodes;
  for (const TouchingSides& contact : ofDrawn_.parts.touching)
    for (const std::vector<std::string>* groups : {&contact.groupsA, &contact.groupsB})
      for (const Side& side : sidesOf(drawn_.sideGroups, *groups))
        for (const int node : drawn_.nodesOf(side)) nodes.insert(node);
  touching_.assign(nodes.begin(), nodes.end());
}

MovingConstraints::Drive MovingConstraints::driveOf(const RigidGroup& group, const std::vector<double>& factors,
                                                    const MovingBodies& bodies) const {
  Drive drive;
  const BodyFrame& frame = bodies.frameOf(group.nodes.front());
  const double factor = factors[static_cast<std::size_t>(group.factor)];
  drive.drawn = group.point;
  drive.point = frame.at(drive.drawn);
  const Point moved = minus(drive.point, drive.drawn), now = frame.rotation();
  Point target = now;
  for (std::size_t k = 0; k < 3; ++k) {
    if (group.motions[k]) drive.shift[k] = factor * *group.motions[k] - moved[k];
    if (group.motions[3 + k]) target[k] = factor * *group.motions[3 + k];
  }
  // In 2D the angle counts all turns; in 3D the rest is the rotation from the present to the prescribed orientation.
  const Point rest = drawn_.dimension == 2 ? minus(target, now) : rotationVector(rotationBy(target) * rotationBy(now).conjugate());
  for (std::size_t k = 0; k < 3; ++k)
    if (group.motions[3 + k]) drive.turn[k] = rest[k];
  drive.turnsAlong = freedomTurns(group.motions, now, drawn_.dimension);
  return drive;
}

void MovingConstraints::drive(double time, MovingBodies& bodies) const {
  const std::vector<double> factors = scene_.steps.at(time);
  for (const RigidGroup& group : ofDrawn_.rigidGroups) {
    const Drive drive = driveOf(group, factors, bodies);
    bodies.move(bodies.partOf(group.nodes.front()), {drive.shift, drive.turn, drive.point});
  }
  const int d = drawn_.dimension;
  const std::map<int, Point> prescribed = prescribedAt(factors);
  Vector held = Vector::Zero(bodies.beside().size());
  for (const NodeRule& rule : ofDrawn_.rules) {
    const auto given = prescribed.find(rule.node);
    if (given == prescribed.end() || !holdsAll(rule, d)) continue;
    const NodeRule now = heldRule(rule, given->second, bodies);
    for (std::size_t k = 0; k < 3; ++k)
      for (int i = 0; i < d; ++i) held[Eigen::Index(rule.node) * d + i] += now.value[k] * now.axes[k][static_cast<std::size_t>(i)];
  }
  for (std::size_t part = 0; part < bodies.frames().size(); ++part)
    if (const auto p = static_cast<int>(part); bodies.isHeld(p)) bodies.move(p, bodies.motionOf(p, held));
}

std::map<int, Point> MovingConstraints::prescribedAt(const std::vector<double>& factors) const {
  std::map<int, Point> all;
  for (const NodeRule& rule : ofDrawn_.rules) all[rule.node] = ofDrawn_.prescribed.empty() ? rule.value : Point{0, 0, 0};
  for (std::size_t f = 0; f < ofDrawn_.prescribed.size(); ++f)
    for (const RuleValue& value : ofDrawn_.prescribed[f]) {
      Point& sum = all[value.node];
      sum = plus(sum, scaled(factors[f], value.value));
    }
  return all;
}

MovingConstraints::Drives MovingConstraints::drivesAt(const std::vector<double>& factors, const MovingBodies& bodies) const {
  Drives drives;
  for (const RigidGroup& group : ofDrawn_.rigidGroups)
    drives[ofDrawn_.conditions[static_cast<std::size_t>(group.condition)]] = driveOf(group, factors, bodies);
  return drives;
}

Constraints MovingConstraints::ofPresent(const Mesh& present, const Drives& drives, KeptChoices& choices) const {
  return scene_.constraints(
      present,
      [&](Condition& condition) {
        condition.movesFar = true;
        const auto found = drives.find(condition.name);
        if (found == drives.end()) return;
        const Drive& drive = found->second;
        for (std::size_t k = 0; k < 3; ++k) {
          if (condition.motions[k]) condition.motions[k] = drive.shift[k];
          if (condition.motions[3 + k]) condition.motions[3 + k] = drive.turn[k];
        }
        condition.point = drive.point;
        condition.factor = 0;
      },
      &choices);
}

std::vector<ContactPair> MovingConstraints::pairsOf(double time, const MovingBodies& bodies, const Mesh& present,
                                                    KeptChoices choices) const {
  return ofPresent(present, drivesAt(scene_.steps.at(time), bodies), choices).pairs;
}

Constraints MovingConstraints::at(double time, const MovingBodies& bodies, const Mesh& present, const SlipHistory& history,
                                  KeptChoices& choices) const {
  const std::vector<double> factors = scene_.steps.at(time);
  const Drives drives = drivesAt(factors, bodies);
  Constraints constraints = ofPresent(present, drives, choices);
  setRules(factors, bodies, present, drives, constraints);
  constraints.prescribed.clear();
  applyLaws(scene_.laws, present, fromDrawn(constraints.rules, bodies), constraints);
  constraints.notes.clear();
  const int d = drawn_.dimension;
  for (ContactPair& pair : constraints.pairs) {
    const double gap = pair.gap;
    for (const PairEnd& end : pair.ends)
      pair.gap += end.weight * dot(pair.normal, pointOf(bodies.beside().data() + Eigen::Index(end.node) * d, d));
    history.setPast(pair, gap, present, bodies);
  }
  return constraints;
}

/// The rules with displacements from the drawn places as values: two sides may both be held where they are placed, after different motions.
std::vector<NodeRule> MovingConstraints::fromDrawn(std::vector<NodeRule> rules, const MovingBodies& bodies) const {
  for (NodeRule& rule : rules) {
    const Point x = drawn_.point(rule.node), moved = minus(bodies.frameOf(rule.node).at(x), x);
    for (std::size_t k = 0; k < 3; ++k) rule.value[k] += dot(rule.axes[k], moved);
  }
  return rules;
}

/// Rule of a node with prescribed components, for displacements from its placed position. If all are prescribed, its axes turn with the
/// body. \param given  prescribed components along the drawn axes, from the drawn position
NodeRule MovingConstraints::heldRule(const NodeRule& drawn, const Point& given, const MovingBodies& bodies) const {
  NodeRule rule = drawn;
  const Point x = drawn_.point(drawn.node);
  const BodyFrame& frame = bodies.frameOf(drawn.node);
  Point moved = minus(x, frame.at(x));
  for (std::size_t k = 0; k < 3; ++k)
    if (drawn.fixed[k]) moved = plus(moved, scaled(given[k], drawn.axes[k]));
  if (holdsAll(drawn, drawn_.dimension)) rule.axes = turnedAxes(frame, drawn.axes);
  for (std::size_t k = 0; k < 3; ++k) rule.value[k] = rule.fixed[k] ? rounded(dot(rule.axes[k], moved), x, frame.at(x)) : 0.0;
  return rule;
}

void MovingConstraints::setRules(const std::vector<double>& factors, const MovingBodies& bodies, const Mesh& present, const Drives& drives,
                                 Constraints& constraints) const {
  const std::map<int, Point> prescribed = prescribedAt(factors);
  const RigidGroupNodes inGroups(constraints.rigidGroups, drawn_.dimension);
  std::map<int, NodeRule> rules;
  for (const NodeRule& rule : ofDrawn_.rules) {
    if (inGroups.contains(rule.node) || std::find(rule.fixed.begin(), rule.fixed.end(), true) == rule.fixed.end()) continue;
    rules[rule.node] = heldRule(rule, prescribed.at(rule.node), bodies);
  }
  setGroups(bodies, present, drives, rules, constraints);
  for (const int node : touching_) {
    NodeRule rule;
    rule.node = node;
    rule.axes = turnedAxes(bodies.frameOf(node), rule.axes);
    rules.emplace(node, rule);
  }
  constraints.rules.clear();
  for (const auto& entry : rules) constraints.rules.push_back(entry.second);
  std::vector<Support> supports;
  for (const Support& support : constraints.supports)
    if (inGroups.contains(support.node)) supports.push_back(support);
  for (const Support& support : ofDrawn_.supports)
    if (!inGroups.contains(support.node)) supports.push_back(support);
  std::stable_sort(supports.begin(), supports.end(), [](const Support& a, const Support& b) { return a.node < b.node; });
  constraints.supports = std::move(supports);
}

/// Rules of rigid groups. A group whose freedom turns with its body has the masters and coefficients of the drawn one along turned axes, so
/// that no matrix changes; any other group those of its present place, along fixed axes.
void MovingConstraints::setGroups(const MovingBodies& bodies, const Mesh& present, const Drives& drives, std::map<int, NodeRule>& rules,
                                  Constraints& constraints) const {
  const int d = drawn_.dimension;
  std::map<int, NodeRule> now, drawn;
  for (const NodeRule& rule : constraints.rules) now[rule.node] = rule;
  for (const NodeRule& rule : ofDrawn_.rules) drawn[rule.node] = rule;
  for (RigidGroup& group : constraints.rigidGroups) {
    const Drive& drive = drives.at(constraints.conditions[static_cast<std::size_t>(group.condition)]);
    const auto before = std::find_if(ofDrawn_.rigidGroups.begin(), ofDrawn_.rigidGroups.end(),
                                     [&](const RigidGroup& one) { return one.condition == group.condition; });
    const bool turns = drive.turnsAlong && before != ofDrawn_.rigidGroups.end() && before->masters() == group.masters();
    if (turns) {
      const Point point = group.point;
      group = *before;
      group.point = point;
      group.axes = turnedAxes(bodies.frameOf(group.nodes.front()), group.axes);
    }
    const BodyFrame& frame = bodies.frameOf(group.nodes.front());
    group.turned = frame.rotation();
    group.moved = minus(drive.point, drive.drawn);
    const std::vector<RigidGroup> single{group};
    const RigidGroupNodes own(single, d);
    const auto besideAt = [&](int node) { return pointOf(bodies.beside().data() + Eigen::Index(node) * d, d); };
    const bool rests = bodies.rests(bodies.partOf(group.nodes.front()));
    // Displacement from the placed mesh of a motion that meets all prescribed components.
    const auto motionAt = [&](int node) {
      if (rests) return plus(drive.shift, cross(drive.turn, minus(drawn_.point(node), drive.drawn)));
      if (!turns) return besideAt(node);
      return plus(besideAt(node), plus(drive.shift, cross(drive.turn, minus(present.point(node), drive.point))));
    };
    for (const int node : group.nodes) {
      NodeRule rule = turns ? drawn.at(node) : now.at(node);
      if (turns) rule.value = {0, 0, 0};
      rule.axes = group.axes;
      for (int k = 0; k < d; ++k) {
        const auto at = static_cast<std::size_t>(k);
        if (!rule.fixed[at]) continue;
        rule.value[at] += dot(rule.axes[at], motionAt(node));
        own.forEachMaster(node, k, [&](int master, int of, double coefficient) {
          rule.value[at] -= coefficient * dot(group.axes[static_cast<std::size_t>(of)], motionAt(master));
        });
        rule.value[at] = rounded(rule.value[at], drawn_.point(node), present.point(node));
      }
      rules[node] = rule;
    }
  }
}

}  // namespace suture
