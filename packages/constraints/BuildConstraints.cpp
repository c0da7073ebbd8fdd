#include <suture/constraints/BuildConstraints.hpp>
#include <suture/constraints/Conditions.hpp>
#include <suture/constraints/ContactPieces.hpp>
#include <suture/constraints/FacetError.hpp>
#include <suture/constraints/NodalRules.hpp>
#include <suture/constraints/pairing/ContactPairs.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace suture {

namespace {

using SideSet = std::set<std::pair<int, int>>;

SideSet sidesOf(const Mesh& mesh, const std::string& group) {
  SideSet all;
  for (const Side& side : mesh.sideGroups.at(group)) all.insert({side.element, side.side});
  return all;
}

bool holdsEverything(const Condition& condition, int dimension) {
  return condition.type == Condition::Type::Bilateral ||
         (condition.type == Condition::Type::Displacement && static_cast<int>(condition.components.size()) == dimension);
}

// A side that is held on its whole length can neither take part in contact nor feel a load: one of the two is a slip.
void checkRoles(const Mesh& mesh, const std::vector<Condition>& conditions, const std::vector<ContactLine>& lines, Problems& problems) {
  for (const Condition& holding : conditions) {
    if (!holdsEverything(holding, mesh.dimension)) continue;
    const SideSet held = sidesOf(mesh, holding.group);
    const auto covers = [&](const std::string& group) {
      const SideSet other = sidesOf(mesh, group);
      return std::includes(held.begin(), held.end(), other.begin(), other.end());
    };
    for (const ContactLine& line : lines)
      for (const auto& [group, side] : {std::make_pair(line.groupA, "Side A"), std::make_pair(line.groupB, "Side B")})
        if (!group.empty() && covers(group))
          problems.add(line.path + "/" + side,
                       "'" + group + "' is held on its whole length by " + holding.path + "; a side is either held or in contact");
    for (const Condition& load : conditions)
      if (holding.type == Condition::Type::Displacement && !load.holds() && !load.group.empty() && covers(load.group))
        problems.add(load.path + "/Group",
                     "all displacements of '" + load.group + "' are given by " + holding.path + ", so that no load can act there");
  }
}

// Contact nodes in one line, and with nothing prescribed, get the pair's axes, or the mean of several pairs (mortar).
void addContactFrames(const std::vector<ContactPair>& pairs, std::vector<NodeRule>& rules) {
  struct Use {
    int pairs = 0, line = -1;
    bool oneLine = true;
    Point last{0, 0, 0}, sum{0, 0, 0};  // normals: of the last pair; of all, each with its weight
  };
  std::map<int, Use> uses;
  for (const ContactPair& pair : pairs)
    for (const PairEnd& end : pair.ends) {
      Use& use = uses[end.node];
      use.oneLine = use.oneLine && (use.pairs == 0 || use.line == pair.line);
      use.line = pair.line;
      use.last = pair.normal;
      ++use.pairs;
      for (int k = 0; k < 2; ++k) use.sum[k] += std::abs(end.weight) * pair.normal[k];
    }
  std::set<int> ruled;
  for (const NodeRule& rule : rules) ruled.insert(rule.node);
  for (const auto& [node, use] : uses) {
    if (!use.oneLine || ruled.count(node)) continue;
    NodeRule rule;
    rule.node = node;
    rule.axes[0] = use.pairs == 1 ? use.last : unit(use.sum);
    rule.axes[1] = turned(rule.axes[0]);
    rules.push_back(rule);
  }
  std::sort(rules.begin(), rules.end(), [](const NodeRule& x, const NodeRule& y) { return x.node < y.node; });
}

// A body that nothing touches can be anywhere.
void checkHeld(const Mesh& mesh, const Constraints& constraints, Problems& problems) {
  std::vector<char> held(mesh.bodies.size(), 0);
  for (const NodeRule& rule : constraints.rules) held[mesh.bodyOfNode[rule.node]] = 1;  // boundary conditions only, as yet
  for (const ContactPiece& piece : constraints.pieces)
    for (const int body : {piece.bodyA, piece.bodyB})
      if (body >= 0) held[body] = 1;
  for (std::size_t body = 0; body < mesh.bodies.size(); ++body)
    if (!held[body])
      problems.add("Bodies/" + mesh.bodies[body],
                   "nothing holds this body: no Displacement or Bilateral condition and no contact line is on its boundary");
}

}  // namespace

Constraints buildConstraints(const Mesh& mesh, const Parameters& conditionList, const Parameters& contactList, const Constants& constants,
                             const ContactScales& scales) {
  Problems problems;
  const std::vector<Condition> conditions = readConditions(mesh, conditionList, constants, problems);
  std::vector<ContactLine> lines = readContact(mesh, contactList, constants, problems);
  for (ContactLine& line : lines) {
    line.complianceA = complianceOf(mesh, line.groupA, scales);
    line.complianceB = complianceOf(mesh, line.groupB, scales);
  }
  checkRoles(mesh, conditions, lines, problems);

  Constraints constraints;
  constraints.rules = nodalRules(mesh, conditions, problems);
  std::vector<PairedLine> paired;
  for (const ContactLine& line : lines) {
    paired.push_back(pairLine(mesh, line, problems, constraints.notes));
    noteInterference(line, paired.back(), scales.lengthUnit, constraints.notes);
    const int base = static_cast<int>(constraints.pairs.size());
    for (ContactPair pair : paired.back().pairs) {
      pair.id += base;
      constraints.pairs.push_back(pair);
    }
  }
  problems.throwIfAny();

  constraints.pieces = findPieces(lines, paired, constraints.pairs);
  int base = 0;
  for (const PairedLine& line : paired) {
    for (AxisPoint point : line.onAxis) {
      for (int& id : point.pairs) id += base;
      constraints.pieces[constraints.pairs[point.pairs[0]].piece].onAxis.push_back(point);
    }
    base += static_cast<int>(line.pairs.size());
  }
  estimatePressures(lines, paired, constraints);
  checkHeld(mesh, constraints, problems);
  problems.throwIfAny();
  addContactFrames(constraints.pairs, constraints.rules);
  return constraints;
}

std::vector<PairEnd> matchingEnds(int nodeA, int nodeB) { return {{nodeA, 1.0}, {nodeB, -1.0}}; }

Point obstacleForce(const ContactPair& pair, double force) {
  double sum = 0.0, size = 0.0;
  for (const PairEnd& end : pair.ends) sum += end.weight, size += std::abs(end.weight);
  if (std::abs(sum) < 1e-9 * size) return {0, 0, 0};
  return {-force * sum * pair.normal[0], -force * sum * pair.normal[1], -force * sum * pair.normal[2]};
}

Matrix axesOf(const NodeRule& rule, int dimension) {
  Matrix q(dimension, dimension);
  for (int row = 0; row < dimension; ++row)
    for (int column = 0; column < dimension; ++column) q(row, column) = rule.axes[row][column];
  return q;
}

}  // namespace suture
