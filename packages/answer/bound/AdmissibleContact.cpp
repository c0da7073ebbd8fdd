#include <Eigen/LU>
#include <suture/answer/bound/AdmissibleContact.hpp>
#include <suture/answer/bound/ContactPressures.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/SideInterpolation.hpp>
#include <suture/pairs/PairFrame.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// Differences of the normals of a side's nodes, and of relative friction bounds, that are round-off.
constexpr double kSameNormal = 1e-8;
// Penetration of nodes, relative to displacements, that is round-off.
constexpr double kRoundOffOfPenetration = 1e-14;

}  // namespace

std::string AdmissibleContact::findTractions(ContactTractions& all, std::vector<SideTraction>& tractions) {
  if (contact_.isSoft) {
    if (restrictsSliding_ || !separates_) return "it is softened and not frictionless";
    if (!isSimple_) return "it is softened and its sides are coupled by mortar";
    // Its pairs press outer nodes of the springs.
    for (const TouchingSide* side : a_) stiffness_ = std::max(stiffness_, side->stiffness);
    if (!(stiffness_ > 0.0)) return "its springs are not known";
    for (ContactNodes::Pair& own : pairs_) own.pair.a = own.result.node;
  }
  for (const Sides* sides : {&a_, &b_})
    for (const TouchingSide* side : *sides)
      if (std::any_of(side->nodes.begin(), side->nodes.begin() + sideNodes(), [](GlobalId node) { return node < 0; }))
        return "sides with four vertices have no node in the middle of their diagonal";
  if (contact_.isInterpolated && separates_) return "its gap varies between the nodes";
  if (!isSimple_ && contact_.groupsB.empty()) return "conditions on an obstacle involve several nodes";
  ContactNodes nodes(sideNodes(), a_, b_, contact_.gaps);
  if (isSimple_)
    nodes.addPairs(pairs_);
  else if (const std::string mismatch = nodes.addPlaces(pairs_, !separates_ && restrictsSliding_); !mismatch.empty())
    return mismatch;
  Sides pressed, others;
  PressedSides sides;
  const std::string problem = collect(nodes, sides, pressed, others);
  if (!problem.empty()) return problem;
  sides.mayPull = !separates_;
  const std::vector<std::array<double, 4>> linear = linearPressures(nodes, pressed);
  for (std::size_t i = 0; i < nodes.all().size(); ++i) sides.forces[i] = nodes.all()[i].force;
  const Pressures pressures = admissiblePressures(sides);
  if (!pressures.feasible) return "its nodal forces are not those of any pressure";
  const FrictionTractions friction = tangentialStresses(nodes, sides);
  if (!friction.feasible) return "its nodal forces are not those of any friction stress";
  addTractions(nodes, pressed, others, pressures.values, friction.values, linear, tractions);
  if (separates_) {
    addGap(nodes, sides, pressures, all);
    if (restrictsSliding_) addFriction(nodes, sides, friction, all);
  } else {
    close(nodes, all);
  }
  std::vector<Point> rests;
  for (std::size_t i = 0; i < nodes.all().size(); ++i) rests.push_back(scaled(pressures.rest[i], nodes.all()[i].normal));
  addRests(nodes, pressures.clusters, rests, all);
  for (std::size_t i = 0; i < rests.size(); ++i) rests[i] = along(nodes.all()[i].normal, friction.rest[i]);
  addRests(nodes, friction.clusters, rests, all);
  return "";
}

Point AdmissibleContact::along(const Point& normal, const std::array<double, 2>& components) const {
  const std::vector<Point> frame = pairFrame(normal, dimension_);
  Point sum{0, 0, 0};
  for (int k = 1; k < dimension_; ++k) sum = plus(sum, scaled(components[std::size_t(k - 1)], frame[std::size_t(k)]));
  return sum;
}

std::array<double, 2> AdmissibleContact::tangentialPart(const ContactNode& node, const Point& vector) const {
  const std::vector<Point> frame = pairFrame(node.normal, dimension_);
  return {dot(vector, frame[1]), dimension_ == 3 ? dot(vector, frame[2]) : 0.0};
}

FrictionTractions AdmissibleContact::tangentialStresses(const ContactNodes& nodes, const PressedSides& sides) const {
  FrictionForces forces;
  for (const ContactNode& node : nodes.all()) {
    forces.tangential.push_back(tangentialPart(node, node.tangential));
    forces.bounds.push_back(std::max(node.bound, norm(node.tangential)));
    forces.slips.push_back(char(node.slips));
  }
  if (restrictsSliding_ && separates_) {
    if (const std::optional<double> bound = constantBound(nodes, sides)) forces.given = *bound;
    return frictionTractions(sides, forces);
  }
  FrictionTractions result;
  result.feasible = true;
  result.rest.assign(sides.places.size(), {0.0, 0.0});
  for (int k = 0; k < 2; ++k) {
    PressedSides own = sides;
    own.mayPull = true;
    for (std::size_t i = 0; i < own.forces.size(); ++i) own.forces[i] = restrictsSliding_ ? forces.tangential[i][k] : 0.0;
    const Pressures stresses = admissiblePressures(own);
    result.values[k] = stresses.values;
    result.feasible = result.feasible && stresses.feasible;
  }
  return result;
}

std::optional<double> AdmissibleContact::constantBound(const ContactNodes& nodes, const PressedSides& sides) const {
  const auto at = [&](const Point& place) {
    ContactTrial trial;
    trial.force = {1, 0, 0};
    trial.size = 1.0;
    trial.place = place;
    return law_.project(trial, PairStatus::Stick);
  };
  std::optional<double> all;
  for (const TouchingSide* side : a_) {
    std::vector<Point> points;
    for (int j = 0; j < sideNodes(); ++j) points.push_back(side->places[j]);
    for (const Point& point : points) {
      const ContactState state = at(point);
      if (state.friction != 0.0 || (all && *all != state.bound)) return std::nullopt;
      all = state.bound;
    }
    // In the order of SideGeometry: values between the nodes are interpolated only if they are equal too.
    if (!isInterpolated({points.begin(), points.begin() + dimension_}, dimension_, [&](const Point& p) { return at(p).bound; }))
      return std::nullopt;
  }
  if (!all) return std::nullopt;
  const Vector integrals = sideMass(dimension_, degree_).rowwise().sum();
  std::vector<double> bounds(nodes.all().size(), 0.0);
  for (int side = 0; side < sides.sides(); ++side)
    for (int i = 0; i < sides.sideNodes(); ++i)
      bounds[std::size_t(sides.nodesOf(side)[i])] += *all * integrals[i] * sides.sizes[std::size_t(side)];
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const ContactNode& node = nodes.all()[i];
    if (!node.isClosed || std::abs(node.bound - bounds[i]) > kSameNormal * *all * sides.sizes[0]) return std::nullopt;
  }
  return all;
}

std::string AdmissibleContact::collect(const ContactNodes& nodes, PressedSides& sides, Sides& pressed, Sides& others) const {
  sides.dimension = dimension_;
  sides.degree = degree_;
  for (const ContactNode& node : nodes.all()) {
    sides.places.push_back(node.place);
    sides.forces.push_back(node.force);
  }
  std::map<std::vector<GlobalId>, const TouchingSide*> opposite;
  for (const TouchingSide* side : b_) opposite[std::vector<GlobalId>(side->nodes.begin(), side->nodes.begin() + dimension_)] = side;
  for (const TouchingSide* side : a_) {
    std::vector<int> own;
    for (int j = 0; j < sideNodes(); ++j)
      if (nodes.indexOf(side->nodes[j]) >= 0) own.push_back(nodes.indexOf(side->nodes[j]));
    if (int(own.size()) < sideNodes()) continue;  // its nodes face nothing
    for (std::size_t j = 0; j < own.size(); ++j) {
      if (norm(minus(nodes.all()[own[j]].normal, nodes.all()[own[0]].normal)) > kSameNormal)
        return "its normals vary along its sides: it is curved, or its gap varies";
      sides.places[own[j]] = side->places[j];
    }
    if (!contact_.groupsB.empty()) {
      std::vector<GlobalId> key;
      for (int j = 0; j < dimension_; ++j) key.push_back(nodes.all()[own[j]].b);
      std::sort(key.begin(), key.end());
      const auto found = opposite.find(key);
      if (found == opposite.end()) return "its sides do not match";
      others.push_back(found->second);
    }
    sides.nodes.insert(sides.nodes.end(), own.begin(), own.end());
    sides.sizes.push_back(side->size);
    pressed.push_back(side);
  }
  return pressed.empty() ? "no side of it faces another" : "";
}

std::vector<std::array<double, 4>> AdmissibleContact::linearPressures(ContactNodes& nodes, const Sides& pressed) const {
  std::vector<std::array<double, 4>> all(pressed.size(), {{0.0, 0.0, 0.0, 0.0}});
  std::vector<double> tributary(nodes.all().size(), 0.0), changes = tributary;
  std::map<std::vector<GlobalId>, std::vector<std::size_t>> wholes;  // triangles by the nodes of their sides
  for (std::size_t s = 0; s < pressed.size(); ++s) {
    const std::vector<GlobalId>& own = pressed[s]->whole.nodes;
    if (!own.empty() && std::all_of(own.begin(), own.end(), [&](GlobalId node) { return nodes.indexOf(node) >= 0; }))
      wholes[own].push_back(s);
  }
  const auto indexOf = [&](GlobalId node) { return std::size_t(nodes.indexOf(node)); };
  std::vector<Point> places(nodes.all().size());
  for (const TouchingSide* side : pressed)
    for (int j = 0; j < sideNodes(); ++j) places[indexOf(side->nodes[j])] = side->places[j];
  for (const auto& [own, triangles] : wholes)
    for (std::size_t i = 0; i < own.size(); ++i) tributary[indexOf(own[i])] += pressed[triangles[0]]->whole.ofCell[4 * i];
  for (const auto& [own, triangles] : wholes) {
    const auto isClosed = [&](GlobalId node) { return nodes.all()[indexOf(node)].isClosed; };
    if (triangles.size() != 2 || !std::all_of(own.begin(), own.end(), isClosed)) continue;
    Point centre{0, 0, 0};
    for (int i = 0; i < 4; ++i) centre = plus(centre, scaled(0.25, places[indexOf(own[i])]));
    const Point& n = nodes.all()[indexOf(own[0])].normal;
    const Eigen::Vector3d normal(n[0], n[1], n[2]);
    double mean = 0.0;
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
    for (int i = 0; i < 4; ++i) {
      const ContactNode& node = nodes.all()[indexOf(own[i])];
      const Point arm = minus(places[indexOf(own[i])], centre);
      const Eigen::Vector3d a(arm[0], arm[1], arm[2]);
      const double pressure = node.force / tributary[indexOf(own[i])];
      mean += 0.25 * pressure;
      first += pressure * a;
      second += a * a.transpose();
    }
    second += second.trace() * normal * normal.transpose();
    Eigen::Vector3d slope = second.inverse() * first;
    slope -= slope.dot(normal) * normal;
    if (degree_ == 1) slope.setZero();
    for (const std::size_t s : triangles) all[s] = {{mean, slope[0], slope[1], slope[2]}};
    const WholeSide& side = pressed[triangles[0]]->whole;
    for (std::size_t i = 0; i < own.size(); ++i)
      for (std::size_t c = 0; c < 4; ++c)
        changes[indexOf(own[i])] += all[triangles[0]][c] * (side.ofTriangles[4 * i + c] - side.ofCell[4 * i + c]);
  }
  for (std::size_t i = 0; i < changes.size(); ++i) nodes.addForce(i, changes[i]);
  return all;
}

void AdmissibleContact::addTractions(const ContactNodes& nodes, const Sides& pressed, const Sides& others, const Matrix& pressures,
                                     const std::array<Matrix, 2>& friction, const std::vector<std::array<double, 4>>& linear,
                                     std::vector<SideTraction>& tractions) const {
  for (std::size_t s = 0; s < pressed.size(); ++s) {
    SideTraction own{pressed[s]->rank, pressed[s]->number};
    const Point& normal = nodes.all()[nodes.indexOf(pressed[s]->nodes[0])].normal;
    for (std::size_t c = 0; c < 4; ++c) own.replaced[c] = scaled(-linear[s][c], normal);
    for (int j = 0; j < sideNodes(); ++j) {
      const Point slid = along(normal, {friction[0](j, int(s)), friction[1](j, int(s))});
      own.values[j] = scaled(-1.0, plus(scaled(pressures(j, int(s)), normal), slid));
    }
    tractions.push_back(own);
    if (others.empty()) continue;
    SideTraction other{others[s]->rank, others[s]->number};
    const double sizes = pressed[s]->size / others[s]->size;  // the sides need not be parallel
    for (std::size_t c = 0; c < 4; ++c) other.replaced[c] = scaled(-sizes, own.replaced[c]);
    for (int j = 0; j < sideNodes(); ++j) {
      const GlobalId partner = nodes.all()[nodes.indexOf(pressed[s]->nodes[j])].b;
      for (int i = 0; i < sideNodes(); ++i)
        if (others[s]->nodes[i] == partner) other.values[i] = scaled(-sizes, own.values[j]);
    }
    tractions.push_back(other);
  }
}

void AdmissibleContact::addGap(const ContactNodes& nodes, const PressedSides& sides, const Pressures& pressures,
                               ContactTractions& all) const {
  double moved = 0.0;
  for (const TouchingSide* side : a_)
    for (int j = 0; j < sideNodes(); ++j) moved = std::max(moved, norm(side->moved[j]));
  std::vector<double> heights;
  for (const ContactNode& node : nodes.all()) heights.push_back(-node.gap > kRoundOffOfPenetration * moved ? -node.gap : 0.0);
  const auto gapsOf = [&](const std::vector<double>& lifted) {
    Matrix gaps(sides.sideNodes(), sides.sides());
    for (int s = 0; s < sides.sides(); ++s)
      for (int j = 0; j < sides.sideNodes(); ++j) gaps(j, s) = nodes.all()[sides.nodesOf(s)[j]].gap + lifted[sides.nodesOf(s)[j]];
    return gaps;
  };
  const std::vector<double> more = liftOfGaps(sides, gapsOf(heights));
  const std::map<GlobalId, double> stiffness = nodalStiffness();
  for (std::size_t i = 0; i < heights.size(); ++i) {
    heights[i] += more[i];
    if (!(heights[i] > 0.0) || contact_.isSoft) continue;
    const ContactNode& node = nodes.all()[i];
    // The energy of both lifts together is least if they are as their compliances.
    const double ofA = node.b < 0 ? 1.0 : stiffness.at(node.b) / (stiffness.at(node.a) + stiffness.at(node.b));
    move(all.lifts[node.a], -ofA * heights[i], node.normal);
    if (node.b >= 0) move(all.lifts[node.b], (1.0 - ofA) * heights[i], node.normal);
    all.liftWork += node.force * heights[i];
  }
  const double lifted = 2 * std::max(0.0, gapWork(sides, pressures.values, gapsOf(heights)));
  all.liftedGapWork += lifted;
  if (contact_.isSoft) {
    all.gapWork += lifted;
    addLayer(nodes, sides, pressures, heights, all);
  } else {
    all.gapWork += 2 * gapWork(sides, pressures.values, gapsOf(std::vector<double>(heights.size(), 0.0)));
  }
}

void AdmissibleContact::move(Point& place, double by, const Point& direction) { place = plus(place, scaled(by, direction)); }

std::map<GlobalId, double> AdmissibleContact::nodalStiffness() const {
  std::map<GlobalId, double> all;
  for (const Sides* sides : {&a_, &b_})
    for (const TouchingSide* side : *sides)
      for (int j = 0; j < sideNodes(); ++j) all[side->nodes[j]] = std::max(all[side->nodes[j]], side->young);
  return all;
}

void AdmissibleContact::addLayer(const ContactNodes& nodes, const PressedSides& sides, const Pressures& pressures,
                                 const std::vector<double>& heights, ContactTractions& all) const {
  const double k = stiffness_;
  Matrix found(sides.sideNodes(), sides.sides()), lifted = found;
  for (int s = 0; s < sides.sides(); ++s)
    for (int j = 0; j < sides.sideNodes(); ++j) {
      const int node = sides.nodesOf(s)[j];
      found(j, s) = nodes.all()[node].shortening;
      lifted(j, s) = found(j, s) + heights[std::size_t(node)];
    }
  const Matrix deviation = pressures.values - k * lifted;
  all.layerWork += gapWork(sides, deviation, deviation) / k;
  const double before = k * gapWork(sides, found, found);
  all.layerEnergy += before;
  all.layerLift += (k * gapWork(sides, lifted, lifted) - before) / 2;
}

void AdmissibleContact::addFriction(const ContactNodes& nodes, const PressedSides& sides, const FrictionTractions& friction,
                                    ContactTractions& all) const {
  std::array<Matrix, 2> slips;
  for (Matrix& own : slips) own.resize(sides.sideNodes(), sides.sides());
  for (int s = 0; s < sides.sides(); ++s)
    for (int j = 0; j < sides.sideNodes(); ++j) {
      const ContactNode& node = nodes.all()[sides.nodesOf(s)[j]];
      const std::array<double, 2> slip = tangentialPart(node, node.slip);
      slips[0](j, s) = slip[0], slips[1](j, s) = slip[1];
    }
  const double work = 2 * std::max(0.0, slipWork(sides, friction, slips));
  all.gapWork += work;
  all.liftedGapWork += work;
  all.frictionEnergy += frictionEnergy(sides, friction, slips);
  if (friction.isGiven) return;
  const Matrix& mass = sideMass(dimension_, degree_);
  std::vector<double> moments(nodes.all().size(), 0.0);
  for (int s = 0; s < sides.sides(); ++s) {
    const Vector own = sides.sizes[std::size_t(s)] * mass * friction.bounds.col(s);
    for (int j = 0; j < sides.sideNodes(); ++j) moments[std::size_t(sides.nodesOf(s)[j])] += own[j];
  }
  double sum = 0.0, change = 0.0;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    sum += nodes.all()[i].boundOfLaw;
    change += std::abs(moments[i] - nodes.all()[i].boundOfLaw);
  }
  all.boundChange = std::max(all.boundChange, sum > 0.0 ? change / sum : 0.0);
}

void AdmissibleContact::close(const ContactNodes& nodes, ContactTractions& all) const {
  for (const ContactNode& node : nodes.all()) {
    Point step = scaled(node.gap, node.normal);
    if (restrictsSliding_) step = minus(step, node.slip);
    if (step == Point{0, 0, 0}) continue;
    Point& value = all.lifts[node.a];
    value = plus(value, step);
    all.liftWork -= node.force * dot(step, node.normal) + dot(node.tangential, step);
  }
}

void AdmissibleContact::addRests(const ContactNodes& nodes, const std::vector<std::vector<int>>& clusters, const std::vector<Point>& rests,
                                 ContactTractions& all) const {
  for (const std::vector<int>& cluster : clusters) {
    UnbalancedForces onA, onB;
    for (const int i : cluster) {
      const ContactNode& node = nodes.all()[i];
      if (rests[i] == Point{0, 0, 0}) continue;
      onA.nodes.push_back(node.a);
      onA.forces.push_back(rests[i]);
      if (node.b < 0) continue;
      onB.nodes.push_back(node.b);
      onB.forces.push_back(scaled(-1.0, rests[i]));
    }
    if (!onA.nodes.empty()) all.rests.push_back(std::move(onA));
    if (!onB.nodes.empty()) all.rests.push_back(std::move(onB));
  }
}

void AdmissibleContact::add(const ContactNodes::Pair& own) {
  separates_ = separates_ && own.pair.separates;
  restrictsSliding_ = restrictsSliding_ || own.pair.restrictsSliding;
  isSimple_ = isSimple_ && own.pair.isSimple;
  pairs_.push_back(own);
}

void AdmissibleContact::find(ContactTractions& all, std::vector<SideTraction>& tractions, std::set<std::string>& reasons) {
  const std::string problem = findTractions(all, tractions);
  if (problem.empty()) return;
  reasons.insert("contact '" + contact_.contact + "': " + problem);
  for (const auto* list : {&a_, &b_})
    for (const TouchingSide* side : *list) tractions.push_back({side->rank, side->number, 1});
}

}  // namespace suture
