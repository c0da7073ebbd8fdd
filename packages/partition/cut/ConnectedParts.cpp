#include <algorithm>
#include <map>
#include <suture/base/Errors.hpp>
#include <suture/partition/cut/ConnectedParts.hpp>

namespace suture {
namespace {

// Elements of a connected set in breadth-first order.
std::vector<int> breadthFirst(const ElementGraph& graph, const std::vector<int>& partOf, int seed) {
  std::vector<int> reached{seed};
  std::vector<char> seen(graph.elements(), 0);
  seen[seed] = 1;
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (int other : graph.of(reached[i]))
      if (!seen[other] && partOf[other] == partOf[seed]) {
        seen[other] = 1;
        reached.push_back(other);
      }
  return reached;
}

int giveFragmentsToNeighbours(const ElementGraph& graph, int parts, std::vector<int>& partOf) {
  const Components pieces = components(graph, partOf);
  std::vector<int> keeper(parts, -1);  // part -> its largest component, the first of equals
  for (int c = 0; c < pieces.count(); ++c) {
    int& best = keeper[partOf[pieces.elements[c].front()]];
    if (best < 0 || pieces.elements[c].size() > pieces.elements[best].size()) best = c;
  }
  std::vector<char> settled(pieces.count(), 0);
  for (int c : keeper)
    if (c >= 0) settled[c] = 1;

  // A fragment may at first touch only other fragments; the graph is connected: every sweep settles at least one.
  for (bool waiting = true; waiting;) {
    waiting = false;
    bool progress = false;
    for (int c = 0; c < pieces.count(); ++c) {
      if (settled[c]) continue;
      std::map<int, int> sidesShared;  // part -> sides
      for (int e : pieces.elements[c])
        for (int other : graph.of(e))
          if (pieces.of[other] != c && settled[pieces.of[other]]) ++sidesShared[partOf[other]];
      if (sidesShared.empty()) {
        waiting = true;
        continue;
      }
      const auto most =
          std::max_element(sidesShared.begin(), sidesShared.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
      for (int e : pieces.elements[c]) partOf[e] = most->first;
      settled[c] = 1;
      progress = true;
    }
    if (waiting && !progress) throw InternalError("makeConnected() was given a graph that is not connected");
  }
  return pieces.count() - static_cast<int>(std::count_if(keeper.begin(), keeper.end(), [](int c) { return c >= 0; }));
}

// Cuts a connected part in two connected ones of about equal size; the second gets the label `fresh`.
void bisect(const ElementGraph& graph, int part, int fresh, std::vector<int>& partOf) {
  const int any = static_cast<int>(std::find(partOf.begin(), partOf.end(), part) - partOf.begin());
  const int farthest = breadthFirst(graph, partOf, any).back();
  const std::vector<int> order = breadthFirst(graph, partOf, farthest);
  // Every initial piece of a breadth-first order is connected. The rest may be disconnected: all its components except the largest join the
  // initial piece, which each of them touches because the part was connected.
  for (std::size_t i = 0; i < (order.size() + 1) / 2; ++i) partOf[order[i]] = fresh;
  const std::vector<int> rest(order.begin() + (order.size() + 1) / 2, order.end());
  std::vector<char> seen(graph.elements(), 0);
  std::vector<int> largest;
  for (int e : rest) {
    if (seen[e]) continue;
    const std::vector<int> component = breadthFirst(graph, partOf, e);
    for (int member : component) seen[member] = 1;
    if (component.size() > largest.size()) largest = component;
  }
  for (int e : rest) partOf[e] = fresh;
  for (int e : largest) partOf[e] = part;
}

}  // namespace

int makeConnected(const ElementGraph& graph, int parts, std::vector<int>& partOf) {
  if (parts < 1 || parts > graph.elements())
    throw InternalError("cannot cut " + std::to_string(graph.elements()) + " elements into " + std::to_string(parts) + " parts");
  int repairs = giveFragmentsToNeighbours(graph, parts, partOf);
  std::vector<int> size(parts, 0);
  for (int part : partOf) ++size[part];
  for (int empty = 0; empty < parts; ++empty) {
    if (size[empty] > 0) continue;
    const int largest = static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
    bisect(graph, largest, empty, partOf);
    size[empty] = static_cast<int>(std::count(partOf.begin(), partOf.end(), empty));
    size[largest] -= size[empty];
    ++repairs;
  }
  return repairs;
}

}  // namespace suture
