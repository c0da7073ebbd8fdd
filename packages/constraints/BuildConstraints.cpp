#include <suture/base/RigidValues.hpp>
#include <suture/constraints/BoundaryParts.hpp>
#include <suture/constraints/BuildConstraints.hpp>
#include <suture/constraints/BuildRigidGroups.hpp>
#include <suture/constraints/Conditions.hpp>
#include <suture/constraints/FacetError.hpp>
#include <suture/constraints/NodalRules.hpp>
#include <suture/constraints/UnmodelledRim.hpp>
#include <suture/mesh/SideGeometry.hpp>
#include <suture/pairs/ContactPairs.hpp>
#include <suture/pairs/ContactPieces.hpp>
#include <suture/pairs/PairFrame.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace suture {

namespace {

constexpr double kAlongCoating = 1e-6;  // component along the normal up to which an axis is tangential

using SideSet = std::set<std::pair<int, int>>;

SideSet sideSet(const Mesh& mesh, const std::vector<std::string>& groups) {
  SideSet all;
  for (const Side& side : sidesOf(mesh.sideGroups, groups)) all.insert({side.element, side.side});
  return all;
}

bool holdsEverything(const Condition& condition, int dimension) {
  return condition.type == Condition::Type::Bilateral ||
         (condition.type == Condition::Type::Displacement && static_cast<int>(condition.components.size()) == dimension);
}

// A side that is held on its whole length can neither take part in contact nor carry a load: one of the two is a mistake.
void checkRoles(const Mesh& mesh, const std::vector<Condition>& conditions, const std::vector<ContactSurface>& contacts,
                Problems& problems) {
  for (const Condition& holding : conditions) {
    if (!holdsEverything(holding, mesh.dimension)) continue;
    const SideSet held = sideSet(mesh, holding.groups);
    const auto heldAmong = [&](const std::vector<std::string>& groups) {
      std::vector<std::string> found;
      for (const std::string& group : groups) {
        const SideSet own = sideSet(mesh, {group});
        if (std::includes(held.begin(), held.end(), own.begin(), own.end())) found.push_back(group);
      }
      return found;
    };
    for (const ContactSurface& contact : contacts)
      for (const auto& [face, side] : {std::make_pair(&contact.a, "Side A"), std::make_pair(&contact.b, "Side B")})
        for (const std::string& group : heldAmong(face->groups))
          problems.add(contact.path + "/" + side, "'" + group + "' is held on its whole " + (mesh.dimension == 2 ? "length" : "area") +
                                                      " by " + holding.path + "; a side is either held or in contact");
    for (const Condition& load : conditions) {
      if (holding.type != Condition::Type::Displacement || load.holds()) continue;
      for (const std::string& group : heldAmong(load.groups))
        problems.add(load.path + "/Group",
                     "all displacements of '" + group + "' are prescribed by " + holding.path + ": no load can act there");
    }
  }
}

// Contact nodes in one contact and without prescribed components get the pair's axes, or the mean of several pairs (mortar).
void addContactFrames(int dimension, const std::vector<ContactPair>& pairs, std::vector<NodeRule>& rules) {
  struct Use {
    int pairs = 0, contact = -1;
    bool oneContact = true;
    Point last{0, 0, 0}, sum{0, 0, 0};  // normal of the last pair; weighted sum over all pairs
  };
  std::map<int, Use> uses;
  for (const ContactPair& pair : pairs)
    for (const PairEnd& end : pair.ends) {
      Use& use = uses[end.node];
      use.oneContact = use.oneContact && (use.pairs == 0 || use.contact == pair.line);
      use.contact = pair.line;
      use.last = pair.normal;
      ++use.pairs;
      for (int k = 0; k < 3; ++k) use.sum[k] += std::abs(end.weight) * pair.normal[k];
    }
  std::set<int> ruled;
  for (const NodeRule& rule : rules) ruled.insert(rule.node);
  for (const auto& [node, use] : uses) {
    if (!use.oneContact || ruled.count(node)) continue;
    NodeRule rule;
    rule.node = node;
    const std::vector<Point> frame = pairFrame(use.pairs == 1 ? use.last : unit(use.sum), dimension);
    std::copy(frame.begin(), frame.end(), rule.axes.begin());
    rules.push_back(rule);
  }
  std::sort(rules.begin(), rules.end(), [](const NodeRule& x, const NodeRule& y) { return x.node < y.node; });
}

std::vector<SpringDirection> springsOf(const Mesh& mesh, const std::vector<Condition>& conditions) {
  std::vector<SpringDirection> springs;
  for (const Condition& condition : conditions) {
    if (condition.type != Condition::Type::ElasticSupport) continue;
    for (const Side& side : sidesOf(mesh.sideGroups, condition.groups)) {
      const std::vector<int> nodes = mesh.nodesOf(side);
      std::vector<Point> points;
      for (const int node : nodes) points.push_back(mesh.point(node));
      const std::vector<NodeNormal> normals = nodeNormals(points, mesh.dimension);
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const std::vector<Point> frame = pairFrame(unit(normals[i].density), mesh.dimension);
        for (std::size_t k = 0; k < frame.size(); ++k)
          if ((k == 0 ? condition.normal : condition.tangential) > 0.0) springs.push_back({side.element, nodes[i], frame[k]});
      }
    }
  }
  return springs;
}

// Reports bodies that no condition and no contact holds.
void checkHeld(const Mesh& mesh, const std::vector<Condition>& conditions, const Constraints& constraints, Problems& problems) {
  std::vector<char> held(mesh.bodies.size(), 0);
  const RigidGroupNodes rigid(constraints.rigidGroups, mesh.dimension);
  for (const NodeRule& rule : constraints.rules)  // so far from boundary conditions only
    if (!rigid.moves(rule.node)) held[mesh.bodyOfNode[rule.node]] = 1;
  for (const RigidGroup& group : constraints.rigidGroups)
    if (group.masters() < rigidMotions(mesh.dimension)) held[mesh.bodyOfNode[group.nodes.front()]] = 1;
  for (const SpringDirection& spring : constraints.springs) held[mesh.bodyOfNode[spring.node]] = 1;
  for (const Condition& condition : conditions)
    if (condition.type == Condition::Type::MeanDisplacement)
      for (const Side& side : sidesOf(mesh.sideGroups, condition.groups)) held[mesh.bodyOfElement[side.element]] = 1;
  for (const ContactPiece& piece : constraints.pieces) {
    if (piece.isWithinOneBody) continue;
    for (const int body : piece.bodies) held[body] = 1;
  }
  for (std::size_t body = 0; body < mesh.bodies.size(); ++body)
    if (!held[body])
      problems.add(
          "Bodies/" + mesh.bodies[body],
          "nothing holds this body: no Displacement, Bilateral, Elastic Support or Mean Displacement condition and no contact is on its "
          "boundary");
}

/// Shifts the gaps of a softened contact to the overclosure at which its spring begins.
void soften(const ContactSurface& contact, PairedSurface& paired, std::vector<std::string>& notes) {
  for (ContactPair& pair : paired.pairs) pair.gap += contact.ownSpring().begin;
  if (!contact.overclosure->note().empty()) notes.push_back("contact '" + contact.name + "': " + contact.overclosure->note());
}

/// Holds the outer nodes of coatings along the directions in which the nodes under them are held, on sides that are held along the coating
/// only, as by a symmetry plane.
void holdCoatings(const Mesh& mesh, Constraints& constraints) {
  std::map<int, const NodeRule*> ruleOf;
  for (const NodeRule& rule : constraints.rules) ruleOf[rule.node] = &rule;
  const RigidGroupNodes rigid(constraints.rigidGroups, mesh.dimension);
  std::map<int, std::pair<int, bool>> held;  // outer node -> inner node, held along the coating only
  for (const Coating& coating : mesh.coatings) {
    const std::vector<int> inner = mesh.innerNodes(coating);
    std::vector<Point> points;
    for (const int node : inner) points.push_back(mesh.point(node));
    const std::vector<NodeNormal> normals = nodeNormals(points, mesh.dimension);
    for (std::size_t i = 0; i < inner.size(); ++i) {
      const auto rule = ruleOf.find(inner[i]);
      if (rule == ruleOf.end() || rigid.contains(inner[i])) continue;
      bool isAlong = true;
      for (int k = 0; k < mesh.dimension; ++k) {
        const NodeRule& own = *rule->second;
        if (own.fixed[k]) isAlong = isAlong && own.value[k] == 0.0 && std::abs(dot(own.axes[k], unit(normals[i].density))) < kAlongCoating;
      }
      bool& all = held.try_emplace(mesh.outerNodes(coating)[i], inner[i], true).first->second.second;
      all = all && isAlong;
    }
  }
  std::vector<NodeRule> rules;
  std::vector<Support> supports;
  for (const auto& [outer, source] : held) {
    if (!source.second) continue;
    rules.push_back(*ruleOf.at(source.first));
    rules.back().node = outer;
    for (const Support& support : constraints.supports)
      if (support.node == source.first) supports.push_back(support), supports.back().node = outer;
  }
  constraints.rules.insert(constraints.rules.end(), rules.begin(), rules.end());  // outer nodes have the highest numbers
  constraints.supports.insert(constraints.supports.end(), supports.begin(), supports.end());
}

/// Multipliers of a mortar on a rigid side with more nodes than the other side would be redundant: the deformable side carries them.
void chooseCarrier(const Mesh& mesh, const RigidGroupNodes& rigid, ContactSurface& contact) {
  using Carrier = ContactSurface::Carrier;
  if (rigid.empty() || contact.carrier != Carrier::Automatic) return;
  const auto isRigid = [&](const ContactFace& face) {
    const std::vector<Side> sides = sidesOf(mesh.sideGroups, face.groups);
    return !sides.empty() && std::all_of(sides.begin(), sides.end(), [&](const Side& side) {
      const std::vector<int> nodes = mesh.nodesOf(side);
      return std::all_of(nodes.begin(), nodes.end(), [&](int node) { return rigid.contains(node); });
    });
  };
  const bool a = isRigid(contact.a), b = isRigid(contact.b);
  if (a != b) contact.carrier = a ? Carrier::SideB : Carrier::SideA;
}

Constraints build(const Mesh& mesh, const std::vector<Condition>& conditions, std::vector<ContactSurface> contacts,
                  const ContactScales& scales, KeptChoices* choices, Problems& problems) {
  const bool isLater = !mesh.drawn.empty();
  for (ContactSurface& contact : contacts) {
    for (ContactFace* face : {&contact.a, &contact.b}) face->compliance = complianceOf(mesh, *face, scales);
    if (choices) contact.choices = &(*choices)[contact.number];
  }
  checkRoles(mesh, conditions, contacts, problems);

  Constraints constraints;
  constraints.rules = nodalRules(mesh, conditions, problems, constraints.supports, constraints.prescribed);
  buildRigidGroups(mesh, conditions, constraints, problems);
  for (const Condition& condition : conditions) constraints.conditions.push_back(condition.name);
  constraints.springs = springsOf(mesh, conditions);
  constraints.parts = boundaryParts(mesh, conditions, contacts);
  holdCoatings(mesh, constraints);
  const RigidGroupNodes rigid(constraints.rigidGroups, mesh.dimension);
  std::vector<PairedSurface> paired;
  for (ContactSurface& contact : contacts) {
    if (!contact.b.groups.empty() && !contact.overclosure) chooseCarrier(mesh, rigid, contact);
    std::vector<std::string> known;  // notes and problems of the first spring
    Problems same;
    const bool isFirst = contact.spring == 0;
    std::vector<std::string>& notes = isFirst ? constraints.notes : known;
    paired.push_back(pairSurface(mesh, contact, isFirst && !isLater ? problems : same, notes));
    noteInterference(contact, paired.back(), scales.lengthUnit, notes);
    noteDistance(contact, paired.back(), scales.lengthUnit, notes);
    if (contact.overclosure) soften(contact, paired.back(), notes);
    const int base = static_cast<int>(constraints.pairs.size());
    for (ContactPair pair : paired.back().pairs) {
      pair.id += base;
      constraints.pairs.push_back(pair);
    }
  }
  problems.throwIfAny();

  constraints.pieces = findPieces(mesh, contacts, paired, constraints.pairs);
  estimatePressures(contacts, paired, constraints);
  findOpenEnds(mesh, conditions, contacts, constraints);
  checkHeld(mesh, conditions, constraints, problems);
  problems.throwIfAny();
  addContactFrames(mesh.dimension, constraints.pairs, constraints.rules);
  return constraints;
}

std::vector<Condition> prepared(std::vector<Condition> conditions, const LoadSteps& steps, const ConditionChange& change) {
  for (Condition& condition : conditions) {
    condition.factor = steps.factorOf(condition.name);
    if (change) change(condition);
  }
  return conditions;
}

}  // namespace

Schema contactSchema() { return contactSchema(Frictionless::kName, Registry<ContactLaw>::instance().schemas()); }

Constraints buildConstraints(const Mesh& mesh, const std::vector<Condition>& conditions, const std::vector<Contact>& contacts,
                             const ContactScales& scales, const LoadSteps& steps, const ConditionChange& change, KeptChoices* choices) {
  Problems problems;
  const std::vector<Condition> sound = prepared(conditionsOn(mesh, conditions, problems), steps, change);
  return build(mesh, sound, contactsOn(mesh, contacts, problems), scales, choices, problems);
}

Constraints buildConstraints(const Mesh& mesh, const Parameters& conditionList, const Parameters& contactList, const Constants& constants,
                             const ContactScales& scales, const LoadSteps& steps, const ConditionChange& change, KeptChoices* choices) {
  Problems problems;
  Constants known = constants;
  known.dimension = mesh.dimension;
  const std::vector<Condition> sound = prepared(readConditions(mesh, conditionList, known, problems), steps, change);
  return build(mesh, sound, readContact(mesh, contactList, known, problems), scales, choices, problems);
}

namespace {

constexpr double kParallel = 1e-9;  // 1 - cosine of the angle between axes that count as the same
constexpr double kTangent = 0.5;    // shortest tangential part of an axis that counts as tangential
constexpr double kSameValue = 32.0 * std::numeric_limits<double>::epsilon();  // difference of values that is round-off, relative to places

/// Rules by which nodes are held, and the rigid groups whose nodes follow others.
struct Holds {
  std::vector<const NodeRule*> ruleOf;  // by node
  RigidGroupNodes groups;
  int dimension;

  /// Rule of a node that prescribes its displacement along an axis of the rule; null: it does not, or the displacement follows from others.
  const NodeRule* fixing(int node, int axis) const {
    const NodeRule* rule = ruleOf[static_cast<std::size_t>(node)];
    bool follows = false;
    if (rule && rule->fixed[static_cast<std::size_t>(axis)]) groups.forEachMaster(node, axis, [&](int, int, double) { follows = true; });
    return rule && rule->fixed[static_cast<std::size_t>(axis)] && !follows ? rule : nullptr;
  }
  /// True if the displacement of a node along an axis, in either sense, is prescribed with this value. [length] \param within  difference
  /// that is round-off [length]
  bool fixes(int node, const Point& axis, double value, double within) const {
    for (int k = 0; k < dimension; ++k) {
      const NodeRule* rule = fixing(node, k);
      if (!rule) continue;
      const double along = dot(rule->axes[static_cast<std::size_t>(k)], axis);
      if (std::abs(along) > 1.0 - kParallel &&
          std::abs(rule->value[static_cast<std::size_t>(k)] - (along > 0.0 ? value : -value)) <= within)
        return true;
    }
    return false;
  }
};

/// Tangents along which the carrying node and a node of the other side are held alike. \param ofTime  values change with time
std::vector<Point> stillDirections(const ContactPair& pair, const Holds& holds, const Mesh& mesh, bool ofTime) {
  std::vector<Point> still;
  for (int k = 0; k < holds.dimension; ++k) {
    const NodeRule* own = holds.fixing(pair.node(), k);
    if (!own) continue;
    const Point& axis = own->axes[static_cast<std::size_t>(k)];
    const double value = own->value[static_cast<std::size_t>(k)], within = kSameValue * (std::abs(value) + norm(mesh.point(pair.node())));
    if (ofTime && value != 0.0) continue;
    Point held = minus(axis, scaled(dot(axis, pair.normal), pair.normal));
    for (const Point& other : still) held = minus(held, scaled(dot(held, other), other));
    if (norm(held) < kTangent) continue;
    const auto alike = [&](const PairEnd& end) { return holds.fixes(end.node, axis, value, within); };
    if (std::any_of(pair.ends.begin() + pair.own, pair.ends.end(), alike)) still.push_back(scaled(1.0 / norm(held), held));
  }
  return still;
}

}  // namespace

void applyLaws(const ContactLaws& laws, const Mesh& mesh, const std::vector<NodeRule>& rules, Constraints& constraints) {
  constraints.laws = laws;
  Holds holds{{}, RigidGroupNodes(constraints.rigidGroups, mesh.dimension), mesh.dimension};
  if (laws.restrictSliding()) {
    holds.ruleOf.assign(static_cast<std::size_t>(mesh.nodes()), nullptr);
    for (const NodeRule& rule : rules) holds.ruleOf[static_cast<std::size_t>(rule.node)] = &rule;
  }
  for (ContactPiece& piece : constraints.pieces) {
    const auto isGlued = [&](int id) { return laws.of(constraints.pairs[static_cast<std::size_t>(id)].line).ignoresGap(); };
    if (std::all_of(piece.pairs.begin(), piece.pairs.end(), isGlued)) piece.pressureDoubt = 0.0;  // it is an error of the gaps
  }
  for (ContactPair& pair : constraints.pairs) {
    const ContactLaw& law = laws.of(pair.line);
    if (law.ignoresGap()) pair.gap = 0.0;
    if (law.rows(mesh.dimension) > 1) pair.still = stillDirections(pair, holds, mesh, !constraints.prescribed.empty());
  }
}

void applyLaws(const ContactLaws& laws, const Mesh& mesh, Constraints& constraints) {
  applyLaws(laws, mesh, constraints.rules, constraints);
}

Matrix axesOf(const NodeRule& rule, int dimension) {
  Matrix q(dimension, dimension);
  for (int row = 0; row < dimension; ++row)
    for (int column = 0; column < dimension; ++column) q(row, column) = rule.axes[row][column];
  return q;
}

}  // namespace suture
