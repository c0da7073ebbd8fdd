#include <suture/constraints/ContactPairs.hpp>
#include <suture/constraints/MatchingPairs.hpp>
#include <suture/constraints/MortarPairs.hpp>
#include <suture/constraints/ObstaclePairs.hpp>

namespace suture {

PairedLine pairLine(const Mesh& mesh, const ContactLine& line, Problems& problems, std::vector<std::string>& notes) {
  using Coupling = ContactLine::Coupling;
  if (line.obstacle) return obstacleLine(mesh, line, problems);
  if (line.coupling == Coupling::Mortar) return mortarLine(mesh, line, problems);
  const bool must = line.coupling == Coupling::MatchingNodes;
  if (auto matched = matchingLine(mesh, line, must ? &problems : nullptr)) return *std::move(matched);
  if (must) return {};
  PairedLine mortar = mortarLine(mesh, line, problems);
  if (!mortar.pairs.empty())
    notes.push_back("contact '" + line.name + "': the nodes of its sides do not match; mortar, carried by '" +
                    (mesh.bodyOfNode[mortar.pairs.front().node()] == line.bodyA ? line.groupA : line.groupB) + "'");
  return mortar;
}

}  // namespace suture
