#include <suture/base/Point.hpp>
#include <suture/mesh/SurfaceOrder.hpp>
#include <suture/pairing/mortar/DualBasis.hpp>
#include <suture/pairing/mortar/MortarPairs.hpp>
#include <suture/pairing/mortar/MortarSampling.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <memory>
#include <sstream>

namespace suture {

namespace {

constexpr double kParallel = 1e-13;  // difference of two normals that are one
constexpr double kCovered = 0.2;     // part of a hat function below which its node carries no condition of its own
constexpr double kDistinct = 1e-8;   // ratio of pivots up to which the shape functions differ on a covered part in space
constexpr double kMuchFiner = 2.0;   // intervals of one side for each of the other

class Mortar {
 public:
  /// \param other  the other face; null: an obstacle
  Mortar(const ContactSurface& contact, const Surface& own, const Surface* other, double sign,
         std::unique_ptr<const MortarSampling> sampling)
      : contact_(contact), sign_(sign), surface_(own), other_(other), sampling_(std::move(sampling)) {
    for (int side = 0; side < surface_.sides(); ++side) {
      const int carriers = sampling_->functions(side, true);
      intervals_ += intervalsOf(side);
      for (int j = 0; j < carriers; ++j)
        if (const int node = surface_.nodesOf(side)[j]; !rowNormals_.count(node)) rowNormals_[node] = sampling_->meanNormal(side, j);
    }
  }

  std::size_t nodes() const { return rowNormals_.size(); }
  /// True if the other face stands opposite to all of this one.
  bool coversAll() { return coveredIntervals() > (1 - 1e-6) * intervals_; }
  bool isFaceted() const { return sampling_->isFaceted(); }
  /// Number of intervals between nodes that the other side stands opposite to, in space of quadrilaterals.
  double coveredIntervals() {
    if (integrated_) return coveredIntervals_;
    double covered = 0;
    for (int side = 0; side < surface_.sides(); ++side) {
      const std::optional<double> part = sampling_->covered(side, rowNormals_.at(surface_.nodesOf(side)[0]));
      if (!part) {
        integrate();
        return coveredIntervals_;
      }
      covered += intervalsOf(side) * *part;
    }
    return covered;
  }

  PairedSurface pairs() {
    integrate();
    PairedSurface result;
    for (const OrderedNode& own : inOrder(surface_, [this](int node) { return rows_.count(node) > 0; })) {
      const Row& row = rows_.at(own.node);
      result.pairs.push_back(pairOf(own.node, row, own.arc, static_cast<int>(result.pairs.size())));
      if (sampling_->estimatesDoubt()) result.gapDoubts.push_back(row.doubt / row.weight);
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
  // In space as many as a side has vertices on a large face: a triangle half a one, a quadrilateral one.
  double intervalsOf(int side) const {
    return surface_.dimension() == 2 ? double(surface_.nodesOf(side).size()) - 1 : (surface_.facets(side) - 2) / 2.0;
  }

  /// Points of a side along one normal, with the values there of the multiplier's dual functions.
  struct Points {
    std::vector<MortarSample> all;
    Matrix psi;  // functions x points, times the weights
  };
  Points evaluated(int functions, std::vector<MortarSample> samples) const {
    const int dimension = surface_.dimension();
    Points points;
    points.all = std::move(samples);
    Vector weights(points.all.size());
    Matrix shapes(functions, points.all.size());
    for (std::size_t q = 0; q < points.all.size(); ++q) {
      const ShapeValues values = multiplierValues(functions, dimension, points.all[q].at);
      shapes.col(q) = Eigen::Map<const Vector>(values.data(), functions);
      weights(q) = points.all[q].weight;
    }
    const DualBasis dual(shapes, weights, dimension == 2 ? 0.0 : kDistinct);
    points.psi.resize(functions, Eigen::Index(points.all.size()));
    for (std::size_t q = 0; q < points.all.size(); ++q) points.psi.col(q) = points.all[q].weight * dual.at(shapes.col(q));
    return points;
  }

  // Each row has a constant normal: the way from a point of one side to that of the other is then parallel to the row's force, and moments
  // balance. On straight lines and flat faces one set of points serves all rows of an element.
  void addRows(int side) {
    const std::vector<int>& nodes = surface_.nodesOf(side);
    const int carriers = sampling_->functions(side, true);
    std::vector<MortarSamples> sets;
    std::vector<Point> normals;
    std::vector<int> setOf;
    for (int j = 0; j < carriers; ++j) {
      const Point normal = rowNormals_.at(nodes[j]);
      std::size_t at = 0;
      while (at < sets.size() && norm(minus(normals[at], normal)) > kParallel) ++at;
      if (at == sets.size()) sets.push_back(sampling_->sample(side, normal)), normals.push_back(normal);
      setOf.push_back(static_cast<int>(at));
    }
    coveredIntervals_ += intervalsOf(side) * sets.front().covered;
    const bool whole = std::all_of(sets.begin(), sets.end(), [](const MortarSamples& set) { return set.covered > 1 - 1e-8; });
    const int functions = sampling_->functions(side, whole);
    for (std::size_t set = 0; set < sets.size(); ++set) {
      if (sets[set].all.empty()) continue;
      const Points points = evaluated(functions, std::move(sets[set].all));
      for (int j = 0; j < functions; ++j)
        if (setOf[j] == static_cast<int>(set)) addTo(rows_[nodes[j]], nodes, j, points);
    }
  }

  void addTo(Row& row, const std::vector<int>& nodes, int j, const Points& points) const {
    const std::vector<double*> own = entriesOf(row.own, nodes);
    std::vector<double*> others;
    int other = -1;
    for (std::size_t q = 0; q < points.all.size(); ++q) {
      const MortarSample& sample = points.all[q];
      const double psi = points.psi(j, q);
      row.weight += psi;
      row.gap += psi * sample.gap;
      row.doubt += psi * sample.doubt;
      for (std::size_t k = 0; k < own.size(); ++k) *own[k] += psi * sample.own[k];
      if (sample.other != other) others = entriesOf(row.others, other_->nodesOf(other = sample.other));
      for (std::size_t k = 0; k < others.size(); ++k) *others[k] += psi * sample.others[k];
    }
  }

  static std::vector<double*> entriesOf(std::map<int, double>& sums, const std::vector<int>& nodes) {
    std::vector<double*> entries;
    for (const int node : nodes) entries.push_back(&sums[node]);
    return entries;
  }

  void integrate() {
    if (integrated_) return;
    integrated_ = true;
    for (int side = 0; side < surface_.sides(); ++side) addRows(side);
    handOn();
  }

  /// Nodes that carry next to nothing hand their share on, along the line to the neighbour that carries more, on a surface to the nearest
  /// that carries enough: projected along its normal.
  void handOn() {
    const std::map<int, int> heirs = findHeirs();
    if (heirs.empty()) return;
    for (const auto& [node, heir] : heirs) rowNormals_[node] = rowNormals_.at(heir);
    rows_.clear();
    coveredIntervals_ = 0;
    for (int side = 0; side < surface_.sides(); ++side) addRows(side);
    for (const auto& [node, heir] : heirs) {
      const auto row = rows_.find(node);
      if (row == rows_.end()) continue;
      rows_[heir].add(row->second);
      rows_.erase(node);
    }
  }

  std::map<int, int> findHeirs() const {
    std::map<int, int> heirs;
    const auto share = [&](int node) { return rows_.at(node).weight / sampling_->hat(node); };
    const std::vector<OrderedNode> order = inOrder(surface_, [](int) { return true; });
    std::map<int, int> placeOf;
    for (std::size_t i = 0; i < order.size(); ++i) placeOf[order[i].node] = static_cast<int>(i);
    for (const OrderedNode& own : order) {
      if (!rows_.count(own.node) || share(own.node) >= kCovered) continue;
      std::vector<int> near = surface_.nodesNear(own.node);  // two steps, for the vertices of quadratic elements
      const auto away = [&](int x) { return norm(minus(surface_.at(x).position, surface_.at(own.node).position)); };
      const bool onLine = surface_.dimension() == 2;
      std::sort(near.begin(), near.end(), [&](int x, int y) { return onLine ? placeOf.at(x) < placeOf.at(y) : away(x) < away(y); });
      int heir = -1;
      for (const int other : near) {
        if (!rows_.count(other) || share(other) < kCovered) continue;
        if (heir < 0 || (onLine && share(other) > share(heir))) heir = other;
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
  const Surface* other_;
  std::unique_ptr<const MortarSampling> sampling_;
  std::map<int, Row> rows_;          // by the node that carries it
  std::map<int, Point> rowNormals_;  // by node
  double intervals_ = 0, coveredIntervals_ = 0;
  bool integrated_ = false;
};

std::unique_ptr<Mortar> mortarOn(bool onA, const Mesh& mesh, const ContactSurface& contact) {
  const ContactFace &own = onA ? contact.a : contact.b, &other = onA ? contact.b : contact.a;
  return std::make_unique<Mortar>(contact, *own.surface, &*other.surface, onA ? 1.0 : -1.0, samplingOf(mesh, contact, onA));
}

/// True if side A is the one to carry. Where elements of two nodes meet a curve, the side with fewer nodes on what both share: the finer
/// one would take what the other cannot follow for pressure. Else the side that the other covers wholly, where the stress ends with the
/// side and not inside an element; of two or none such that with more nodes, which resolves the stress better and has a node of its own for
/// each condition.
bool carriesBetter(Mortar& a, Mortar& b) {
  if (a.isFaceted()) return a.coveredIntervals() <= b.coveredIntervals();
  if (a.coversAll() != b.coversAll()) return a.coversAll();
  return a.nodes() >= b.nodes();
}

std::unique_ptr<Mortar> makeMortar(const Mesh& mesh, const ContactSurface& contact) {
  using Carrier = ContactSurface::Carrier;
  if (contact.carrier != Carrier::Automatic) return mortarOn(contact.carrier == Carrier::SideA, mesh, contact);
  auto a = mortarOn(true, mesh, contact), b = mortarOn(false, mesh, contact);
  return carriesBetter(*a, *b) ? std::move(a) : std::move(b);
}

/// Notes that the side which the scene names to carry the stress is the finer one.
void warnOfFinerCarrier(const Mesh& mesh, const ContactSurface& contact, Mortar& mortar, std::vector<std::string>& notes) {
  const bool onA = contact.carrier == ContactSurface::Carrier::SideA;
  if (contact.carrier == ContactSurface::Carrier::Automatic || !mortar.isFaceted()) return;
  const std::unique_ptr<Mortar> other = mortarOn(!onA, mesh, contact);
  if (!(mortar.coveredIntervals() >= kMuchFiner * other->coveredIntervals())) return;
  std::ostringstream text;
  text << "warning: " << contact.path << "/Multipliers On: " << (onA ? "Side A" : "Side B") << " is curved and has " << std::setprecision(2)
       << mortar.coveredIntervals() / other->coveredIntervals()
       << " elements for each of the other side, whose straight elements cannot follow it: nodal pressures may alternate between zero and "
          "twice the right ones; choose Automatic, which lets the coarser side carry";
  notes.push_back(text.str());
}

}  // namespace

PairedSurface mortarPairs(const ContactSurface& contact, std::unique_ptr<const MortarSampling> sampling) {
  return Mortar(contact, *contact.a.surface, nullptr, 1.0, std::move(sampling)).pairs();
}

PairedSurface mortarPairs(const Mesh& mesh, const ContactSurface& contact, Problems& problems, std::vector<std::string>& notes) {
  const std::unique_ptr<Mortar> mortar = makeMortar(mesh, contact);
  PairedSurface result = mortar->pairs();
  if (result.pairs.empty())
    problems.add(contact.path,
                 "the sides " + contact.a.name() + " and " + contact.b.name() +
                     " overlap nowhere: no normal of one meets the other face to face. Do the bodies lie on opposite sides of "
                     "the " +
                     (mesh.dimension == 2 ? "line?" : "surface?"));
  else
    warnOfFinerCarrier(mesh, contact, *mortar, notes);
  return result;
}

}  // namespace suture
