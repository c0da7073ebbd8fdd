#include <suture/interface/ContactEntities.hpp>

#include <algorithm>
#include <map>

namespace suture {

namespace {

/// The unknown that expresses an unknown of closed pairs, or that unknown itself; -1: none, several, or not shared between local problems.
int expressing(const InterfaceSpace& space, int named) {
  if (named < 0) return -1;
  const InterfaceRelation* by = space.relation(named);
  const int place = by ? (by->others.size() == 1 ? by->others[0] : -1) : named;
  return place >= 0 && space.sharers(place).size() > 1 ? place : -1;
}

/// Edges of closed pairs with the same two sharers that are neighbours along a line. \param apart  unknowns to leave out
std::vector<InterfaceEntity> contactEdges(const InterfaceSpace& space, const std::vector<std::vector<int>>& chains,
                                          const std::vector<char>& apart) {
  EntityGraph graph;
  std::vector<int> placeOf;                    // place of each node of the graph; nodes are numbered along the lines
  std::vector<char> isKnown(apart.size(), 0);  // springs of a softened contact are lines on the same unknowns
  for (const auto& chain : chains) {
    int last = -1;
    for (const int named : chain) {
      int place = expressing(space, named);
      if (place >= 0 && isKnown[place]) place = -1;
      if (place >= 0) isKnown[place] = 1;
      const auto node = static_cast<GlobalId>(placeOf.size());
      placeOf.push_back(place);
      if (place >= 0) graph.addNode(node, space.sharers(place), apart[place] != 0);
      if (place >= 0 && last >= 0) {
        std::vector<int> both;
        std::set_intersection(space.sharers(place).begin(), space.sharers(place).end(), space.sharers(last).begin(),
                              space.sharers(last).end(), std::back_inserter(both));
        graph.addSide({node - 1, node}, 2, both);
      }
      last = place;
    }
  }
  std::vector<SeamEntity> found = graph.entities();
  std::sort(found.begin(), found.end(), [](const SeamEntity& a, const SeamEntity& b) { return a.nodes.front() < b.nodes.front(); });
  std::vector<InterfaceEntity> all;
  for (const SeamEntity& entity : found) {
    if (entity.kind != EntityKind::Edge) continue;
    all.push_back({EntityKind::Edge, entity.sharers, {}, {}, true});
    for (const GlobalId node : entity.nodes) all.back().unknowns.push_back(placeOf[node]);
    for (const GlobalId node : entity.ends) all.back().ends.push_back(placeOf[node]);
  }
  return all;
}

/// Closed pairs with the same sharers that are neighbours in the cells of a surface: faces of two local problems, edges of more.
std::vector<InterfaceEntity> contactFaces(const InterfaceSpace& space, const std::vector<std::vector<int>>& cells,
                                          const std::vector<char>& apart) {
  EntityGraph graph;
  std::map<GlobalId, int> placeOf;
  for (const auto& cell : cells) {
    std::vector<int> places;
    for (const int named : cell) {
      places.push_back(expressing(space, named));
      if (places.back() < 0) continue;
      graph.addNode(space.id(places.back()), space.sharers(places.back()), apart[places.back()] != 0);
      placeOf[space.id(places.back())] = places.back();
    }
    const std::size_t n = places.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (places[i] < 0) continue;
      const std::vector<int>& own = space.sharers(places[i]);
      if (own.size() > 2) {
        const int next = places[(i + 1) % n];
        const bool goesOn = next >= 0 && space.sharers(next) == own;
        graph.addSet(goesOn ? std::vector<GlobalId>{space.id(places[i]), space.id(next)} : std::vector<GlobalId>{space.id(places[i])}, own,
                     EntityKind::Edge);
        continue;
      }
      std::vector<GlobalId> together;
      for (const int other : places)
        if (other >= 0 && space.sharers(other) == own) together.push_back(space.id(other));
      graph.addSet(std::move(together), own, EntityKind::Face);
    }
  }
  std::vector<InterfaceEntity> all;
  for (const SeamEntity& entity : graph.entities()) {
    if (entity.kind == EntityKind::Vertex) continue;
    all.push_back({entity.kind, entity.sharers, {}, {}, true});
    for (const GlobalId node : entity.nodes) all.back().unknowns.push_back(placeOf.at(node));
  }
  return all;
}

}  // namespace

std::vector<InterfaceEntity> contactEntities(const InterfaceSpace& space, const std::vector<std::vector<int>>& neighbours,
                                             std::vector<char> single) {
  const std::vector<int> entityOf = space.entityOfPlaces();
  std::vector<char> apart = single, grouped(single.size(), 0);
  for (std::size_t place = 0; place < apart.size(); ++place) apart[place] = apart[place] || entityOf[place] >= 0;
  std::vector<InterfaceEntity> all =
      space.dimension() == 2 ? contactEdges(space, neighbours, apart) : contactFaces(space, neighbours, apart);
  for (const InterfaceEntity& found : all)
    for (const int place : found.unknowns) grouped[place] = 1;
  for (const InterfaceRelation& relation : space.relations())
    if (relation.others.size() == 1 && space.sharers(relation.others[0]).size() > 1 && !grouped[relation.others[0]])
      single[relation.others[0]] = 1;
  for (std::size_t place = 0; place < single.size(); ++place)
    if (single[place] && entityOf[place] < 0)
      all.push_back({EntityKind::Vertex, space.sharers(static_cast<int>(place)), {static_cast<int>(place)}, {}, true});
  return all;
}

}  // namespace suture
