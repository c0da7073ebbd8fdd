#include <suture/answer/bound/ContactNodes.hpp>
#include <suture/answer/bound/ContactPressures.hpp>
#include <suture/answer/bound/ContactTractions.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Gather.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/SideGeometry.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace suture {

namespace {

// Differences of the normals of a side's nodes that are round-off.
constexpr double kSameNormal = 1e-8;

/// Normal force of a pair in the balanced field.
struct BalancedForce {
  int id = -1;
  double force = 0.0;

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.id), each(self.force);
  }
};

/// Traction on a side, as sent from rank 0.
struct SideTraction {
  int rank = -1, number = -1;
  int isUnknown = 0;
  std::array<Point, 6> values{};

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.rank), each(self.number), each(self.isUnknown), each(self.values);
  }
};

/// The tractions of one contact, on rank 0.
class OneContact {
 public:
  OneContact(const TouchingSides& contact, int dimension, int degree) : contact_(contact), dimension_(dimension), degree_(degree) {}

  void add(const TouchingSide& side) { (side.onA ? a_ : b_).push_back(&side); }
  void add(const TouchingPair& pair, const PairResult& result) {
    isUnilateral_ = isUnilateral_ && pair.isUnilateral;
    isSimple_ = isSimple_ && pair.isSimple;
    pairs_.push_back({pair, result});
  }

  void find(ContactTractions& all, std::vector<SideTraction>& tractions, std::set<std::string>& reasons) {
    const std::string problem = findTractions(all, tractions);
    if (problem.empty()) return;
    reasons.insert("contact '" + contact_.contact + "': " + problem);
    for (const auto* list : {&a_, &b_})
      for (const TouchingSide* side : *list) tractions.push_back({side->rank, side->number, 1});
  }

 private:
  using Sides = ContactNodes::Sides;
  int sideNodes() const { return degree_ == 1 ? dimension_ : dimension_ * (dimension_ + 1) / 2; }

  /// Returns the reason if there are none.
  std::string findTractions(ContactTractions& all, std::vector<SideTraction>& tractions) {
    if (contact_.isSoft) return "it is softened";
    if (!isUnilateral_) return "it has friction, or does not separate";
    if (contact_.isInterpolated) return "its gap varies between the nodes";
    if (!isSimple_ && contact_.groupsB.empty()) return "conditions on an obstacle involve several nodes";
    ContactNodes nodes(sideNodes(), a_, b_);
    if (isSimple_)
      nodes.addPairs(pairs_);
    else if (const std::string mismatch = nodes.addPlaces(pairs_); !mismatch.empty())
      return mismatch;
    Sides pressed, others;
    PressedSides sides;
    const std::string problem = collect(nodes, sides, pressed, others);
    if (!problem.empty()) return problem;
    const Pressures pressures = admissiblePressures(sides);
    if (!pressures.feasible) return "its nodal forces are not those of any pressure";
    addTractions(nodes, pressed, others, pressures, tractions);
    addGap(nodes, sides, pressures, all);
    addRests(nodes, pressures, all);
    return "";
  }

  std::string collect(const ContactNodes& nodes, PressedSides& sides, Sides& pressed, Sides& others) const {
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

  void addTractions(const ContactNodes& nodes, const Sides& pressed, const Sides& others, const Pressures& pressures,
                    std::vector<SideTraction>& tractions) const {
    for (std::size_t s = 0; s < pressed.size(); ++s) {
      SideTraction own{pressed[s]->rank, pressed[s]->number};
      const Point& normal = nodes.all()[nodes.indexOf(pressed[s]->nodes[0])].normal;
      for (int j = 0; j < sideNodes(); ++j) own.values[j] = scaled(-pressures.values(j, int(s)), normal);
      tractions.push_back(own);
      if (others.empty()) continue;
      SideTraction other{others[s]->rank, others[s]->number};
      const double sizes = pressed[s]->size / others[s]->size;  // the sides need not be parallel
      for (int j = 0; j < sideNodes(); ++j) {
        const GlobalId partner = nodes.all()[nodes.indexOf(pressed[s]->nodes[j])].b;
        for (int i = 0; i < sideNodes(); ++i)
          if (others[s]->nodes[i] == partner) other.values[i] = scaled(-sizes, own.values[j]);
      }
      tractions.push_back(other);
    }
  }

  /// Lifts the sides out of each other: first their nodes, then the middles of their edges until the polynomial gap is nowhere negative.
  void addGap(const ContactNodes& nodes, const PressedSides& sides, const Pressures& pressures, ContactTractions& all) const {
    std::vector<double> heights;
    for (const ContactNode& node : nodes.all()) heights.push_back(std::max(0.0, -node.gap));
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
      if (!(heights[i] > 0.0)) continue;
      const ContactNode& node = nodes.all()[i];
      // The energy of both lifts together is least if they are as their compliances.
      const double ofA = node.b < 0 ? 1.0 : stiffness.at(node.b) / (stiffness.at(node.a) + stiffness.at(node.b));
      move(all.lifts[node.a], -ofA * heights[i], node.normal);
      if (node.b >= 0) move(all.lifts[node.b], (1.0 - ofA) * heights[i], node.normal);
      all.liftWork += node.force * heights[i];
    }
    all.gapWork += 2 * gapWork(sides, pressures.values, gapsOf(std::vector<double>(heights.size(), 0.0)));
    all.liftedGapWork += 2 * std::max(0.0, gapWork(sides, pressures.values, gapsOf(heights)));
  }

  static void move(Point& place, double by, const Point& direction) { place = plus(place, scaled(by, direction)); }

  std::map<GlobalId, double> nodalStiffness() const {
    std::map<GlobalId, double> all;
    for (const Sides* sides : {&a_, &b_})
      for (const TouchingSide* side : *sides)
        for (int j = 0; j < sideNodes(); ++j) all[side->nodes[j]] = std::max(all[side->nodes[j]], side->stiffness);
    return all;
  }

  void addRests(const ContactNodes& nodes, const Pressures& pressures, ContactTractions& all) const {
    for (const std::vector<int>& cluster : pressures.clusters) {
      UnbalancedForces onA, onB;
      for (const int i : cluster) {
        const ContactNode& node = nodes.all()[i];
        if (pressures.rest[i] == 0.0) continue;
        onA.nodes.push_back(node.a);
        onA.forces.push_back(scaled(pressures.rest[i], node.normal));
        if (node.b < 0) continue;
        onB.nodes.push_back(node.b);
        onB.forces.push_back(scaled(-pressures.rest[i], node.normal));
      }
      if (!onA.nodes.empty()) all.rests.push_back(std::move(onA));
      if (!onB.nodes.empty()) all.rests.push_back(std::move(onB));
    }
  }

  const TouchingSides& contact_;
  int dimension_, degree_;
  bool isUnilateral_ = true, isSimple_ = true;
  Sides a_, b_;
  std::vector<ContactNodes::Pair> pairs_;
};

template <int D>
std::vector<TouchingSide> sidesHere(const Comm& comm, const BoundedSolution& solution, const BoundParts<D>& parts) {
  using Nodes = SimplexNodes<D>;
  std::vector<TouchingSide> all;
  const auto add = [&](int contact, int number, bool onA) {
    TouchingSide side{contact, comm.getRank(), number, int(onA)};
    const PlaceOfSide& place = parts.places[number];
    const SubdomainMesh& mesh = solution.meshes[place.mesh];
    const BoundElement<D>& element = parts.elements[parts.ofMesh[place.mesh][place.element]];
    const Span<const int> nodes = mesh.nodesOf(place.element);
    const CellInfo& cell = cellInfo(mesh.cells[place.element]);
    const auto local = [&](GlobalId id) {
      return int(std::find_if(nodes.begin(), nodes.end(), [&](int n) { return mesh.globalNodes[n] == id; }) - nodes.begin());
    };
    for (int j = 0; j < Nodes::sideNodes(parts.degree); ++j) {
      const int node = Nodes::ofSide(place.opposite, j);
      int at = 0;
      if (node <= D) {
        at = nodes[local(element.vertices[node])];
      } else {
        const int a = local(element.vertices[Nodes::ends[node - D - 1][0]]), b = local(element.vertices[Nodes::ends[node - D - 1][1]]);
        for (std::size_t i = 0; i < cell.edges.size(); ++i)
          if ((cell.edges[i][0] == a && cell.edges[i][1] == b) || (cell.edges[i][0] == b && cell.edges[i][1] == a))
            at = nodes[cell.vertices + int(i)];
      }
      side.nodes[j] = mesh.globalNodes[at];
      side.places[j] = mesh.point(at);
      for (int k = 0; k < D; ++k) side.moved[j][k] = mesh.total(solution.displacement[place.mesh], D * Eigen::Index(at) + k);
    }
    const Point first = minus(side.places[1], side.places[0]);
    Point normal = D == 2 ? Point{first[1], -first[0], 0} : cross(first, minus(side.places[2], side.places[0]));
    side.size = D == 2 ? norm(normal) : norm(normal) / 2;
    Point opposite{0, 0, 0};
    for (int k = 0; k < D; ++k) opposite[k] = element.places(k, place.opposite);
    if (dot(normal, minus(side.places[0], opposite)) < 0) normal = scaled(-1.0, normal);
    side.normal = unit(normal);
    side.stiffness = 1.0 / element.compliance.diagonal().minCoeff();
    all.push_back(side);
  };
  for (std::size_t i = 0; i < parts.onA.size(); ++i) {
    for (const int number : parts.onA[i]) add(int(i), number, true);
    for (const int number : parts.onB[i]) add(int(i), number, false);
  }
  return all;
}

/// The tractions of all contacts, on rank 0. \param kind  dimension and degree
void findAll(const BoundedSolution& solution, const BoundaryParts& contacts, std::array<int, 2> kind,
             const std::vector<TouchingSide>& sides, const std::vector<TouchingPair>& pairs, const std::vector<BalancedForce>& forces,
             ContactTractions& result, std::vector<SideTraction>& tractions, std::set<std::string>& reasons) {
  std::vector<OneContact> all;
  std::map<int, std::size_t> ofLine;
  for (std::size_t i = 0; i < contacts.touching.size(); ++i) {
    all.emplace_back(contacts.touching[i], kind[0], kind[1]);
    ofLine[contacts.touching[i].line] = i;
  }
  for (const TouchingSide& side : sides) all[side.contact].add(side);
  std::map<int, const TouchingPair*> byId;
  for (const TouchingPair& pair : pairs) byId[pair.id] = &pair;
  std::map<int, PairResult> resultOf;
  for (const PairResult& own : solution.pairs) resultOf[own.id] = own;
  for (const BalancedForce& own : forces)
    if (resultOf.count(own.id)) resultOf[own.id].force = own.force;
  for (const auto& [id, pair] : byId) {
    const auto line = ofLine.find(pair->line);
    if (line != ofLine.end() && resultOf.count(id)) all[line->second].add(*pair, resultOf.at(id));
  }
  for (OneContact& contact : all) contact.find(result, tractions, reasons);
}

/// The same on all ranks. Collective. \param reasons  on rank 0
ContactTractions agreedTractions(const Comm& comm, const BoundedSolution& solution, const BoundaryParts& contacts, std::array<int, 2> kind,
                                 const std::vector<TouchingSide>& sidesHere, std::vector<SideTraction>& tractions,
                                 std::set<std::string>& reasons) {
  ContactTractions result;
  std::vector<TouchingPair> pairsHere;
  for (const SubdomainMesh& mesh : solution.meshes)
    for (const ContactRow& row : mesh.contactRows) pairsHere.push_back(touchingPair(row));
  std::vector<BalancedForce> forcesHere;
  if (solution.balancing)
    for (const auto& [id, force] : solution.balancing->forces) forcesHere.push_back({id, force.force});
  const std::vector<TouchingSide> sides = joinOnRoot(comm, sidesHere);
  const std::vector<TouchingPair> pairs = joinOnRoot(comm, pairsHere);
  const std::vector<BalancedForce> forces = joinOnRoot(comm, forcesHere);
  collectivelyOnRoot(comm, "finding contact pressures",
                     [&] { findAll(solution, contacts, kind, sides, pairs, forces, result, tractions, reasons); });
  Packer packer;
  packer.put(tractions);
  packer.put(result.lifts);
  packer.put(result.gapWork);
  packer.put(result.liftedGapWork);
  packer.put(result.liftWork);
  packer.put(static_cast<int>(result.rests.size()));
  for (const UnbalancedForces& rest : result.rests) packer.put(rest.nodes), packer.put(rest.forces);
  Unpacker unpacker(broadcast(comm, packer.bytes()));
  unpacker.get(tractions);
  unpacker.get(result.lifts);
  unpacker.get(result.gapWork);
  unpacker.get(result.liftedGapWork);
  unpacker.get(result.liftWork);
  result.rests.resize(static_cast<std::size_t>(unpacker.get<int>()));
  for (UnbalancedForces& rest : result.rests) unpacker.get(rest.nodes), unpacker.get(rest.forces);
  return result;
}

}  // namespace

template <int D>
ContactTractions contactTractions(const Comm& comm, const BoundedSolution& solution, const BoundaryParts& contacts, BoundParts<D>& parts) {
  if (contacts.touching.empty()) return {};
  std::vector<SideTraction> tractions;
  ContactTractions result =
      agreedTractions(comm, solution, contacts, {D, parts.degree}, sidesHere(comm, solution, parts), tractions, parts.reasons);
  for (const SideTraction& own : tractions) {
    if (own.rank != comm.getRank()) continue;
    SideCondition<D>& side = parts.boundary[own.number];
    if (own.isUnknown) {
      side.known = 0;
      continue;
    }
    for (int j = 0; j < SimplexNodes<D>::sideNodes(parts.degree); ++j)
      for (int k = 0; k < D; ++k) side.traction(k, j) += own.values[j][k];
  }
  return result;
}

template ContactTractions contactTractions(const Comm&, const BoundedSolution&, const BoundaryParts&, BoundParts<2>&);
template ContactTractions contactTractions(const Comm&, const BoundedSolution&, const BoundaryParts&, BoundParts<3>&);

}  // namespace suture
