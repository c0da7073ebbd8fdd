#include <suture/base/Errors.hpp>
#include <suture/interface/InterfaceSpace.hpp>

#include <Tpetra_Map.hpp>

#include <algorithm>
#include <map>

namespace suture {

/// Takes the entities of the layout; an unknown of more than two local problems that is in none of them is a vertex.
void InterfaceSpace::addEntities(const InterfaceLayout& layout) {
  const auto placesOf = [&](const std::vector<GlobalId>& ids) {
    std::vector<int> places;
    for (const GlobalId id : ids)
      if (const int place = overlap_->getLocalElement(id); place >= 0) places.push_back(place);
    return places;
  };
  for (const InterfaceLayout::Entity& entity : layout.entities) {
    InterfaceEntity own{entity.kind, entity.sharers, placesOf(entity.unknowns), placesOf(entity.ends), false};
    if (!own.unknowns.empty()) entities_.own().push_back(std::move(own));
  }
  const std::vector<int> entityOf = entityOfPlaces();
  for (int place = 0; place < overlapSize(); ++place)
    if (sharers(place).size() > 2 && entityOf[place] < 0)
      entities_.own().push_back({EntityKind::Vertex, sharers(place), {place}, {}, false});
  entities_.own().shrink_to_fit();
}

std::vector<int> InterfaceSpace::entityOfPlaces() const {
  std::vector<int> entityOf(ownedRows_->size(), -1);
  for (std::size_t e = 0; e < entities_->size(); ++e)
    for (const int place : entities()[e].unknowns) entityOf[place] = static_cast<int>(e);
  return entityOf;
}

/// Removes unknowns from their entities.
void InterfaceSpace::leaveEntities(const std::vector<char>& leaves) {
  if (std::find(leaves.begin(), leaves.end(), 1) == leaves.end()) return;
  const auto gone = [&](int place) { return leaves[place] != 0; };
  std::vector<InterfaceEntity>& all = entities_.own();
  for (InterfaceEntity& entity : all)
    for (std::vector<int>* places : {&entity.unknowns, &entity.ends})
      places->erase(std::remove_if(places->begin(), places->end(), gone), places->end());
  const auto empty = [](const InterfaceEntity& entity) { return entity.unknowns.empty(); };
  all.erase(std::remove_if(all.begin(), all.end(), empty), all.end());
}

std::shared_ptr<const InterfaceSpace> InterfaceSpace::related(std::vector<InterfaceRelation> relations,
                                                              const std::vector<std::vector<int>>& neighbours) const {
  if (!relations_.empty()) throw InternalError("the space has relations already");
  std::vector<InterfaceRelation> plain;
  std::vector<int> inRows;  // unknowns of relations that are not plain
  std::vector<char> expressed(ownedRows_->size(), 0), named(ownedRows_->size(), 0);
  for (const InterfaceRelation& relation : relations)
    if (relation.others.size() > 1)
      for (const int other : relation.others) named[other] = 1;
  for (const InterfaceRelation& relation : relations) {
    // On a mortar, rows of opposite nodes are rows like the others.
    if (relation.others.size() < 2 && (relation.others.empty() || !named[relation.others[0]])) {
      plain.push_back(relation);
      continue;
    }
    expressed[relation.unknown] = 1;
    inRows.push_back(relation.unknown);
    inRows.insert(inRows.end(), relation.others.begin(), relation.others.end());
  }
  const std::shared_ptr<InterfaceSpace> derived = withRelations(std::move(relations), neighbours);
  if (inRows.empty()) return derived;
  std::vector<std::vector<int>> stretches;  // ended by rows of several terms
  for (const auto& chain : neighbours) {
    stretches.emplace_back();
    for (const int place : chain)
      if (dimension_ == 3)
        stretches.back().push_back(place >= 0 && expressed[place] ? -1 : place);
      else if (!expressed[place])
        stretches.back().push_back(place);
      else if (!stretches.back().empty())
        stretches.emplace_back();
  }
  derived->broken_ = withRelations(std::move(plain), stretches, inRows);
  return derived;
}

std::shared_ptr<const InterfaceSpace> InterfaceSpace::without(const std::vector<int>& places) const {
  auto derived = std::make_shared<InterfaceSpace>(*this);
  std::vector<char> leaves(ownedRows_->size(), 0);
  for (const int place : places) leaves[place] = 1;
  for (InterfaceRelation& relation : derived->relations_) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < relation.others.size(); ++k) {
      if (leaves[relation.others[k]]) continue;
      relation.others[kept] = relation.others[k];
      relation.coefficients[kept++] = relation.coefficients[k];
    }
    relation.others.resize(kept);
    relation.coefficients.resize(kept);
  }
  for (const int place : places) {
    derived->relationOf_[place] = static_cast<int>(derived->relations_.size());
    derived->relations_.push_back({place, {}, {}});
    derived->sharers_.own()[place].clear();
  }
  derived->leaveEntities(leaves);
  if (broken_) derived->broken_ = broken_->without(places);
  return derived;
}

/// \param inRows  unknowns of other relations: vertices if one of these relations joins them to other local problems
std::shared_ptr<InterfaceSpace> InterfaceSpace::withRelations(std::vector<InterfaceRelation> relations,
                                                              const std::vector<std::vector<int>>& neighbours,
                                                              const std::vector<int>& inRows) const {
  auto derived = std::make_shared<InterfaceSpace>(*this);
  derived->relations_ = std::move(relations);
  std::vector<char> isPoint(ownedRows_->size(), 0), joined(ownedRows_->size(), 0), single(ownedRows_->size(), 0),
      leaves(ownedRows_->size(), 0);
  for (const InterfaceEntity& entity : entities())
    for (const int place : entity.kind == EntityKind::Vertex ? entity.unknowns : entity.ends) isPoint[place] = 1;
  for (std::size_t r = 0; r < derived->relations_.size(); ++r) {
    const InterfaceRelation& relation = derived->relations_[r];
    derived->relationOf_[relation.unknown] = static_cast<int>(r);
    leaves[relation.unknown] = 1;
    for (const int other : relation.others) {
      std::vector<int>& all = derived->sharers_.own()[other];
      std::vector<int> both;
      std::set_union(all.begin(), all.end(), sharers(relation.unknown).begin(), sharers(relation.unknown).end(), std::back_inserter(both));
      all = std::move(both);
      joined[other] = 1;
      // Neighbours in a row of several terms have no common displacement.
      if (relation.others.size() > 1 || (dimension_ == 2 && isPoint[relation.unknown])) single[other] = 1;
    }
  }
  for (const InterfaceRelation& relation : derived->relations_) derived->sharers_.own()[relation.unknown].clear();
  for (const int place : inRows)
    if (joined[place]) single[place] = 1;
  for (std::size_t place = 0; place < ownedRows_->size(); ++place) {
    if (!joined[place]) continue;
    const bool changed = derived->sharers(static_cast<int>(place)) != sharers(static_cast<int>(place));
    if (dimension_ == 3) {  // cells determine which of them are on an edge or a face
      if (changed || single[place]) leaves[place] = 1;
      continue;
    }
    // On a line, local problems change at unknowns with more than two of them.
    if ((isPoint[place] && changed) || derived->sharers(static_cast<int>(place)).size() > 2) single[place] = 1;
    if (isPoint[place] && !changed) single[place] = 0;  // keeps its entity
    if (single[place]) leaves[place] = 1;
  }
  derived->leaveEntities(leaves);
  derived->addContactEntities(neighbours, std::move(single));
  return derived;
}

/// The unknown that expresses an unknown of closed pairs, or that unknown itself; -1: none, several, or not shared between local problems.
int InterfaceSpace::expressing(int named) const {
  if (named < 0) return -1;
  const InterfaceRelation* by = relation(named);
  const int place = by ? (by->others.size() == 1 ? by->others[0] : -1) : named;
  return place >= 0 && sharers(place).size() > 1 ? place : -1;
}

/// Edges of closed pairs with the same two sharers that are neighbours along a line. \param apart  unknowns to leave out
std::vector<InterfaceSpace::ContactPlaces> InterfaceSpace::contactEdges(const std::vector<std::vector<int>>& chains,
                                                                        const std::vector<char>& apart) const {
  EntityGraph graph;
  std::vector<int> placeOf;  // place of each node of the graph; nodes are numbered along the lines
  for (const auto& chain : chains) {
    int last = -1;
    for (const int named : chain) {
      const int place = expressing(named);
      const auto node = static_cast<GlobalId>(placeOf.size());
      placeOf.push_back(place);
      if (place >= 0) graph.addNode(node, sharers(place), apart[place] != 0);
      if (place >= 0 && last >= 0) {
        std::vector<int> both;
        std::set_intersection(sharers(place).begin(), sharers(place).end(), sharers(last).begin(), sharers(last).end(),
                              std::back_inserter(both));
        graph.addSide({node - 1, node}, 2, both);
      }
      last = place;
    }
  }
  std::vector<SeamEntity> found = graph.entities();
  std::sort(found.begin(), found.end(), [](const SeamEntity& a, const SeamEntity& b) { return a.nodes.front() < b.nodes.front(); });
  std::vector<ContactPlaces> all;
  for (const SeamEntity& entity : found) {
    if (entity.kind != EntityKind::Edge) continue;
    all.push_back({EntityKind::Edge, entity.sharers, {}, {}});
    for (const GlobalId node : entity.nodes) all.back().unknowns.push_back(placeOf[node]);
    for (const GlobalId node : entity.ends) all.back().ends.push_back(placeOf[node]);
  }
  return all;
}

/// Closed pairs with the same sharers that are neighbours in the cells of a surface: faces of two local problems, edges of more.
std::vector<InterfaceSpace::ContactPlaces> InterfaceSpace::contactFaces(const std::vector<std::vector<int>>& cells,
                                                                        const std::vector<char>& apart) const {
  EntityGraph graph;
  std::map<GlobalId, int> placeOf;
  for (const auto& cell : cells) {
    std::vector<int> places;
    for (const int named : cell) {
      places.push_back(expressing(named));
      if (places.back() < 0) continue;
      graph.addNode(id(places.back()), sharers(places.back()), apart[places.back()] != 0);
      placeOf[id(places.back())] = places.back();
    }
    const std::size_t n = places.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (places[i] < 0) continue;
      const std::vector<int>& own = sharers(places[i]);
      if (own.size() > 2) {
        const int next = places[(i + 1) % n];
        const bool goesOn = next >= 0 && sharers(next) == own;
        graph.addSet(goesOn ? std::vector<GlobalId>{id(places[i]), id(next)} : std::vector<GlobalId>{id(places[i])}, own, EntityKind::Edge);
        continue;
      }
      std::vector<GlobalId> together;
      for (const int other : places)
        if (other >= 0 && sharers(other) == own) together.push_back(id(other));
      graph.addSet(std::move(together), own, EntityKind::Face);
    }
  }
  std::vector<ContactPlaces> all;
  for (const SeamEntity& entity : graph.entities()) {
    if (entity.kind == EntityKind::Vertex) continue;
    all.push_back({entity.kind, entity.sharers, {}, {}});
    for (const GlobalId node : entity.nodes) all.back().unknowns.push_back(placeOf.at(node));
  }
  return all;
}

/// Adds edges or faces of contact. `single`, and all other unknowns whose sharers were joined by a relation and that are on no edge or
/// face, become vertices.
void InterfaceSpace::addContactEntities(const std::vector<std::vector<int>>& neighbours, std::vector<char> single) {
  const std::vector<int> entityOf = entityOfPlaces();
  std::vector<char> apart = single, grouped(ownedRows_->size(), 0);
  for (std::size_t place = 0; place < apart.size(); ++place) apart[place] = apart[place] || entityOf[place] >= 0;
  for (ContactPlaces& found : dimension_ == 2 ? contactEdges(neighbours, apart) : contactFaces(neighbours, apart)) {
    for (const int place : found.unknowns) grouped[place] = 1;
    entities_.own().push_back({found.kind, std::move(found.sharers), std::move(found.unknowns), std::move(found.ends), true});
  }
  for (const InterfaceRelation& relation : relations_)
    if (relation.others.size() == 1 && sharers(relation.others[0]).size() > 1 && !grouped[relation.others[0]])
      single[relation.others[0]] = 1;
  for (std::size_t place = 0; place < ownedRows_->size(); ++place)
    if (single[place] && entityOf[place] < 0)
      entities_.own().push_back({EntityKind::Vertex, sharers(static_cast<int>(place)), {static_cast<int>(place)}, {}, true});
}

}  // namespace suture
