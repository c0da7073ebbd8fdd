#include <suture/algebra/DisjointSets.hpp>
#include <suture/base/Errors.hpp>
#include <suture/partition/EntityGraph.hpp>

#include <algorithm>
#include <tuple>
#include <utility>

namespace suture {

void EntityGraph::addNode(GlobalId node, std::vector<int> sharers, bool single) { nodes_.emplace(node, Node{std::move(sharers), single}); }

void EntityGraph::addFace(EntityKind kind, std::vector<GlobalId> key, const std::vector<GlobalId>& nodes, const std::vector<int>& sharers) {
  std::sort(key.begin(), key.end());
  const auto [found, isNew] = faces_.emplace(std::move(key), Face{kind, kind == EntityKind::Edge, nodes, sharers});
  std::vector<int>& known = found->second.sharers;
  if (isNew || known == sharers) return;
  std::vector<int> both;
  std::set_union(known.begin(), known.end(), sharers.begin(), sharers.end(), std::back_inserter(both));
  known = std::move(both);
}

void EntityGraph::addSide(const std::vector<GlobalId>& nodes, int vertices, const std::vector<int>& sharers) {
  const auto count = static_cast<int>(nodes.size());
  if (vertices < 2 || vertices > 4 || count < vertices) throw InternalError("a side of a seam has an unknown shape");
  const int edges = vertices == 2 ? 1 : vertices;
  for (int k = 0; k < edges; ++k) {
    const GlobalId a = nodes[k], b = nodes[(k + 1) % vertices];
    std::vector<GlobalId> way{a, b};
    if (count >= vertices + edges) way.insert(way.begin() + 1, nodes[vertices + k]);
    addFace(EntityKind::Edge, {a, b}, way, sharers);
  }
  if (vertices > 2) addFace(EntityKind::Face, {nodes.begin(), nodes.begin() + vertices}, nodes, sharers);
}

void EntityGraph::addSet(std::vector<GlobalId> nodes, std::vector<int> sharers, EntityKind kind) {
  sets_.push_back({kind, false, std::move(nodes), std::move(sharers)});
}

/// Works with positions of nodes and faces instead of their numbers.
class EntityGraph::Finder {
 public:
  explicit Finder(const EntityGraph& graph);
  std::vector<SeamEntity> entities();

 private:
  bool belongs(int node, const Face& face) const { return !single_[node] && nodes_[node]->sharers == face.sharers; }
  int placeOf(GlobalId id) const { return static_cast<int>(std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin()); }
  void findLinks();
  void follow(int from, int at, std::vector<int>& way) const;
  std::vector<int> wayAlong(const std::vector<int>& members) const;
  void order(const std::vector<int>& members, SeamEntity& entity);
  void addBoundaries(std::vector<SeamEntity>& all) const;

  std::vector<GlobalId> ids_;
  std::vector<const Node*> nodes_;
  std::vector<const Face*> faces_;
  std::vector<std::vector<int>> faceNodes_;
  std::vector<char> single_;
  std::vector<EntityKind> kind_;
  std::vector<char> ordered_;             // order along the edge is known
  std::vector<std::vector<int>> links_;   // neighbours along the edge that a node belongs to, bounding vertices included
  std::vector<int> entityOf_;             // entity of each node
  std::vector<std::array<int, 2>> ends_;  // nodes that bound each edge at front and back, -1: none
  std::vector<GlobalId> first_;           // number by which entities of equal sharers are sorted
};

EntityGraph::Finder::Finder(const EntityGraph& graph) {
  for (const auto& [id, node] : graph.nodes_) {
    ids_.push_back(id);
    nodes_.push_back(&node);
    single_.push_back(node.single);
  }
  for (const auto& entry : graph.faces_) faces_.push_back(&entry.second);
  for (const Face& set : graph.sets_) faces_.push_back(&set);
  for (const Face* face : faces_) {
    faceNodes_.emplace_back();
    for (const GlobalId id : face->nodes) faceNodes_.back().push_back(placeOf(id));
  }
}

void EntityGraph::Finder::findLinks() {
  kind_.assign(ids_.size(), EntityKind::Vertex);
  ordered_.assign(ids_.size(), 1);
  links_.assign(ids_.size(), {});
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const std::vector<int>& nodes = faceNodes_[f];
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (!belongs(nodes[k], *faces_[f])) continue;
      kind_[nodes[k]] = std::max(kind_[nodes[k]], faces_[f]->kind);
      if (!faces_[f]->ordered) {
        ordered_[nodes[k]] = 0;
        continue;
      }
      if (k > 0) links_[nodes[k]].push_back(nodes[k - 1]);
      if (k + 1 < nodes.size()) links_[nodes[k]].push_back(nodes[k + 1]);
    }
  }
}

/// Adds the members from `at` on, coming from `from`, up to the end or back to the start.
void EntityGraph::Finder::follow(int from, int at, std::vector<int>& way) const {
  const int entity = entityOf_[at];
  while (entityOf_[at] == entity && at != way.front()) {
    way.push_back(at);
    const std::vector<int>& links = links_[at];
    if (links.size() < 2) return;
    from = std::exchange(at, links[0] == from ? links[1] : links[0]);
  }
}

/// Members of an edge in order.
std::vector<int> EntityGraph::Finder::wayAlong(const std::vector<int>& members) const {
  const auto isOwn = [&](int node) { return entityOf_[node] == entityOf_[members.front()]; };
  const auto ends = [&](int node) { return links_[node].size() < 2 || !isOwn(links_[node][0]) || !isOwn(links_[node][1]); };
  const auto end = std::find_if(members.begin(), members.end(), ends);
  std::vector<int> way{end != members.end() ? *end : members.front()};
  std::vector<int> onward;
  for (const int next : links_[way.front()])
    if (isOwn(next)) onward.push_back(next);
  if (!onward.empty()) follow(way.front(), *std::min_element(onward.begin(), onward.end()), way);
  return way;
}

void EntityGraph::Finder::order(const std::vector<int>& members, SeamEntity& entity) {
  std::vector<int> way = wayAlong(members);
  const auto outside = [&](int node) {
    std::vector<int> all;
    for (const int next : links_[node])
      if (entityOf_[next] != entityOf_[node]) all.push_back(next);
    std::sort(all.begin(), all.end());
    return all;
  };
  std::array<int, 2> bounds{-1, -1};
  const std::vector<int> front = outside(way.front()), back = outside(way.back());
  if (!front.empty()) bounds[0] = front.front();
  if (way.size() > 1 && !back.empty()) bounds[1] = back.front();
  if (way.size() == 1 && front.size() > 1) bounds[1] = front.back();
  const bool ring = way.size() > 1 && bounds[0] < 0 && bounds[1] < 0 && links_[way.front()].size() > 1;

  std::vector<int> whole = way;  // including the vertices at its ends
  if (bounds[0] >= 0) whole.insert(whole.begin(), bounds[0]);
  if (bounds[1] >= 0) whole.push_back(bounds[1]);
  const std::size_t n = whole.size();
  if (!ring && n > 1 && std::tie(whole[n - 1], whole[n - 2]) < std::tie(whole[0], whole[1])) {
    std::reverse(way.begin(), way.end());
    std::reverse(whole.begin(), whole.end());
    std::swap(bounds[0], bounds[1]);
  }
  for (const int node : way) entity.nodes.push_back(ids_[node]);
  if (!ring && bounds[0] < 0) entity.ends.push_back(entity.nodes.front());
  if (!ring && bounds[1] < 0 && (way.size() > 1 || bounds[0] >= 0)) entity.ends.push_back(entity.nodes.back());
  ends_.back() = bounds;
  first_.back() = ids_[ring || n == 1 ? whole[0] : whole[1]];
}

void EntityGraph::Finder::addBoundaries(std::vector<SeamEntity>& all) const {
  for (std::size_t f = 0; f < faces_.size(); ++f)
    for (const int node : faceNodes_[f]) {
      if (!belongs(node, *faces_[f])) continue;
      SeamEntity& entity = all[entityOf_[node]];
      if (entity.kind == EntityKind::Edge && ordered_[node]) continue;
      for (const int other : faceNodes_[f])
        if (all[entityOf_[other]].kind < entity.kind) entity.boundary.push_back(entityOf_[other]);
    }
  for (SeamEntity& entity : all) {
    std::sort(entity.boundary.begin(), entity.boundary.end());
    entity.boundary.erase(std::unique(entity.boundary.begin(), entity.boundary.end()), entity.boundary.end());
  }
}

std::vector<SeamEntity> EntityGraph::Finder::entities() {
  findLinks();
  bool crossed = false;
  for (std::size_t i = 0; i < ids_.size(); ++i)
    if (kind_[i] == EntityKind::Edge && links_[i].size() > 2) crossed = true, single_[i] = 1;
  if (crossed) findLinks();

  DisjointSets sets(static_cast<int>(ids_.size()));
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    int first = -1;
    for (const int node : faceNodes_[f])
      if (belongs(node, *faces_[f])) first = first < 0 ? node : sets.join(first, node);
  }
  entityOf_.assign(ids_.size(), -1);
  std::vector<std::vector<int>> members;
  for (int i = 0; i < static_cast<int>(ids_.size()); ++i) {
    const int lowest = sets.lowest(i);
    if (entityOf_[lowest] < 0) {
      entityOf_[lowest] = static_cast<int>(members.size());
      members.emplace_back();
    }
    entityOf_[i] = entityOf_[lowest];
    members[entityOf_[i]].push_back(i);
  }

  std::vector<SeamEntity> found;
  for (const std::vector<int>& own : members) {
    SeamEntity entity;
    entity.sharers = nodes_[own.front()]->sharers;
    bool ordered = true;
    for (const int node : own) {
      entity.kind = std::max(entity.kind, kind_[node]);
      ordered = ordered && ordered_[node];
    }
    ends_.push_back({-1, -1});
    first_.push_back(ids_[own.front()]);
    if (entity.kind == EntityKind::Edge && ordered)
      order(own, entity);
    else
      for (const int node : own) entity.nodes.push_back(ids_[node]);
    found.push_back(std::move(entity));
  }

  std::vector<int> sorted(found.size()), placeOf(found.size());
  for (std::size_t k = 0; k < sorted.size(); ++k) sorted[k] = static_cast<int>(k);
  const auto before = [&](int a, int b) {
    if (found[a].kind != found[b].kind) return found[a].kind < found[b].kind;
    if (found[a].kind == EntityKind::Vertex) return first_[a] < first_[b];
    return std::tie(found[a].sharers, first_[a]) < std::tie(found[b].sharers, first_[b]);
  };
  std::sort(sorted.begin(), sorted.end(), before);
  std::vector<SeamEntity> all;
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    placeOf[sorted[k]] = static_cast<int>(k);
    all.push_back(std::move(found[sorted[k]]));
  }
  for (int& entity : entityOf_) entity = placeOf[entity];
  addBoundaries(all);
  for (std::size_t k = 0; k < sorted.size(); ++k)
    for (const int node : ends_[sorted[k]])
      if (node >= 0) all[k].boundary.push_back(entityOf_[node]);
  return all;
}

std::vector<SeamEntity> EntityGraph::entities() const { return Finder(*this).entities(); }

}  // namespace suture
