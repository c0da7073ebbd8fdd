#include <suture/base/Point.hpp>
#include <suture/constraints/FacetError.hpp>
#include <suture/mesh/BoxTree.hpp>
#include <suture/mesh/CellGeometry.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace suture {

namespace {

constexpr double kPressureOfGap = 2.4;  // nodal pressure error over E* (second difference of the gap) / h, measured on conforming pins
constexpr double kNoInterference = 1e-6;

std::string lengthText(double length, const std::string& unit) {
  char text[60];
  std::snprintf(text, sizeof text, "%.1e%s%s", length, unit.empty() ? "" : " ", unit.c_str());
  return text;
}

double distance(const ContactPair& a, const ContactPair& b) { return norm(minus(a.position, b.position)); }

/// Second difference of the gaps at a pair; at the end of a line, that of the neighbouring pair.
double bendAt(const std::vector<ContactPair>& pairs, const std::vector<std::vector<int>>& beside, int at) {
  if (beside[at].size() == 1) at = beside[at].front();
  const std::vector<int>& others = beside[at];
  if (others.size() < 2) return 0.0;
  double sum = 0.0;
  for (const int other : others) sum += pairs[other].gap - pairs[at].gap;
  return 2.0 * sum / double(others.size());
}

}  // namespace

double complianceOf(const Mesh& mesh, const ContactFace& face, const ContactScales& scales) {
  if (face.empty() || !scales.compliance) return 0.0;
  const std::vector<Side> sides = sidesOf(mesh.sideGroups, face.groups);
  double sum = 0.0;
  for (const Side& side : sides) sum += scales.compliance(mesh, side.element);
  return sum / double(sides.size());
}

void noteInterference(const ContactSurface& contact, const PairedSurface& paired, const std::string& unit,
                      std::vector<std::string>& notes) {
  const std::vector<ContactPair>& pairs = paired.pairs;
  const std::vector<std::vector<int>> beside = neighbourPairs(paired.cells, static_cast<int>(pairs.size()));
  const int dimension = contact.a.surface->dimension();
  const auto spacing = [&](std::size_t i) { return beside[i].empty() ? 0.0 : distance(pairs[i], pairs[beside[i].front()]); };
  double deepest = 0, widest = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) widest = std::max(widest, spacing(i));
  Point place{0, 0, 0};
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double depth = -pairs[i].gap, doubt = paired.gapDoubts.empty() ? 0.0 : std::abs(paired.gapDoubts[i]);
    const double size = beside[i].empty() ? widest : spacing(i);
    // With mortar, the gap of touching sides is the best linear fit, which lies below zero by this much per direction along the sides.
    const double touch = pairs[i].ends.size() > 2 ? (dimension - 1) * std::abs(bendAt(pairs, beside, static_cast<int>(i))) / 8 : 0.0;
    if (depth > std::max({deepest, kNoInterference * size, 2 * doubt, touch})) deepest = depth, place = pairs[i].position;
  }
  if (deepest <= 0) return;
  const bool isDeep = !contact.obstacle && widest > 0 && deepest > widest;  // a rigid obstacle may be pushed in on purpose
  notes.push_back((isDeep ? "warning: " : "") + ("contact '" + contact.name + "': ") + (contact.initialGap ? "given" : "drawn") +
                  " interference " + lengthText(deepest, unit) + (isDeep ? ", deeper than the element length" : "") + ", deepest at " +
                  placeText(place, dimension));
}

void noteDistance(const ContactSurface& contact, const PairedSurface& paired, const std::string& unit, std::vector<std::string>& notes) {
  if (paired.pairs.size() < 2) return;
  BoundingBox box;
  const ContactPair* nearest = &paired.pairs.front();
  for (const ContactPair& pair : paired.pairs) {
    box.include(pair.position);
    if (pair.gap < nearest->gap) nearest = &pair;
  }
  const double length = norm(minus(box.high, box.low));
  if (nearest->gap <= length) return;
  notes.push_back("warning: contact '" + contact.name + "': its sides are " + lengthText(nearest->gap, unit) +
                  " apart, more than the length of the contact (" + lengthText(length, unit) + "), nearest at " +
                  placeText(nearest->position, contact.a.surface->dimension()) + ". Are these the sides that should meet?");
}

void estimatePressures(const std::vector<ContactSurface>& contacts, const std::vector<PairedSurface>& paired, Constraints& constraints) {
  int base = 0;
  for (std::size_t c = 0; c < paired.size(); ++c) {
    const std::vector<ContactPair>& pairs = paired[c].pairs;
    const std::vector<double>& doubts = paired[c].gapDoubts;
    const double compliance = contacts[c].compliance();
    const std::vector<std::vector<int>> beside = neighbourPairs(paired[c].cells, static_cast<int>(pairs.size()));
    for (std::size_t i = 0; i < pairs.size() && compliance > 0 && !doubts.empty(); ++i) {
      if (beside[i].size() < 2) continue;  // the end of a line
      double sum = 0.0, size = 0.0;
      for (const int other : beside[i]) sum += doubts[other], size += distance(pairs[i], pairs[other]);
      const double count = double(beside[i].size()), change = std::abs(doubts[i] - sum / count);
      double& doubt = constraints.pieces[constraints.pairs[base + i].piece].pressureDoubt;
      doubt = std::max(doubt, kPressureOfGap * change / (compliance * (size / count)));
    }
    base += static_cast<int>(pairs.size());
  }
}

}  // namespace suture
