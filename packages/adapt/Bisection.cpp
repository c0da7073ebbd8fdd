#include <suture/adapt/Bisection.hpp>
#include <suture/adapt/InitialMarks.hpp>
#include <suture/adapt/PassOnGroups.hpp>
#include <suture/adapt/SimplexSides.hpp>
#include <suture/adapt/SplitEdges.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kStraight = 1e-12;  // distance of a mid-side node from the middle over the length of the edge

/// Sides of elements that belong to groups or to round shapes, numbered from 1 (tags); 0 for all others.
class SideTags {
 public:
  explicit SideTags(const RefinableMesh& coarse) : sides_(coarse.mesh.dimension + 1) {
    tags_.assign(static_cast<std::size_t>(coarse.mesh.elements()) * sides_, 0);
    for (const auto& [name, sides] : coarse.mesh.sideGroups)
      for (const Side& side : sides) number(side);
    for (const auto& [side, shape] : coarse.round.sides) number(side);
  }
  int of(const Side& side) const { return tags_[static_cast<std::size_t>(side.element) * sides_ + side.side]; }
  int count() const { return count_; }

 private:
  void number(const Side& side) {
    int& tag = tags_[static_cast<std::size_t>(side.element) * sides_ + side.side];
    if (tag == 0) tag = ++count_;
  }
  int sides_, count_ = 0;
  std::vector<int> tags_;
};

template <int D>
class Refiner {
 public:
  Refiner(const RefinableMesh& coarse, const std::vector<char>& marked)
      : coarse_(coarse),
        old_(coarse.mesh),
        splits_(coarse, marked),
        tags_(coarse),
        parts_(static_cast<std::size_t>(tags_.count()) + 1),
        middles_(splits_.nodes()),
        isSecond_(old_.elements() > 0 && cellInfo(old_.cells[0]).order == 2) {}

  Refinement refine() {
    placeVertices();
    cutElements();
    checkNodes();
    passOnGroups();
    result_.fine.twins = splits_.twins().pairs();
    placeOnShapes(mesh(), result_.fine.round, result_.fine.twins, old_.nodes());
    return std::move(result_);
  }

 private:
  using Simplex = MarkedSimplex<D>;
  using Places = std::array<std::array<float, 3>, D + 1>;  // reference coordinates of the vertices

  Mesh& mesh() { return result_.fine.mesh; }

  void placeVertices() {
    mesh().dimension = D;
    mesh().source = old_.source;
    mesh().notes = old_.notes;
    mesh().axisymmetric = old_.axisymmetric;
    mesh().bodies = old_.bodies;
    mesh().bodyOfNode = old_.bodyOfNode;
    mesh().coordinates = old_.coordinates;
    mesh().coordinates.resize(static_cast<std::size_t>(splits_.nodes()) * D);
    result_.origins.resize(static_cast<std::size_t>(splits_.nodes() - old_.nodes()));
    for (std::size_t i = 0; i < splits_.ends().size(); ++i) {
      const auto& [p, q] = splits_.ends()[i];
      setPoint(old_.nodes() + static_cast<int>(i), scaled(0.5, plus(mesh().point(p), mesh().point(q))));
    }
    if (!old_.bodyOfNode.empty()) mesh().bodyOfNode.resize(static_cast<std::size_t>(splits_.nodes()), -1);
  }

  void setPoint(int node, const Point& at) {
    for (int k = 0; k < D; ++k) mesh().coordinates[static_cast<std::size_t>(node) * D + k] = at[k];
  }

  void cutElements() {
    first_.reserve(static_cast<std::size_t>(old_.elements()) + 1);
    for (int e = 0; e < old_.elements(); ++e) {
      first_.push_back(mesh().elements());
      Simplex whole = splits_.simplex(e);
      const auto side = sideOppositeVertex(D);
      for (int k = 0; k <= D; ++k) whole.tags[k] = tags_.of({e, side[k]});
      element_ = e;
      if (!splits_.mayBeSplit(e) || !splits_.isSplit(whole)) {
        append(whole);
        for (std::size_t k = D + 1; k < old_.nodesOf(e).size(); ++k) mesh().connectivity.push_back(old_.nodesOf(e)[k]);
        mesh().offsets.push_back(static_cast<int>(mesh().connectivity.size()));
        continue;
      }
      isStraight_ = isSecond_ && isStraight(e);
      Places places{};
      for (int k = 1; k <= D; ++k) places[k][k - 1] = 1;
      cut(whole, places);
    }
    first_.push_back(mesh().elements());
  }

  void cut(const Simplex& part, const Places& places) {
    if (!splits_.isSplit(part)) {
      append(part);
      if (isSecond_) appendMiddles(part, places);
      mesh().offsets.push_back(static_cast<int>(mesh().connectivity.size()));
      return;
    }
    const int node = splits_.middle(part.vertices[0], part.vertices[1]);
    std::array<float, 3> at;
    for (int k = 0; k < 3; ++k) at[k] = 0.5f * (places[0][k] + places[1][k]);
    if (node >= old_.nodes()) setOrigin(node, at);
    const auto [one, other] = bisected<D>(part, node);
    cut(one, placesOf(one, part, places, at));
    cut(other, placesOf(other, part, places, at));
  }

  static Places placesOf(const Simplex& child, const Simplex& part, const Places& places, const std::array<float, 3>& middle) {
    Places own;
    own.fill(middle);
    for (int i = 0; i <= D; ++i)
      for (int k = 0; k <= D; ++k)
        if (child.vertices[i] == part.vertices[k]) own[i] = places[k];
    return own;
  }

  void setOrigin(int node, const std::array<float, 3>& at) {
    NodeOrigin& origin = result_.origins[static_cast<std::size_t>(node - old_.nodes())];
    if (origin.element >= 0) return;
    origin = {element_, at};
    if (!old_.bodyOfNode.empty()) mesh().bodyOfNode[node] = old_.bodyOfNode[old_.nodesOf(element_)[0]];
    if (isSecond_ && !isStraight_) setPoint(node, pointAt(old_, origin));
  }

  /// Adds the vertices of a part, and notes its sides.
  void append(const Simplex& part) {
    const int number = mesh().elements();
    mesh().cells.push_back(old_.cells[element_]);
    if (D == 3) result_.fine.marks.push_back(part.marks);
    result_.parent.push_back(element_);
    if (!old_.bodyOfElement.empty()) mesh().bodyOfElement.push_back(old_.bodyOfElement[element_]);
    if (!old_.regions.empty()) mesh().regions.push_back(old_.regions[element_]);
    const auto side = sideOppositeVertex(D);
    for (int k = 0; k <= D; ++k) {
      mesh().connectivity.push_back(part.vertices[k]);
      if (part.tags[k] > 0) parts_[part.tags[k]].push_back({number, side[k]});
    }
  }

  void appendMiddles(const Simplex& part, const Places& places) {
    for (const auto& [i, j] : cellInfo(old_.cells[element_]).edges) {
      const int p = part.vertices[i], q = part.vertices[j];
      int node = oldMiddle(p, q);
      if (node < 0) node = middles_.at(p, q);
      if (node < 0) {
        node = mesh().nodes();
        middles_.add(p, q, node);
        const Point at = scaled(0.5, plus(mesh().point(p), mesh().point(q)));
        mesh().coordinates.insert(mesh().coordinates.end(), at.begin(), at.begin() + D);
        if (!old_.bodyOfNode.empty()) mesh().bodyOfNode.push_back(-1);
        result_.origins.emplace_back();
        std::array<float, 3> place;
        for (int k = 0; k < 3; ++k) place[k] = 0.5f * (places[i][k] + places[j][k]);
        setOrigin(node, place);
      }
      mesh().connectivity.push_back(node);
    }
  }

  /// Mid-side node of an edge of the coarse element that is not split; -1 for other edges.
  int oldMiddle(int p, int q) const {
    const Span<const int> nodes = old_.nodesOf(element_);
    const CellInfo& cell = cellInfo(old_.cells[element_]);
    for (std::size_t k = 0; k < cell.edges.size(); ++k) {
      const int a = nodes[cell.edges[k][0]], b = nodes[cell.edges[k][1]];
      if ((a == p && b == q) || (a == q && b == p)) return nodes[cell.vertices + k];
    }
    return -1;
  }

  bool isStraight(int e) const {
    const Span<const int> nodes = old_.nodesOf(e);
    const CellInfo& cell = cellInfo(old_.cells[e]);
    for (std::size_t k = 0; k < cell.edges.size(); ++k) {
      const Point a = old_.point(nodes[cell.edges[k][0]]), b = old_.point(nodes[cell.edges[k][1]]);
      const Point off = minus(old_.point(nodes[cell.vertices + k]), scaled(0.5, plus(a, b)));
      if (norm(off) > kStraight * norm(minus(b, a))) return false;
    }
    return true;
  }

  /// An edge of a contact face that is split on one side only leaves a node that no element has.
  void checkNodes() const {
    for (const NodeOrigin& origin : result_.origins)
      if (origin.element < 0) throw InternalError("bisection with opposite nodes that are not those of the levels before");
  }

  void passOnGroups() {
    passOnElementGroups(old_, first_, mesh());
    for (const auto& [name, sides] : old_.sideGroups) {
      std::vector<Side>& own = mesh().sideGroups[name];
      for (const Side& side : sides) own.insert(own.end(), parts_[tags_.of(side)].begin(), parts_[tags_.of(side)].end());
    }
    result_.fine.round.shapes = coarse_.round.shapes;
    for (const auto& [side, shape] : coarse_.round.sides)
      for (const Side& part : parts_[tags_.of(side)]) result_.fine.round.sides.emplace_back(part, shape);
  }

  const RefinableMesh& coarse_;
  const Mesh& old_;
  const SplitEdges<D> splits_;
  const SideTags tags_;
  std::vector<std::vector<Side>> parts_;  ///< by tag: sides of the fine mesh
  EdgeNodes middles_;                     ///< new mid-side nodes
  bool isSecond_;
  std::vector<int> first_;  ///< first part of each element
  int element_ = -1;        ///< the coarse element being cut
  bool isStraight_ = false;
  Refinement result_;
};

void check(const Mesh& mesh) {
  if (!mesh.coatings.empty()) throw InternalError("bisection of a mesh with coatings");
  const auto isOther = [&](Cell cell) { return cell != mesh.cells[0]; };
  if (mesh.elements() > 0 && (!isSimplex(mesh.cells[0]) || std::any_of(mesh.cells.begin(), mesh.cells.end(), isOther)))
    throw InternalError("bisection of cells other than triangles or tetrahedra of one order");
}

}  // namespace

RefinableMesh refinable(Mesh mesh, std::vector<NodePairs> twins, Boundary boundary) {
  check(mesh);
  RefinableMesh result;
  result.marks = markLongestEdges(mesh, twins);
  if (boundary == Boundary::Round) {
    result.round = findRoundSides(mesh);
    placeMiddlesOpposite(mesh, result.round, twins);
  }
  result.mesh = std::move(mesh);
  result.twins = std::move(twins);
  return result;
}

Refinement bisect(const RefinableMesh& coarse, const std::vector<char>& marked) {
  check(coarse.mesh);
  if (static_cast<int>(marked.size()) != coarse.mesh.elements()) throw InternalError("marks of another mesh");
  return coarse.mesh.dimension == 2 ? Refiner<2>(coarse, marked).refine() : Refiner<3>(coarse, marked).refine();
}

Matrix Refinement::interpolated(const Mesh& coarse, const Matrix& values) const {
  Matrix result(coarse.nodes() + static_cast<Eigen::Index>(origins.size()), values.cols());
  result.topRows(coarse.nodes()) = values;
  result.bottomRows(static_cast<Eigen::Index>(origins.size())) = valuesAt(coarse, origins, values);
  return result;
}

}  // namespace suture
