#include <suture/constraints/BoundaryLine.hpp>
#include <suture/constraints/MortarPairs.hpp>
#include <suture/mesh/SideShape.hpp>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <sstream>

namespace suture {

namespace {

using Chain = BoundaryLine::Chain;

constexpr double kSamePlace = 1e-10;  // of an element's reference interval
constexpr double kFacing = 0.5;       // cosine of the angle up to which two normals are opposite
constexpr double kStraight = 1e-6;    // angle between the normals at an element's ends
constexpr double kNoOverlap = 1e-6;   // of an element's length: less than what the strains of most scenes move
constexpr double kCovered = 0.2;      // of a hat function, below which its node carries no condition of its own

/// An element of one side as a curve on [-1, 1], the body on its left.
class Segment {
 public:
  Segment(const Mesh& mesh, const BoundaryLine& line, const std::vector<int>& nodes) : nodes_(nodes) {
    for (const int node : nodes) {
      points_.push_back(mesh.point(node));
      normals_.push_back(line.normal(node));
    }
    for (int end = 0; end < 2; ++end) endNormals_[end] = unit(normals_[end]);
  }
  const std::vector<int>& nodes() const { return nodes_; }
  int count() const { return static_cast<int>(nodes_.size()); }
  const Point& end(int which) const { return points_[which]; }
  // Ends at once: of most elements of the other side they alone are asked for.
  Point at(double xi) const { return xi == -1 ? points_[0] : xi == 1 ? points_[1] : mix(points_, sideShape(count(), xi).value); }
  Point tangent(double xi) const { return mix(points_, sideShape(count(), xi).slope); }  // of the length ds / d xi
  Point normal(double xi) const {
    return xi == -1 ? endNormals_[0] : xi == 1 ? endNormals_[1] : unit(mix(normals_, sideShape(count(), xi).value));
  }
  double length() const { return norm(minus(points_[1], points_[0])); }
  bool isCurved() const { return bend() > kStraight; }
  /// Height of the arc over a chord, h^2 / 8 R: how far a straight element is off the curve that its nodes lie on.
  double sagitta() const { return count() == 2 ? length() * bend() / 8 : 0.0; }

 private:
  double bend() const { return angleBetween(normals_[0], normals_[1]); }
  Point mix(const std::vector<Point>& points, const std::array<double, 3>& by) const {
    Point sum{0, 0, 0};
    for (int a = 0; a < count(); ++a)
      for (int k = 0; k < 2; ++k) sum[k] += by[a] * points[a][k];
    return sum;
  }
  std::vector<int> nodes_;
  std::vector<Point> points_, normals_;
  std::array<Point, 2> endNormals_;
};

/// Zero of a function on [-1, 1] that changes its sign there; nothing if it does not.
template <typename Function>
std::optional<double> zeroOf(const Function& f) {
  double low = -1, high = 1;
  const double atLow = f(low), atHigh = f(high);
  if (atLow == 0) return low;
  if (atHigh == 0) return high;
  if ((atLow > 0) == (atHigh > 0)) return std::nullopt;
  while (high - low > 1e-16) {
    const double middle = (low + high) / 2;
    if (middle == low || middle == high) break;
    ((f(middle) > 0) == (atLow > 0) ? low : high) = middle;
  }
  return (low + high) / 2;
}

class Mortar {
 public:
  Mortar(const Mesh& mesh, const ContactLine& line, bool onA)
      : mesh_(mesh),
        contact_(line),
        sign_(onA ? 1.0 : -1.0),
        line_(mesh, mesh.sideGroups.at(onA ? line.groupA : line.groupB)),
        otherLine_(mesh, mesh.sideGroups.at(onA ? line.groupB : line.groupA)),
        rule_(gaussRule(6)) {
    for (const Side& side : mesh.sideGroups.at(onA ? line.groupB : line.groupA)) other_.emplace_back(mesh, otherLine_, mesh.nodesOf(side));
    for (const Side& side : mesh.sideGroups.at(onA ? line.groupA : line.groupB)) integrate(Segment(mesh, line_, mesh.nodesOf(side)));
    handOn();
  }

  std::size_t nodes() const { return line_.nodes().size(); }
  /// Whether the other side stands opposite to all of this one.
  bool coversAll() const {
    double covered = 0, whole = 0;
    for (const auto& entry : rows_) covered += entry.second.weight;
    for (const auto& entry : line_.nodes()) whole += entry.second.tributary;
    return covered > (1 - 1e-6) * whole;
  }

  /// Where curved sides cut into each other by no more than their chords do; else empty.
  std::string overlap() const {
    if (overlap_.depth <= 0) return {};
    std::ostringstream text;
    text.precision(3);
    text << "contact '" << contact_.name << "': its sides are curved, but their elements straight, and cut into each other by up to "
         << overlap_.depth << " at (" << overlap_.place[0] << ", " << overlap_.place[1]
         << "): an error of the mesh (h^2 / 8 R) that contact pressures feel. Initial Gap = 0, where the bodies touch, or elements with "
            "middle nodes avoid it";
    return text.str();
  }

  PairedLine pairs() const {
    PairedLine result;
    for (const Chain& chain : line_.chains()) {
      const int n = static_cast<int>(chain.nodes.size());
      int begin = 0;  // a ring that is covered in part begins where a gap ends
      while (chain.closed && begin < n && rows_.count(chain.nodes[(begin + n - 1) % n])) ++begin;
      const bool closed = begin == n;
      for (int i = 0; i < n; ++i) {
        const int at = (begin + i) % n;
        const auto row = rows_.find(chain.nodes[at]);
        if (row == rows_.end()) continue;
        if (i == 0 || !rows_.count(chain.nodes[(at + n - 1) % n]))
          result.chains.push_back({static_cast<int>(result.pairs.size()), 0, closed});
        ++result.chains.back().count;
        result.pairs.push_back(pairOf(row->first, row->second, chain.arc[at], static_cast<int>(result.pairs.size())));
      }
    }
    return result;
  }

 private:
  /// Integrals of psi_j with: the shape functions of both sides by node, the gap, one.
  struct Row {
    std::map<int, double> own, others;
    double gap = 0, weight = 0;
    void add(const Row& row) {
      for (const auto& [node, value] : row.own) own[node] += value;
      for (const auto& [node, value] : row.others) others[node] += value;
      gap += row.gap;
      weight += row.weight;
    }
  };
  /// A point of both sides.
  struct Sample {
    double xi, weight, gap;
    const Segment* other;
    double eta;
  };
  struct Meeting {
    double eta, gap;
  };

  /// Where the normal at a point of the carrying side meets an element of the other, face to face.
  static std::optional<Meeting> meet(const Point& from, const Point& normal, const Segment& other) {
    const auto eta = zeroOf([&](double t) { return cross(minus(other.at(t), from), normal); });
    if (!eta) return std::nullopt;
    const Point tangent = other.tangent(*eta);
    if (dot(unit({tangent[1], -tangent[0], 0}), normal) > -kFacing) return std::nullopt;
    return Meeting{*eta, dot(minus(other.at(*eta), from), normal)};
  }

  /// Reference coordinates where elements of the other side begin or end, and the ends.
  std::vector<double> breaks(const Segment& own) const {
    std::vector<double> all{-1, 1};
    for (const Segment& other : other_)
      for (int end = 0; end < 2; ++end)
        if (const auto xi = zeroOf([&](double t) { return cross(minus(other.end(end), own.at(t)), own.normal(t)); })) all.push_back(*xi);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end(), [](double a, double b) { return b - a < kSamePlace; }), all.end());
    if (1 - all.back() < kSamePlace) all.back() = 1;
    return all;
  }

  const Segment* nearest(const Point& from, const Point& normal) const {
    const Segment* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const Segment& other : other_)
      if (const auto met = meet(from, normal, other); met && std::abs(met->gap) < least) {
        least = std::abs(met->gap);
        best = &other;
      }
    return best;
  }

  void noteOverlap(const Segment& own, const Segment& other, const Point& place, double depth) {
    if (depth <= std::max(overlap_.depth, kNoOverlap * own.length()) || !own.isCurved() || !other.isCurved()) return;
    // More than that, with a margin for coarse meshes and the ends of lines, is meant: an interference fit.
    if (depth < 2 * (own.sagitta() + other.sagitta())) overlap_ = {depth, place};
  }

  void integrate(const Segment& own) {
    std::vector<Sample> samples;
    double covered = 0;
    const std::vector<double> at = breaks(own);
    for (std::size_t s = 0; s + 1 < at.size(); ++s) {
      const double half = (at[s + 1] - at[s]) / 2, middle = (at[s] + at[s + 1]) / 2;
      const Segment* other = nearest(own.at(middle), own.normal(middle));
      if (!other) continue;
      covered += half;
      for (int q = 0; q < rule_.points.size(); ++q) {
        const double xi = middle + half * rule_.points(q);
        const Point from = own.at(xi), normal = own.normal(xi);
        const auto met = meet(from, normal, *other);
        if (!met) continue;  // beyond the element's end by rounding of its curve: of no weight
        if (!contact_.initialGap) noteOverlap(own, *other, from, -met->gap);
        const double gap = contact_.initialGap ? contact_.initialGap->at(from) : met->gap;
        double weight = half * rule_.weights(q) * norm(own.tangent(xi));
        if (mesh_.axisymmetric) weight *= circumference(from[0]);
        samples.push_back({xi, weight, gap, other, met->eta});
      }
    }
    if (samples.empty()) return;

    const int functions = covered > 1 - 1e-8 ? own.count() : 2;
    Matrix mass = Matrix::Zero(functions, functions);
    Vector integral = Vector::Zero(functions);
    const auto shape = [functions](double xi) -> Vector {
      const SideShape values = sideShape(functions, xi);
      return Eigen::Map<const Vector>(values.value.data(), functions);
    };
    for (const Sample& sample : samples) {
      const Vector chi = shape(sample.xi);
      mass += sample.weight * chi * chi.transpose();
      integral += sample.weight * chi;
    }
    const Matrix dual = integral.asDiagonal() * mass.ldlt().solve(Matrix::Identity(functions, functions));
    for (const Sample& sample : samples) {
      const Vector psi = sample.weight * (dual * shape(sample.xi));
      const SideShape phi = sideShape(own.count(), sample.xi), others = sideShape(sample.other->count(), sample.eta);
      for (int j = 0; j < functions; ++j) {
        Row& row = rows_[own.nodes()[j]];
        row.weight += psi(j);
        row.gap += psi(j) * sample.gap;
        for (int k = 0; k < own.count(); ++k) row.own[own.nodes()[k]] += psi(j) * phi.value[k];
        for (int k = 0; k < sample.other->count(); ++k) row.others[sample.other->nodes()[k]] += psi(j) * others.value[k];
      }
    }
  }

  /// Nodes that carry next to nothing hand on what they have, along the line, to the neighbour that carries more.
  void handOn() {
    const auto share = [&](int node) { return rows_.at(node).weight / line_.at(node).tributary; };
    for (const Chain& chain : line_.chains()) {
      const int n = static_cast<int>(chain.nodes.size());
      for (int i = 0; i < n; ++i) {
        const int node = chain.nodes[i];
        if (!rows_.count(node) || share(node) >= kCovered) continue;
        int heir = -1;
        for (const int step : {-2, -1, 1, 2}) {  // two, for the end points of quadratic elements
          const int at = chain.closed ? (i + step + n) % n : i + step;
          if (at < 0 || at >= n || !rows_.count(chain.nodes[at]) || share(chain.nodes[at]) < kCovered) continue;
          if (heir < 0 || share(chain.nodes[at]) > share(heir)) heir = chain.nodes[at];
        }
        if (heir < 0) continue;
        rows_[heir].add(rows_[node]);
        rows_.erase(node);
      }
    }
  }

  ContactPair pairOf(int node, const Row& row, double arc, int id) const {
    ContactPair pair;
    pair.id = id;
    pair.line = contact_.number;
    const Point normal = line_.normal(node);
    pair.normal = {sign_ * normal[0], sign_ * normal[1], 0};
    pair.gap = row.gap / row.weight;
    pair.length = row.weight;
    pair.arc = arc;
    pair.position = mesh_.point(node);
    pair.ends.push_back({node, sign_ * row.own.at(node) / row.weight});
    const auto add = [&](int at, double weight) {
      if (std::abs(weight) > 1e-12) pair.ends.push_back({at, weight});
    };
    for (const auto& [at, value] : row.own)
      if (at != node) add(at, sign_ * value / row.weight);
    for (const auto& [at, value] : row.others) add(at, -sign_ * value / row.weight);
    return pair;
  }

  const Mesh& mesh_;
  const ContactLine& contact_;
  double sign_;
  BoundaryLine line_, otherLine_;
  std::vector<Segment> other_;
  LineRule rule_;
  std::map<int, Row> rows_;  // by the node that carries it
  struct {
    double depth = 0.0;
    Point place{0, 0, 0};
  } overlap_;
};

/// The side that the other covers wholly, where the stress ends with the side and not inside an element; of two or none such that with more
/// nodes, which resolves the stress better and has a node of its own for each condition.
Mortar carriedByEither(const Mesh& mesh, const ContactLine& line) {
  Mortar a(mesh, line, true), b(mesh, line, false);
  if (a.coversAll() != b.coversAll()) return a.coversAll() ? a : b;
  return a.nodes() >= b.nodes() ? a : b;
}

}  // namespace

PairedLine mortarLine(const Mesh& mesh, const ContactLine& line, Problems& problems, std::vector<std::string>& notes) {
  const Mortar mortar = line.carrier == ContactLine::Carrier::Automatic ? carriedByEither(mesh, line)
                                                                        : Mortar(mesh, line, line.carrier == ContactLine::Carrier::SideA);
  PairedLine result = mortar.pairs();
  if (const std::string overlap = mortar.overlap(); !overlap.empty()) notes.push_back(overlap);
  if (result.pairs.empty())
    problems.add(line.path, "the sides '" + line.groupA + "' and '" + line.groupB +
                                "' overlap nowhere: no normal of one meets the other face to face. Do the bodies lie on opposite sides of "
                                "the line?");
  return result;
}

}  // namespace suture
