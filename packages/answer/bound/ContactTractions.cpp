#include <suture/answer/bound/AdmissibleContact.hpp>
#include <suture/answer/bound/ContactSides.hpp>
#include <suture/answer/bound/ContactTractions.hpp>
#include <suture/answer/bound/LinearPressures.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Gather.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <optional>
#include <set>
#include <sstream>

namespace suture {

namespace {

/// Forces of a pair in the balanced field.
struct BalancedForce {
  int id = -1;
  double force = 0.0, bound = 0.0;  // the second: largest tangential force
  Point tangential{0, 0, 0};

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.id), each(self.force), each(self.bound), each(self.tangential);
  }
};

/// The tractions of all contacts, on rank 0. \param kind  dimension and degree
void findAll(const BoundedSolution& solution, const BoundaryParts& contacts, const ContactLaws& laws, std::array<int, 2> kind,
             const std::vector<TouchingSide>& sides, const std::vector<TouchingPair>& pairs, const std::vector<BalancedForce>& forces,
             ContactTractions& result, std::vector<SideTraction>& tractions, std::set<std::string>& reasons) {
  std::vector<AdmissibleContact> all;
  std::map<int, std::size_t> ofLine;
  for (std::size_t i = 0; i < contacts.touching.size(); ++i) {
    const int line = contacts.touching[i].line;
    all.emplace_back(contacts.touching[i], kind[0], kind[1], laws.of(line));
    ofLine[line] = i;
  }
  for (const TouchingSide& side : sides) all[side.contact].add(side);
  std::map<int, const TouchingPair*> byId;
  for (const TouchingPair& pair : pairs) byId[pair.id] = &pair;
  std::map<int, ContactNodes::Pair> resultOf;
  for (const PairResult& own : solution.pairs) resultOf[own.id] = {{}, own, own.tangential, own.bound};
  for (const BalancedForce& own : forces) {
    const auto found = resultOf.find(own.id);
    if (found == resultOf.end()) continue;
    PairResult& result = found->second.result;
    result.force = own.force;
    if (result.isBounded()) result.bound = result.state.largest(own.force);
    found->second.tangential = own.tangential;
    found->second.bound = own.bound;
  }
  for (const auto& [id, pair] : byId) {
    const auto line = ofLine.find(pair->line);
    const auto found = resultOf.find(id);
    if (line == ofLine.end() || found == resultOf.end()) continue;
    found->second.pair = *pair;
    all[line->second].add(found->second);
  }
  for (AdmissibleContact& contact : all) contact.find(result, tractions, reasons);
  if (result.boundChange < 0.0) return;
  std::ostringstream text;
  text << std::scientific << std::setprecision(1) << result.boundChange;
  reasons.insert(
      "friction: proved for given bounds of the friction stress, which differ from those of the contact laws for the forces of "
      "this solution by " +
      text.str() + " of their sum");
}

/// The same on all ranks. Collective. \param reasons  on rank 0
ContactTractions agreedTractions(const Comm& comm, const BoundedSolution& solution, const BoundaryParts& contacts, const ContactLaws& laws,
                                 std::array<int, 2> kind, const std::vector<TouchingSide>& sidesHere, std::vector<SideTraction>& tractions,
                                 std::set<std::string>& reasons) {
  ContactTractions result;
  std::vector<TouchingPair> pairsHere;
  for (const SubdomainMesh& mesh : solution.meshes)
    for (const ContactRow& row : mesh.contactRows) pairsHere.push_back(touchingPair(row));
  std::vector<BalancedForce> forcesHere;
  if (solution.balancing)
    for (const auto& [id, force] : solution.balancing->forces)
      forcesHere.push_back({id, force.force, force.state.largest(force.force), force.tangential});
  const std::vector<TouchingSide> sides = joinOnRoot(comm, sidesHere);
  const std::vector<TouchingPair> pairs = joinOnRoot(comm, pairsHere);
  const std::vector<BalancedForce> forces = joinOnRoot(comm, forcesHere);
  collectivelyOnRoot(comm, "finding contact pressures",
                     [&] { findAll(solution, contacts, laws, kind, sides, pairs, forces, result, tractions, reasons); });
  Packer packer;
  packer.put(tractions);
  packer.put(result.lifts);
  packer.put(result.gapWork);
  packer.put(result.liftedGapWork);
  packer.put(result.liftWork);
  packer.put(result.frictionEnergy);
  packer.put(result.layerWork);
  packer.put(result.layerEnergy);
  packer.put(result.layerLift);
  packer.put(result.boundChange);
  packer.put(static_cast<int>(result.rests.size()));
  for (const UnbalancedForces& rest : result.rests) packer.put(rest.nodes), packer.put(rest.forces);
  Unpacker unpacker(broadcast(comm, packer.bytes()));
  unpacker.get(tractions);
  unpacker.get(result.lifts);
  unpacker.get(result.gapWork);
  unpacker.get(result.liftedGapWork);
  unpacker.get(result.liftWork);
  unpacker.get(result.frictionEnergy);
  unpacker.get(result.layerWork);
  unpacker.get(result.layerEnergy);
  unpacker.get(result.layerLift);
  unpacker.get(result.boundChange);
  result.rests.resize(static_cast<std::size_t>(unpacker.get<int>()));
  for (UnbalancedForces& rest : result.rests) unpacker.get(rest.nodes), unpacker.get(rest.forces);
  return result;
}

}  // namespace

template <int D>
ContactTractions contactTractions(const Comm& comm, const BoundedSolution& solution, const BoundaryParts& contacts, const ContactLaws& laws,
                                  BoundParts<D>& parts) {
  if (contacts.touching.empty()) return {};
  std::vector<SideTraction> tractions;
  ContactTractions result = agreedTractions(comm, solution, contacts, laws, {D, parts.kind.order},
                                            touchingSides(comm, solution, contacts, parts), tractions, parts.reasons);
  for (const SideTraction& own : tractions) {
    if (own.rank != comm.getRank()) continue;
    SideCondition<D>& side = parts.boundary[own.number];
    if constexpr (D == 3)
      if (own.replaced != LinearTraction{}) replaceLinearTraction(solution, parts.places[own.number], own.replaced, parts);
    if (own.isUnknown) {
      side.known = 0;
      continue;
    }
    for (int j = 0; j < SimplexNodes<D>::sideNodes(parts.kind.order); ++j)
      for (int k = 0; k < D; ++k) side.traction(k, j) += own.values[j][k];
  }
  return result;
}

template ContactTractions contactTractions(const Comm&, const BoundedSolution&, const BoundaryParts&, const ContactLaws&, BoundParts<2>&);
template ContactTractions contactTractions(const Comm&, const BoundedSolution&, const BoundaryParts&, const ContactLaws&, BoundParts<3>&);

}  // namespace suture
