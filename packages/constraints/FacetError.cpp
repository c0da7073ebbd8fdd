#include <suture/constraints/FacetError.hpp>
#include <suture/mesh/CellGeometry.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace suture {

namespace {

constexpr double kPressureOfGap = 2.4;  // nodal pressure error over E* (second difference of the gap) / h, measured on conforming pins
constexpr double kNoInterference = 1e-6;

double distance(const ContactPair& a, const ContactPair& b) { return norm(minus(a.position, b.position)); }

/// Second difference of the gaps at a pair of a chain, at its ends that of the next.
double bendAt(const std::vector<ContactPair>& pairs, const PairedLine::Chain& chain, int i) {
  const int at = chain.closed ? i : std::clamp(i, 1, chain.count - 2);
  const auto gap = [&](int k) { return pairs[chain.first + (k + chain.count) % chain.count].gap; };
  return gap(at - 1) - 2 * gap(at) + gap(at + 1);
}

}  // namespace

double complianceOf(const Mesh& mesh, const std::string& group, const ContactScales& scales) {
  if (group.empty() || !scales.compliance) return 0.0;
  const std::vector<Side>& sides = mesh.sideGroups.at(group);
  double sum = 0.0;
  for (const Side& side : sides) sum += scales.compliance(side.element);
  return sum / double(sides.size());
}

void noteInterference(const ContactLine& line, const PairedLine& paired, const std::string& unit, std::vector<std::string>& notes) {
  double deepest = 0;
  Point place{0, 0, 0};
  for (const PairedLine::Chain& chain : paired.chains)
    for (int i = 0; i < chain.count; ++i) {
      const int at = chain.first + i, neighbour = i > 0 ? at - 1 : at + 1;
      const double depth = -paired.pairs[at].gap, doubt = paired.gapDoubts.empty() ? 0.0 : std::abs(paired.gapDoubts[at]);
      const double size = chain.count > 1 ? distance(paired.pairs[at], paired.pairs[neighbour]) : 0.0;
      // The linear function nearest to the gap of curves that touch lies below zero there.
      const double touch = chain.count > 2 && paired.pairs[at].ends.size() > 2 ? std::abs(bendAt(paired.pairs, chain, i)) / 8 : 0.0;
      if (depth > std::max({deepest, kNoInterference * size, 2 * doubt, touch})) deepest = depth, place = paired.pairs[at].position;
    }
  if (deepest <= 0) return;
  char depth[60];
  std::snprintf(depth, sizeof depth, "%.1e%s%s", deepest, unit.empty() ? "" : " ", unit.c_str());
  notes.push_back("contact '" + line.name + "': " + (line.initialGap ? "given" : "drawn") + " interference " + depth + ", deepest at " +
                  placeText(place));
}

void estimatePressures(const std::vector<ContactLine>& lines, const std::vector<PairedLine>& paired, Constraints& constraints) {
  int base = 0;
  for (std::size_t l = 0; l < paired.size(); ++l) {
    const std::vector<ContactPair>& pairs = paired[l].pairs;
    const std::vector<double>& doubts = paired[l].gapDoubts;
    const double compliance = lines[l].compliance();
    for (const PairedLine::Chain& chain : paired[l].chains)
      for (int i = 0; i < chain.count && compliance > 0 && !doubts.empty() && chain.count > 2; ++i) {
        if (!chain.closed && (i == 0 || i + 1 == chain.count)) continue;
        const int at = chain.first + i, before = chain.first + (i + chain.count - 1) % chain.count,
                  after = chain.first + (i + 1) % chain.count;
        const double size = (distance(pairs[before], pairs[at]) + distance(pairs[at], pairs[after])) / 2;
        const double change = std::abs(doubts[at] - (doubts[before] + doubts[after]) / 2);
        double& doubt = constraints.pieces[constraints.pairs[base + at].piece].pressureDoubt;
        doubt = std::max(doubt, kPressureOfGap * change / (compliance * size));
      }
    base += static_cast<int>(pairs.size());
  }
}

}  // namespace suture
