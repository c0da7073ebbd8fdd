#include <suture/constraints/BuildConstraints.hpp>
#include <suture/constraints/Conditions.hpp>
#include <suture/constraints/ContactPairs.hpp>
#include <suture/constraints/ContactPieces.hpp>
#include <suture/constraints/NodalRules.hpp>

#include <algorithm>
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
        if (covers(group))
          problems.add(line.path + "/" + side,
                       "'" + group + "' is held on its whole length by " + holding.path + "; a side is either held or in contact");
    for (const Condition& load : conditions)
      if (holding.type == Condition::Type::Displacement && !load.holds() && !load.group.empty() && covers(load.group))
        problems.add(load.path + "/Group",
                     "all displacements of '" + load.group + "' are given by " + holding.path + ", so that no load can act there");
  }
}

// Contact nodes in one pair, and with nothing prescribed, get the pair's axes.
void addContactFrames(const std::vector<ContactPair>& pairs, std::vector<NodeRule>& rules) {
  std::map<int, std::pair<int, int>> uses;  // node -> number of pairs, the last of them
  for (const ContactPair& pair : pairs)
    for (const int node : {pair.nodeA, pair.nodeB}) {
      auto& use = uses[node];
      ++use.first;
      use.second = pair.id;
    }
  std::set<int> ruled;
  for (const NodeRule& rule : rules) ruled.insert(rule.node);
  for (const auto& [node, use] : uses) {
    if (use.first != 1 || ruled.count(node)) continue;
    const Point& n = pairs[use.second].normal;
    NodeRule rule;
    rule.node = node;
    rule.axes[0] = n;
    rule.axes[1] = {-n[1], n[0], 0};
    rules.push_back(rule);
  }
  std::sort(rules.begin(), rules.end(), [](const NodeRule& x, const NodeRule& y) { return x.node < y.node; });
}

// A body that nothing touches can be anywhere.
void checkHeld(const Mesh& mesh, const Constraints& constraints, Problems& problems) {
  std::vector<char> held(mesh.bodies.size(), 0);
  for (const NodeRule& rule : constraints.rules) held[mesh.bodyOfNode[rule.node]] = 1;  // of boundary conditions only, as yet
  for (const ContactPiece& piece : constraints.pieces) held[piece.bodyA] = held[piece.bodyB] = 1;
  for (std::size_t body = 0; body < mesh.bodies.size(); ++body)
    if (!held[body])
      problems.add("Bodies/" + mesh.bodies[body],
                   "nothing holds this body: no Displacement or Bilateral condition and no contact line is on its boundary");
}

}  // namespace

Constraints buildConstraints(const Mesh& mesh, const Parameters& conditionList, const Parameters& contactList, const Constants& constants) {
  Problems problems;
  const std::vector<Condition> conditions = readConditions(mesh, conditionList, constants, problems);
  const std::vector<ContactLine> lines = readContact(mesh, contactList, problems);
  checkRoles(mesh, conditions, lines, problems);

  Constraints constraints;
  constraints.rules = nodalRules(mesh, conditions, problems);
  std::vector<PairedLine> paired;
  for (const ContactLine& line : lines) {
    paired.push_back(pairLine(mesh, line, problems));
    const int base = static_cast<int>(constraints.pairs.size());
    for (ContactPair pair : paired.back().pairs) {
      pair.id += base;
      constraints.pairs.push_back(pair);
    }
  }
  problems.throwIfAny();

  constraints.pieces = findPieces(lines, paired, constraints.pairs);
  checkHeld(mesh, constraints, problems);
  problems.throwIfAny();
  addContactFrames(constraints.pairs, constraints.rules);
  return constraints;
}

Matrix axesOf(const NodeRule& rule, int dimension) {
  Matrix q(dimension, dimension);
  for (int row = 0; row < dimension; ++row)
    for (int column = 0; column < dimension; ++column) q(row, column) = rule.axes[row][column];
  return q;
}

}  // namespace suture
