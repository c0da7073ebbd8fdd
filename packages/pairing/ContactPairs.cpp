#include <suture/mesh/SideGeometry.hpp>
#include <suture/pairing/AxisPoints.hpp>
#include <suture/pairing/ContactPairs.hpp>
#include <suture/pairing/MatchingPairs.hpp>
#include <suture/pairing/ObstaclePairs.hpp>
#include <suture/pairing/mortar/MortarPairs.hpp>

#include <algorithm>
#include <map>

namespace suture {

namespace {

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
                                                    : "a pressure on sides of six or eight nodes has no force at their vertices") +
                    "; mortar, carried by " + (onA ? contact.a : contact.b).name());
  }
  return mortar;
}

}  // namespace

PairedSurface pairSurface(const Mesh& mesh, const ContactSurface& contact, Problems& problems, std::vector<std::string>& notes) {
  PairedSurface all = pairsOf(mesh, contact, problems, notes);
  return mesh.axisymmetric ? withoutWeightless(all) : all;
}

std::vector<std::vector<int>> cellsOf(const Surface& surface, const std::vector<ContactPair>& pairs) {
  std::map<int, int> pairAt;  // carrying node -> pair
  for (const ContactPair& pair : pairs) pairAt[pair.node()] = pair.id;
  std::vector<std::vector<int>> cells;
  for (int side = 0; side < surface.sides(); ++side) {
    const std::vector<int>& nodes = surface.nodesOf(side);
    // A side whose vertices alone carry pairs is one cell.
    const bool some =
        surface.dimension() == 2 || std::any_of(nodes.begin() + surface.facets(side), nodes.end(), [&](int n) { return pairAt.count(n); });
    const int count = some ? static_cast<int>(nodes.size()) : surface.facets(side);
    for (const std::vector<int>& local : linearCells(count, surface.dimension())) {
      std::vector<int> cell;
      for (const int i : local)
        if (const auto found = pairAt.find(nodes[i]); found != pairAt.end()) cell.push_back(found->second);
      if (cell.size() == local.size()) cells.push_back(std::move(cell));
    }
  }
  if (surface.dimension() == 3) return cells;
  for (std::vector<int>& cell : cells) std::sort(cell.begin(), cell.end());
  std::sort(cells.begin(), cells.end());
  return cells;
}

}  // namespace suture
