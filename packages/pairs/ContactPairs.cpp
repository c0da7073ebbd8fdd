#include <suture/mesh/SideGeometry.hpp>
#include <suture/pairs/AxisPoints.hpp>
#include <suture/pairs/ContactPairs.hpp>
#include <suture/pairs/MatchingPairs.hpp>
#include <suture/pairs/ObstaclePairs.hpp>
#include <suture/pairs/mortar/MortarPairs.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace suture {

namespace {

constexpr double kCoordinateDigits = 4e-15;  // round-off of a gap, a sum of some coordinates, relative to the largest coordinate

/// Sets gaps that are round-off of the coordinates to zero: sides drawn in contact touch exactly, as in a mesh with matching nodes.
void closeRoundedGaps(const Mesh& mesh, const ContactSurface& contact, std::vector<ContactPair>& pairs) {
  if (contact.initialGap) return;
  double largest = 0.0;
  for (const ContactPair& pair : pairs)
    for (const PairEnd& end : pair.ends)
      for (const double coordinate : mesh.point(end.node)) largest = std::max(largest, std::abs(coordinate));
  for (ContactPair& pair : pairs)
    if (std::abs(pair.gap) <= kCoordinateDigits * largest) pair.gap = 0.0;
}

PairedSurface pairsOf(const Mesh& mesh, const ContactSurface& contact, Problems& problems, std::vector<std::string>& notes) {
  using Coupling = ContactSurface::Coupling;
  if (contact.obstacle) return obstaclePairs(contact, problems, notes);
  if (contact.coupling == Coupling::Mortar) return mortarPairs(mesh, contact, problems, notes);
  const bool must = contact.coupling == Coupling::MatchingNodes;
  if (auto matched = matchingPairs(mesh, contact, must ? &problems : nullptr)) return *std::move(matched);
  if (must) return {};
  PairedSurface mortar = mortarPairs(mesh, contact, problems, notes);
  if (!mortar.pairs.empty()) {
    const bool onA = contact.a.surface->nodes().count(mortar.pairs.front().node()) > 0;
    notes.push_back("contact '" + contact.name + "': " +
                    (contact.a.nodesCarryPressure() ? "the nodes of its sides do not match"
                                                    : "a pressure on six- or eight-node sides exerts no force at their vertices") +
                    "; mortar, carried by " + (onA ? contact.a : contact.b).name());
  }
  return mortar;
}

/// Triangles of a side in 3D that has pairs at all vertices and at some of its other nodes, as a fan around one of these.
/// \param pairs  of the nodes of the side, -1 for none
std::vector<std::vector<int>> trianglesAround(const std::vector<int>& pairs, int vertices) {
  std::vector<int> ring;
  for (int v = 0; v < vertices; ++v)
    for (const int pair : {pairs[v], pairs[vertices + v]})
      if (pair >= 0) ring.push_back(pair);
  const bool fromCentre = static_cast<int>(pairs.size()) > 2 * vertices && pairs.back() >= 0;
  const int apex = fromCentre ? pairs.back() : *std::find_if(pairs.begin() + vertices, pairs.end(), [](int pair) { return pair >= 0; });
  std::vector<std::vector<int>> cells;
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (const int next = ring[(i + 1) % ring.size()]; ring[i] != apex && next != apex) cells.push_back({apex, ring[i], next});
  return cells;
}

}  // namespace

PairedSurface pairSurface(const Mesh& mesh, const ContactSurface& contact, Problems& problems, std::vector<std::string>& notes) {
  PairedSurface all = pairsOf(mesh, contact, problems, notes);
  closeRoundedGaps(mesh, contact, all.pairs);
  return mesh.axisymmetric ? withoutWeightless(all) : all;
}

std::vector<std::vector<int>> cellsOf(const Surface& surface, const std::vector<ContactPair>& pairs) {
  std::map<int, int> pairAt;  // carrying node -> pair
  for (const ContactPair& pair : pairs) pairAt[pair.node()] = pair.id;
  std::vector<std::vector<int>> cells;
  for (int side = 0; side < surface.sides(); ++side) {
    std::vector<int> own;
    for (const int node : surface.nodesOf(side)) {
      const auto found = pairAt.find(node);
      own.push_back(found == pairAt.end() ? -1 : found->second);
    }
    if (surface.dimension() == 3) {
      const int vertices = surface.facets(side);
      const auto others = own.begin() + vertices;
      const bool whole = std::count(own.begin(), others, -1) == 0;
      if (std::count(others, own.end(), -1) == own.end() - others) {
        own.erase(others, own.end());  // a side with pairs at its vertices only is one cell
      } else if (whole && std::count(others, own.end(), -1) > 0) {
        for (std::vector<int>& cell : trianglesAround(own, vertices)) cells.push_back(std::move(cell));
        continue;
      }
    }
    for (const std::vector<int>& local : linearCells(static_cast<int>(own.size()), surface.dimension())) {
      std::vector<int> cell;
      for (const int i : local) cell.push_back(own[i]);
      if (std::count(cell.begin(), cell.end(), -1) == 0) cells.push_back(std::move(cell));
    }
  }
  if (surface.dimension() == 3) return cells;
  for (std::vector<int>& cell : cells) std::sort(cell.begin(), cell.end());
  std::sort(cells.begin(), cells.end());
  return cells;
}

}  // namespace suture
