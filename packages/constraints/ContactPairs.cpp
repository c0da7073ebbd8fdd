#include <suture/constraints/ContactPairs.hpp>
#include <suture/constraints/MatchingPairs.hpp>
#include <suture/constraints/MortarPairs.hpp>
#include <suture/constraints/ObstaclePairs.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kWeightless = 1e-9;  // of the neighbours' tributary areas

/// Leaves out pairs without a tributary area. The end of a second-order side on the axis is one: the integral of its hat function over the
/// circle is zero, so that no pressure has a force there, and no force decides whether it is closed.
PairedLine withoutWeightless(const PairedLine& all) {
  PairedLine some;
  for (const PairedLine::Chain& chain : all.chains) {
    PairedLine::Chain rest{static_cast<int>(some.pairs.size()), 0, chain.closed};
    for (int i = 0; i < chain.count; ++i) {
      const int at = chain.first + i;
      const double before = i > 0 ? all.pairs[at - 1].length : 0.0, after = i + 1 < chain.count ? all.pairs[at + 1].length : 0.0;
      if (std::abs(all.pairs[at].length) <= kWeightless * std::max(before, after)) continue;
      some.pairs.push_back(all.pairs[at]);
      some.pairs.back().id = static_cast<int>(some.pairs.size()) - 1;
      if (!all.gapDoubts.empty()) some.gapDoubts.push_back(all.gapDoubts[at]);
      ++rest.count;
    }
    if (rest.count > 0) some.chains.push_back(rest);
  }
  return some;
}

PairedLine pairsOf(const Mesh& mesh, const ContactLine& line, Problems& problems, std::vector<std::string>& notes) {
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

}  // namespace

PairedLine pairLine(const Mesh& mesh, const ContactLine& line, Problems& problems, std::vector<std::string>& notes) {
  PairedLine all = pairsOf(mesh, line, problems, notes);
  return mesh.axisymmetric ? withoutWeightless(all) : all;
}

}  // namespace suture
