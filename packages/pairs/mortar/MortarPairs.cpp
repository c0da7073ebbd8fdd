#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/SurfaceOrder.hpp>
#include <suture/pairs/mortar/DualBasis.hpp>
#include <suture/pairs/mortar/MortarPairs.hpp>
#include <suture/pairs/mortar/MortarSampling.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <memory>
#include <set>
#include <sstream>

namespace suture {

namespace {

constexpr double kParallel = 1e-13;  // difference up to which two normals count as equal
constexpr double kCoversSide = 0.9;  // fraction of each side that is covered if the other face has no end on this one
constexpr double kDistinct = 1e-8;   // ratio of pivots up to which the shape functions are distinct on a covered part in 3D
// Width of the limits of earlier decisions (MortarChoices), as a part of a side: strains change covered parts by less.
// Not critical: with 0.005, 0.01, 0.02 and 0.03 a path of a hollow body takes 213, 213, 216 and 207 iterations, those of a cam and of a
// roller the same ones.
constexpr double kBand = 0.02;
constexpr double kMuchFiner = 2.0;  // intervals of one side per interval of the other

class Mortar {
 public:
  /// \param other  the other face; null for an obstacle
  Mortar(const ContactSurface& contact, const Surface& own, const Surface* other, double sign,
         std::unique_ptr<const MortarSampling> sampling)
      : contact_(contact),
        kept_(contact.choices && contact.choices->onA == (sign > 0.0) ? *contact.choices : MortarChoices()),
        sign_(sign),
        surface_(own),
        other_(other),
        sampling_(std::move(sampling)) {
    for (int side = 0; side < surface_.sides(); ++side) {
      const int carriers = sampling_->functions(side, true);
      for (int j = 0; j < carriers; ++j)
        if (const int node = surface_.nodesOf(side)[j]; !rowNormals_.count(node)) rowNormals_[node] = sampling_->rowNormal(side, j);
    }
  }

  std::size_t nodes() const { return rowNormals_.size(); }
  /// True if all of this face is opposite to the other one. Normals at the ends of curved faces may miss it by about the gap.
  bool coversAll() { return coveredIntervals() > 0 && leastCovered_ > kCoversSide; }
  bool isFaceted() const { return sampling_->isFaceted(); }
  /// Number of intervals between nodes that are opposite to the other side; in 3D number of quadrilaterals.
  double coveredIntervals() {
    if (coverageKnown_) return coveredIntervals_;
    for (int side = 0; side < surface_.sides(); ++side) {
      const std::optional<double> part = sampling_->covered(side, rowNormals_.at(surface_.nodesOf(side)[0]));
      if (!part) {
        integrate();
        break;
      }
      addCoverage(side, *part);
    }
    coverageKnown_ = true;
    return coveredIntervals_;
  }

  /// Nodes that carry a condition although the other face does not come close, because no neighbour is reached by it.
  std::vector<int> unreached() {
    integrate();
    std::vector<int> nodes;
    for (const auto& entry : rows_)
      if (!isReached(entry.first)) nodes.push_back(entry.first);
    return nodes;
  }

  /// Choices of these pairs, for those of the next shapes.
  MortarChoices choices() {
    integrate();
    MortarChoices choices;
    if (rows_.empty()) return choices;
    choices.onA = sign_ > 0.0;
    choices.whole = whole_;
    for (const auto& entry : rows_)
      if (isReached(entry.first)) choices.reached.insert(entry.first);
    return choices;
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
  /// Integrals of psi_j times: the shape functions of both sides by node, the gap, one.
  struct Row {
    std::map<int, double> own, others;
    double gap = 0, doubt = 0, weight = 0;
    bool tookOver = false;  // has received psi of other nodes
    void adopt(const Row& row) {
      tookOver = true;
      for (const auto& [node, value] : row.own) own[node] += value;
      for (const auto& [node, value] : row.others) others[node] += value;
      gap += row.gap;
      doubt += row.doubt;
      weight += row.weight;
    }
  };
  void addCoverage(int side, double part) {
    if (coverageKnown_) return;
    coveredIntervals_ += intervalsOf(side) * part;
    leastCovered_ = std::min(leastCovered_, part);
  }
  // 3D: the number of vertices per side on a large face: one half for a triangle, one for a quadrilateral.
  double intervalsOf(int side) const {
    return surface_.dimension() == 2 ? double(surface_.nodesOf(side).size()) - 1 : (surface_.facets(side) - 2) / 2.0;
  }

  /// Quadrature points of a side along one normal, with the values of the dual functions there.
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

  // Each row has a constant normal: the line between matched points of the two sides is then parallel to the row's force, and moments
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
    addCoverage(side, sets.front().covered);
    const double limit = limitOf(MortarSamples::kWhole, kept_.whole.count(side) > 0);
    const bool whole = std::all_of(sets.begin(), sets.end(), [&](const MortarSamples& set) { return set.covered > limit; });
    if (whole) whole_.insert(side);
    for (int j = 0; j < carriers; ++j) {
      double& reach = reach_[nodes[j]];
      reach = std::max(reach, whole ? 1.0 : sets[setOf[j]].reach[j]);
    }
    const int functions = sampling_->functions(side, whole);
    if (functions < carriers) linearSides_.insert(side);
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
    coverageKnown_ = true;
    // Mid-side nodes have functions only on sides that are covered entirely: next to a vertex that transfers its share they would carry
    // part of it.
    for (const int side : linearSides_) {
      const std::vector<int>& nodes = surface_.nodesOf(side);
      const auto middle = nodes.begin() + sampling_->functions(side, false);
      if (!std::all_of(nodes.begin(), middle, [&](int node) { return isReached(node); })) halved_.insert(middle, nodes.end());
    }
    handOn();
  }

  /// Nodes that the other face does not reach transfer their share to the nearest node that it reaches, projected along the normal of that
  /// node, so that forces and moments of both sides remain equal.
  void handOn() {
    const std::map<int, int> heirs = findHeirs();
    if (heirs.empty()) return;
    for (const auto& [node, heir] : heirs) rowNormals_[node] = rowNormals_.at(heir);
    rows_.clear();
    for (int side = 0; side < surface_.sides(); ++side) addRows(side);
    for (const auto& [node, heir] : heirs) {
      const auto row = rows_.find(node);
      if (row == rows_.end()) continue;
      rows_[heir].adopt(row->second);
      rows_.erase(node);
    }
  }

  /// Covered part from which on a decision is made. \param was  the earlier decision
  double limitOf(double limit, bool was) const { return kept_.onA && !was ? limit + kBand : limit; }
  /// A node of both faces, as at the tip of a crack, cannot separate from itself: it carries no condition.
  bool isShared(int node) const { return other_ && other_->nodes().count(node) > 0; }
  bool isReached(int node) const {
    const double limit = limitOf(MortarSamples::kReach, kept_.reached.count(node) > 0);
    return reach_.at(node) >= limit && !halved_.count(node) && !isShared(node);
  }

  std::map<int, int> findHeirs() const {
    std::map<int, int> heirs;
    for (const auto& entry : rows_) {
      const int node = entry.first;
      if (isReached(node)) continue;
      double least = 0;
      const auto look = [&](int from) {
        for (const int other : surface_.nodesNear(from)) {  // two steps, for the vertices of quadratic elements
          if (!rows_.count(other) || !isReached(other)) continue;
          const double away = norm(minus(surface_.at(other).position, surface_.at(node).position));
          if (!heirs.count(node) || away < least) heirs[node] = other, least = away;
        }
      };
      look(node);
      if (!heirs.count(node))  // a corner that is covered at its tip only
        for (const int near : surface_.nodesNear(node)) look(near);
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
    if (row.tookOver) {
      Point way{0, 0, 0};
      for (const auto& [at, value] : row.own) way = plus(way, scaled(value / row.weight, minus(surface_.at(at).position, pair.position)));
      pair.position = plus(pair.position, way);
      if (surface_.dimension() == 2) pair.arc += dot(way, {-normal[1], normal[0], 0});
    }
    pair.ends.push_back({node, sign_ * row.own.at(node) / row.weight});
    std::map<int, double> own = row.own, others = row.others;
    for (auto& [at, value] : others)
      if (const auto shared = own.find(at); shared != own.end()) value -= std::exchange(shared->second, 0.0);
    const auto add = [&](int at, double weight) {
      if (std::abs(weight) > 1e-12) pair.ends.push_back({at, weight});
    };
    for (const auto& [at, value] : own)
      if (at != node) add(at, sign_ * value / row.weight);
    pair.own = static_cast<int>(pair.ends.size());
    for (const auto& [at, value] : others) add(at, -sign_ * value / row.weight);
    return pair;
  }

  const ContactSurface& contact_;
  const MortarChoices kept_;  // choices on the last shapes, if this face carried there
  double sign_;
  const Surface& surface_;
  const Surface* other_;
  std::unique_ptr<const MortarSampling> sampling_;
  std::map<int, Row> rows_;          // by carrying node
  std::map<int, Point> rowNormals_;  // by node
  std::map<int, double> reach_;      // by node: largest value of its linear function on the covered part
  std::set<int> linearSides_;        // sides covered in part, with linear functions
  std::set<int> halved_;             // mid-side nodes that transfer their share
  std::set<int> whole_;              // sides covered entirely
  double coveredIntervals_ = 0, leastCovered_ = 1;
  bool coverageKnown_ = false, integrated_ = false;
};

std::unique_ptr<Mortar> mortarOn(bool onA, const Mesh& mesh, const ContactSurface& contact) {
  const ContactFace &own = onA ? contact.a : contact.b, &other = onA ? contact.b : contact.a;
  return std::make_unique<Mortar>(contact, *own.surface, &*other.surface, onA ? 1.0 : -1.0, samplingOf(mesh, contact, onA));
}

/// True if side A should carry. This is the side that the other covers entirely, where the stress ends with the side and not inside an
/// element, except where two-node elements meet a curve and that side is much finer: its pressures would then contain the shape error that
/// the coarser side cannot follow. If both or neither are covered, it is there the side with fewer nodes on the common part, otherwise the
/// side with more nodes, which resolves the stress better and has one node per condition.
bool carriesBetter(Mortar& a, Mortar& b) {
  const bool faceted = a.isFaceted();
  if (a.coversAll() != b.coversAll()) {
    Mortar &covered = a.coversAll() ? a : b, &other = a.coversAll() ? b : a;
    if (!faceted || covered.coveredIntervals() < kMuchFiner * other.coveredIntervals()) return a.coversAll();
  }
  return faceted ? a.coveredIntervals() <= b.coveredIntervals() : a.nodes() >= b.nodes();
}

std::unique_ptr<Mortar> makeMortar(const Mesh& mesh, const ContactSurface& contact) {
  using Carrier = ContactSurface::Carrier;
  if (contact.choices && contact.choices->onA) return mortarOn(*contact.choices->onA, mesh, contact);
  if (contact.carrier != Carrier::Automatic) return mortarOn(contact.carrier == Carrier::SideA, mesh, contact);
  auto a = mortarOn(true, mesh, contact), b = mortarOn(false, mesh, contact);
  return carriesBetter(*a, *b) ? std::move(a) : std::move(b);
}

/// Warns if the side selected in the scene to carry the stress is the finer one.
void warnOfFinerCarrier(const Mesh& mesh, const ContactSurface& contact, Mortar& mortar, std::vector<std::string>& notes) {
  const bool onA = contact.carrier == ContactSurface::Carrier::SideA;
  if (contact.carrier == ContactSurface::Carrier::Automatic || !mortar.isFaceted()) return;
  const std::unique_ptr<Mortar> other = mortarOn(!onA, mesh, contact);
  if (!(mortar.coveredIntervals() >= kMuchFiner * other->coveredIntervals())) return;
  std::ostringstream text;
  text << "warning: " << contact.path << "/Multipliers On: " << (onA ? "Side A" : "Side B") << " is curved and has " << std::setprecision(2)
       << mortar.coveredIntervals() / other->coveredIntervals()
       << " elements per element of the other side, whose straight elements cannot follow it: nodal pressures may alternate between zero "
          "and twice the correct value; choose Automatic, which selects the coarser side";
  notes.push_back(text.str());
}

/// Warns of conditions whose covered part is a small part of an element.
void warnOfSmallParts(const Mesh& mesh, const ContactSurface& contact, Mortar& mortar, std::vector<std::string>& notes) {
  const std::vector<int> nodes = mortar.unreached();
  if (nodes.empty()) return;
  std::ostringstream text;
  text << "warning: contact '" << contact.name << "': its sides share only part of an element at "
       << placeText(mesh.point(nodes.front()), mesh.dimension);
  if (nodes.size() > 1) text << " and at " << nodes.size() - 1 << " more nodes";
  text << ": pressures there are means over parts much smaller than the elements. Select the other side in Multipliers On, or refine";
  notes.push_back(text.str());
}

}  // namespace

PairedSurface mortarPairs(const ContactSurface& contact, std::unique_ptr<const MortarSampling> sampling) {
  return Mortar(contact, *contact.a.surface, nullptr, 1.0, std::move(sampling)).pairs();
}

PairedSurface mortarPairs(const Mesh& mesh, const ContactSurface& contact, Problems& problems, std::vector<std::string>& notes) {
  const std::unique_ptr<Mortar> mortar = makeMortar(mesh, contact);
  PairedSurface result = mortar->pairs();
  if (contact.choices) *contact.choices = mortar->choices();
  if (result.pairs.empty())
    problems.add(contact.path, "the sides " + contact.a.name() + " and " + contact.b.name() +
                                   " overlap nowhere: no normal of one side meets the other. Do the bodies lie on opposite sides of the " +
                                   (mesh.dimension == 2 ? "line?" : "surface?"));
  else {
    warnOfFinerCarrier(mesh, contact, *mortar, notes);
    warnOfSmallParts(mesh, contact, *mortar, notes);
  }
  return result;
}

}  // namespace suture
