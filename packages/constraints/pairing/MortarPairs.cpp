#include <suture/base/Point.hpp>
#include <suture/constraints/pairing/DualBasis.hpp>
#include <suture/constraints/pairing/MortarPairs.hpp>
#include <suture/constraints/pairing/MortarSampling.hpp>
#include <suture/mesh/SideShape.hpp>
#include <suture/mesh/SurfaceOrder.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <memory>
#include <sstream>

namespace suture {

namespace {

using Segment = MortarSegment;
using Samples = MortarSampling::Samples;
using Sample = MortarSampling::Sample;

constexpr double kParallel = 1e-13;  // difference of two normals that are one
constexpr double kCovered = 0.2;     // part of a hat function below which its node carries no condition of its own
constexpr double kMuchFiner = 2.0;   // intervals of one side for each of the other

class Mortar {
 public:
  Mortar(const Mesh& mesh, const ContactSurface& contact, bool onA)
      : contact_(contact), sign_(onA ? 1.0 : -1.0), surface_(*(onA ? contact.a : contact.b).surface), sampling_(mesh, contact, onA) {
    for (const Segment& own : sampling_.own())
      for (int j = 0; j < own.count(); ++j)
        if (!rowNormals_.count(own.nodes()[j])) rowNormals_[own.nodes()[j]] = sampling_.meanNormal(own, j);
    for (const Segment& own : sampling_.own()) integrate(own);
    handOn();
  }

  std::size_t nodes() const { return surface_.nodes().size(); }
  /// True if the other side stands opposite to all of this one.
  bool coversAll() const {
    double covered = 0, whole = 0;
    for (const auto& entry : rows_) covered += entry.second.weight;
    for (const auto& entry : surface_.nodes()) whole += entry.second.tributary;
    return covered > (1 - 1e-6) * whole;
  }

  bool isCurved() const { return sampling_.isCurved(); }
  bool isLinear() const { return sampling_.isLinear(); }
  /// Number of intervals between nodes that the other side stands opposite to.
  double coveredIntervals() const { return coveredIntervals_; }

  PairedSurface pairs() const {
    PairedSurface result;
    for (const OrderedNode& own : inOrder(surface_, [this](int node) { return rows_.count(node) > 0; })) {
      const Row& row = rows_.at(own.node);
      result.pairs.push_back(pairOf(own.node, row, own.arc, static_cast<int>(result.pairs.size())));
      result.gapDoubts.push_back(row.doubt / row.weight);
    }
    result.cells = cellsOf(surface_, result.pairs);
    return result;
  }

 private:
  /// Integrals of psi_j with: the shape functions of both sides by node, the gap, one.
  struct Row {
    std::map<int, double> own, others;
    double gap = 0, doubt = 0, weight = 0;
    void add(const Row& row) {
      for (const auto& [node, value] : row.own) own[node] += value;
      for (const auto& [node, value] : row.others) others[node] += value;
      gap += row.gap;
      doubt += row.doubt;
      weight += row.weight;
    }
  };
  // Each row has a constant normal: the way from a point of one side to that of the other is then parallel to the row's force, and moments
  // balance. On straight lines one set of samples serves all rows of an element.
  void integrate(const Segment& own) {
    std::vector<Samples> sets;
    std::vector<Point> normals;
    std::vector<int> setOf;
    for (int j = 0; j < own.count(); ++j) {
      const Point normal = rowNormals_.at(own.nodes()[j]);
      std::size_t at = 0;
      while (at < sets.size() && norm(minus(normals[at], normal)) > kParallel) ++at;
      if (at == sets.size()) sets.push_back(sampling_.sample(own, normal)), normals.push_back(normal);
      setOf.push_back(static_cast<int>(at));
    }
    coveredIntervals_ += (own.count() - 1) * sets.front().covered;
    const bool whole = std::all_of(sets.begin(), sets.end(), [](const Samples& set) { return set.covered > 1 - 1e-8; });
    const int functions = whole ? own.count() : 2;
    for (int j = 0; j < functions; ++j) addTo(rows_, own, j, functions, sets[setOf[j]].all);
  }

  static void addTo(std::map<int, Row>& rows, const Segment& own, int j, int functions, const std::vector<Sample>& samples) {
    if (samples.empty()) return;
    Matrix shapes(functions, samples.size());
    Vector weights(samples.size());
    for (std::size_t q = 0; q < samples.size(); ++q) {
      const SideShape values = sideShape(functions, samples[q].xi);
      shapes.col(q) = Eigen::Map<const Vector>(values.value.data(), functions);
      weights(q) = samples[q].weight;
    }
    const DualBasis dual(shapes, weights);
    Row& row = rows[own.nodes()[j]];
    for (std::size_t q = 0; q < samples.size(); ++q) {
      const Sample& sample = samples[q];
      const Vector psi = sample.weight * dual.at(shapes.col(q));
      const SideShape phi = sideShape(own.count(), sample.xi), others = sideShape(sample.other->count(), sample.eta);
      row.weight += psi(j);
      row.gap += psi(j) * sample.gap;
      row.doubt += psi(j) * sample.doubt;
      for (int k = 0; k < own.count(); ++k) row.own[own.nodes()[k]] += psi(j) * phi.value[k];
      for (int k = 0; k < sample.other->count(); ++k) row.others[sample.other->nodes()[k]] += psi(j) * others.value[k];
    }
  }

  /// Nodes that carry next to nothing hand their share on, along the line, to the neighbour that carries more: projected along its
  /// normal.
  void handOn() {
    const std::map<int, int> heirs = findHeirs();
    if (heirs.empty()) return;
    for (const auto& [node, heir] : heirs) rowNormals_[node] = rowNormals_.at(heir);
    rows_.clear();
    coveredIntervals_ = 0;
    for (const Segment& own : sampling_.own()) integrate(own);
    for (const auto& [node, heir] : heirs) {
      const auto row = rows_.find(node);
      if (row == rows_.end()) continue;
      rows_[heir].add(row->second);
      rows_.erase(node);
    }
  }

  std::map<int, int> findHeirs() const {
    std::map<int, int> heirs;
    const auto share = [&](int node) { return rows_.at(node).weight / surface_.at(node).tributary; };
    const std::vector<OrderedNode> order = inOrder(surface_, [](int) { return true; });
    std::map<int, int> placeOf;
    for (std::size_t i = 0; i < order.size(); ++i) placeOf[order[i].node] = static_cast<int>(i);
    for (const OrderedNode& own : order) {
      if (!rows_.count(own.node) || share(own.node) >= kCovered) continue;
      std::vector<int> near = surface_.nodesNear(own.node);  // two steps, for the end points of quadratic elements
      std::sort(near.begin(), near.end(), [&](int x, int y) { return placeOf.at(x) < placeOf.at(y); });
      int heir = -1;
      for (const int other : near) {
        if (!rows_.count(other) || share(other) < kCovered) continue;
        if (heir < 0 || share(other) > share(heir)) heir = other;
      }
      if (heir >= 0) heirs[own.node] = heir;
    }
    return heirs;
  }

  ContactPair pairOf(int node, const Row& row, double arc, int id) const {
    ContactPair pair;
    pair.id = id;
    pair.line = contact_.number;
    const Point& normal = rowNormals_.at(node);
    pair.normal = scaled(sign_, normal);
    pair.gap = row.gap / row.weight;
    pair.length = row.weight;
    pair.arc = arc;
    pair.position = surface_.at(node).position;
    pair.ends.push_back({node, sign_ * row.own.at(node) / row.weight});
    const auto add = [&](int at, double weight) {
      if (std::abs(weight) > 1e-12) pair.ends.push_back({at, weight});
    };
    for (const auto& [at, value] : row.own)
      if (at != node) add(at, sign_ * value / row.weight);
    for (const auto& [at, value] : row.others) add(at, -sign_ * value / row.weight);
    return pair;
  }

  const ContactSurface& contact_;
  double sign_;
  const Surface& surface_;
  MortarSampling sampling_;
  std::map<int, Row> rows_;          // by the node that carries it
  std::map<int, Point> rowNormals_;  // by node
  double coveredIntervals_ = 0;
};

/// True if side A is the one to carry. Where elements of two nodes meet a curve, the side with fewer nodes on what both share: the finer
/// one would take what the other cannot follow for pressure. Else the side that the other covers wholly, where the stress ends with the
/// side and not inside an element; of two or none such that with more nodes, which resolves the stress better and has a node of its own for
/// each condition.
bool carriesBetter(const Mortar& a, const Mortar& b) {
  if (a.isCurved() && (a.isLinear() || b.isLinear())) return a.coveredIntervals() <= b.coveredIntervals();
  if (a.coversAll() != b.coversAll()) return a.coversAll();
  return a.nodes() >= b.nodes();
}

std::unique_ptr<const Mortar> makeMortar(const Mesh& mesh, const ContactSurface& contact) {
  using Carrier = ContactSurface::Carrier;
  if (contact.carrier != Carrier::Automatic) return std::make_unique<Mortar>(mesh, contact, contact.carrier == Carrier::SideA);
  auto a = std::make_unique<Mortar>(mesh, contact, true), b = std::make_unique<Mortar>(mesh, contact, false);
  return carriesBetter(*a, *b) ? std::move(a) : std::move(b);
}

/// Notes that the side which the scene names to carry the stress is the finer one.
void warnOfFinerCarrier(const Mesh& mesh, const ContactSurface& contact, const Mortar& mortar, std::vector<std::string>& notes) {
  const bool onA = contact.carrier == ContactSurface::Carrier::SideA;
  if (contact.carrier == ContactSurface::Carrier::Automatic || !mortar.isCurved()) return;
  const Mortar other(mesh, contact, !onA);
  if (!(mortar.isLinear() || other.isLinear()) || !(mortar.coveredIntervals() >= kMuchFiner * other.coveredIntervals())) return;
  std::ostringstream text;
  text << "warning: " << contact.path << "/Multipliers On: " << (onA ? "Side A" : "Side B") << " is curved and has " << std::setprecision(2)
       << mortar.coveredIntervals() / other.coveredIntervals()
       << " elements for each of the other side, whose straight elements cannot follow it: nodal pressures may alternate between zero and "
          "twice the right ones; choose Automatic, which lets the coarser side carry";
  notes.push_back(text.str());
}

}  // namespace

PairedSurface mortarPairs(const Mesh& mesh, const ContactSurface& contact, Problems& problems, std::vector<std::string>& notes) {
  const std::unique_ptr<const Mortar> mortar = makeMortar(mesh, contact);
  PairedSurface result = mortar->pairs();
  if (result.pairs.empty())
    problems.add(contact.path,
                 "the sides " + contact.a.name() + " and " + contact.b.name() +
                     " overlap nowhere: no normal of one meets the other face to face. Do the bodies lie on opposite sides of "
                     "the line?");
  else
    warnOfFinerCarrier(mesh, contact, *mortar, notes);
  return result;
}

}  // namespace suture
