#include <suture/algebra/DisjointSets.hpp>
#include <suture/base/Errors.hpp>
#include <suture/mesh/CellGeometry.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "Proposal.hpp"

namespace suture::proposal {

namespace {

/// Number of the connected part of each element, and how many elements each part has.
std::pair<std::vector<int>, std::vector<int>> connectedParts(const Mesh& mesh) {
  DisjointSets sets(mesh.nodes());
  for (int e = 0; e < mesh.elements(); ++e) {
    const Span<const int> nodes = mesh.nodesOf(e);
    int lowest = nodes[0];
    for (const int node : nodes) lowest = sets.join(lowest, node);
  }
  std::map<int, int> numbers;
  std::vector<int> part(mesh.elements()), size;
  for (int e = 0; e < mesh.elements(); ++e) {
    const auto [at, fresh] = numbers.try_emplace(sets.lowest(mesh.nodesOf(e)[0]), static_cast<int>(size.size()));
    if (fresh) size.push_back(0);
    part[e] = at->second;
    ++size[part[e]];
  }
  return {part, size};
}

/// Alphabetic order, in which "bolt_2" precedes "bolt_10".
bool comesBefore(const std::string& a, const std::string& b) {
  const auto key = [](const std::string& name) {
    const std::size_t digits = name.find_last_not_of("0123456789") + 1;
    const std::string number = name.substr(digits);
    return std::make_tuple(name.substr(0, digits), number.size(), number);
  };
  return key(a) < key(b);
}

}  // namespace

Bodies proposeBodies(const Mesh& mesh) {
  const auto [part, size] = connectedParts(mesh);
  using Candidate = std::tuple<std::size_t, std::size_t, std::string>;  // elements, length of the name, name
  std::vector<Candidate> whole;
  std::map<std::string, std::set<int>> partsOf;
  for (const auto& [name, elements] : mesh.elementGroups) {
    if (elements.empty()) continue;
    std::set<int>& own = partsOf[name];
    for (const int e : elements) own.insert(part[e]);
    std::size_t all = 0;
    for (const int p : own) all += size[p];
    if (all == elements.size()) whole.emplace_back(all, name.size(), name);
  }
  std::sort(whole.begin(), whole.end());

  Bodies result;
  std::vector<int> owner(size.size(), -1);
  for (const auto& [elements, length, name] : whole) {
    const std::set<int>& own = partsOf[name];
    if (std::any_of(own.begin(), own.end(), [&](int p) { return owner[p] >= 0; })) continue;
    for (const int p : own) owner[p] = static_cast<int>(result.names.size());
    result.names.push_back(name);
  }
  for (const auto& [name, own] : partsOf) {
    if (std::find(result.names.begin(), result.names.end(), name) != result.names.end() || own.size() != 1) continue;
    const int body = owner[*own.begin()];
    if (body >= 0) result.parts.emplace_back(name, result.names[body]);
  }
  std::sort(result.names.begin(), result.names.end(), comesBefore);
  std::vector<int> first(size.size(), -1);
  for (int e = mesh.elements() - 1; e >= 0; --e) first[part[e]] = e;
  for (std::size_t p = 0; p < size.size(); ++p) {
    if (owner[p] >= 0) continue;
    std::vector<std::string> inside;
    for (const auto& [name, own] : partsOf)
      if (own.count(static_cast<int>(p))) inside.push_back(name);
    result.notes.push_back(countAt(size[p], "connected element", placeText(centreOf(mesh, first[p]), mesh.dimension)) +
                           (inside.empty() ? " in no " + mesh.elementGroupKind() +
                                                 (mesh.dimension == 2 ? ": name the surface in the geometry (in Gmsh: Physical Surface)"
                                                                      : ": name the volume in the geometry (in Gmsh: Physical Volume)")
                                           : " share nodes and belong to " + joinNames(inside) + ": they form one body, which needs one " +
                                                 mesh.elementGroupKind() + " for all of it; the other groups can be its Regions"));
  }
  return result;
}

std::vector<std::pair<Point, Point>> boxesOf(const Mesh& mesh) {
  std::vector<std::pair<Point, Point>> boxes(mesh.bodies.size(), {{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}});
  for (int node = 0; node < mesh.nodes(); ++node) {
    auto& [low, high] = boxes[mesh.bodyOfNode[node]];
    const Point p = mesh.point(node);
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  return boxes;
}

}  // namespace suture::proposal
