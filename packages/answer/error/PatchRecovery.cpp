#include <algorithm>
#include <array>
#include <cmath>
#include <suture/answer/error/PatchMoments.hpp>
#include <suture/answer/error/PatchRecovery.hpp>
#include <suture/base/Point.hpp>
#include <suture/elasticity/ElementStress.hpp>

namespace suture {

using namespace patch;

namespace {

// Largest variance of the stress at the vertex for unit variance at the points: (A^-1)_00. It is a few tenths in the interior of a body;
// more than this value is extrapolation. Boundary patches of quadratic triangles pass, those of other cells do not.
constexpr double mostAmplified = 2.0;
// Weights of the neighbours' points where a patch alone is not enough: the first of these weights for which the variance at the vertex does
// not exceed that of one point. For quadratic quadrilaterals the neighbours then determine only the curvature across the boundary. (Where
// the stress is not smooth, at the end of contact, the neighbours' polynomial is far from the stress at the vertex.)
constexpr double weights[] = {0.001, 0.1, 1.0};
constexpr double mostAmplifiedJoined = 1.0;
// Fraction of the total squared norm that replaces a smaller norm of the computed stress: the error of displacements without stress is then
// relative to it.
constexpr double kLeastNorm = 1e-16;

/// Laws of the elements' materials, cached from one element to the next.
template <int D>
class Laws {
 public:
  explicit Laws(PlaneModel plane) : plane_(plane) {}
  const HookesLaw<D>& of(const Material& material) {
    if (&material != last_) law_ = HookesLaw<D>(material, plane_);
    last_ = &material;
    return law_;
  }

 private:
  PlaneModel plane_;
  const Material* last_ = nullptr;
  HookesLaw<D> law_;
};

/// Vertices at the other ends of the edges of each vertex of a cell.
struct OtherEnds {
  std::array<std::array<int, 4>, 8> of{};
  std::array<int, 8> count{};
};

OtherEnds makeOtherEnds(const CellInfo& cell) {
  OtherEnds ends;
  for (const int from : {0, 1})
    for (const auto& edge : cell.edges) {
      const auto vertex = std::size_t(edge[from]);
      ends.of[vertex][std::size_t(ends.count[vertex]++)] = edge[1 - from];
    }
  return ends;
}

const OtherEnds& otherEnds(Cell cell) {
  static const std::array<OtherEnds, kCells> all = [] {
    std::array<OtherEnds, kCells> made;
    for (int c = 0; c < kCells; ++c) made[std::size_t(c)] = makeOtherEnds(cellInfo(static_cast<Cell>(c)));
    return made;
  }();
  return all[static_cast<std::size_t>(cell)];
}

}  // namespace

PatchRecovery::PatchRecovery(const CellBlock& block, Materials materialOf, PlaneModel plane, Vector displacement, InitialState initial)
    : block_(&block),
      materialOf_(std::move(materialOf)),
      plane_(plane),
      displacement_(std::move(displacement)),
      initial_(std::move(initial)),
      patches_(block, materialOf_) {
  origin_.assign(patches_.all.size(), Origin::None);
}

int PatchRecovery::order() const {
  int most = 1;
  for (const Cell cell : block_->cells) most = std::max(most, cellInfo(cell).order);
  return most;
}

template <int D>
Matrix PatchRecovery::moments() const {
  const Layout<D> layout(order_);
  Matrix all = Matrix::Zero(layout.width(), patches_.count());
  Laws<D> laws(plane_);
  for (int e = 0; e < block_->elements(); ++e) {
    const ReferenceElement& sampling = referenceElement(block_->cells[e], Rule::Sampling);
    const Span<const int> patches = patchesOf(e);
    ElementStress<D> element(*block_, e, sampling, laws.of(materialOf_(e)), displacement_, initial_);
    for (int q = 0; q < sampling.points; ++q) {
      element.at(q);
      const StressVector<D> stress = element.stress();
      const Point place = element.map().place();
      for (const int patch : patches) {
        const Point vertex = placeOf(patch);
        layout.addPoint(monomials<D>(minus(place, vertex), order_), stress, all.col(patch).data());
      }
    }
    for (const int patch : patches) all(layout.quadratic(), patch) += cellInfo(block_->cells[e]).order > 1;
  }
  return all;
}

template <int D>
void PatchRecovery::fitAlone(const Matrix& moments) {
  const Layout<D> layout(order_);
  polynomials_ = Matrix::Zero(layout.terms * components<D>, moments.cols());
  for (Eigen::Index p = 0; p < moments.cols(); ++p) {
    const double* column = moments.col(p).data();
    if (fit(layout, column, column, layout.orderOfPatch(column), mostAmplified, polynomials_.col(p))) origin_[p] = Origin::Own;
  }
}

// Counted by elements, not by edges and vertices: several subdomains share an edge on a seam, but only one has the element.
template <int D>
Matrix PatchRecovery::acrossEdges(const Matrix& moments) const {
  const Layout<D> layout(order_);
  Matrix all = Matrix::Zero(moments.rows(), moments.cols());
  for (int e = 0; e < block_->elements(); ++e) {
    const Span<const int> patches = patchesOf(e);
    const OtherEnds& ends = otherEnds(block_->cells[e]);
    for (std::size_t v = 0; v < patches.size(); ++v)
      for (int k = 0; k < ends.count[v]; ++k) {
        const int to = patches[v], from = patches[std::size_t(ends.of[v][std::size_t(k)])];
        if (origin_[to] != Origin::None || origin_[from] != Origin::Own) continue;
        layout.addShifted(moments.col(from).data(), placeOf(from), placeOf(to), all.col(to).data());
      }
  }
  return all;
}

template <int D>
void PatchRecovery::fitJoined(const Matrix& moments, const Matrix& neighbours) {
  const Layout<D> layout(order_);
  for (Eigen::Index p = 0; p < moments.cols(); ++p) {
    if (neighbours(layout.points(), p) == 0.0) continue;
    for (const double weight : weights) {
      const Vector column = moments.col(p) + weight * neighbours.col(p);
      const Vector variances = moments.col(p) + weight * weight * neighbours.col(p);
      if (!fit(layout, column.data(), variances.data(), layout.orderOfPatch(column.data()), mostAmplifiedJoined, polynomials_.col(p)))
        continue;
      origin_[p] = Origin::Neighbours;
      break;
    }
  }
}

// Counted by elements, too.
template <int D>
Matrix PatchRecovery::fromNeighbours() const {
  const int terms = termsOf<D>(order_), width = terms * components<D>;
  Matrix sums = Matrix::Zero(width + 1, polynomials_.cols());
  for (int e = 0; e < block_->elements(); ++e) {
    const Span<const int> patches = patchesOf(e);
    for (const int to : patches) {
      if (origin_[to] != Origin::None) continue;
      for (const int from : patches) {
        if (origin_[from] == Origin::None) continue;
        Eigen::Map<Matrix>(sums.col(to).data(), terms, components<D>) +=
            shift<D>(minus(placeOf(to), placeOf(from)), order_).transpose() *
            Eigen::Map<const Matrix>(polynomials_.col(from).data(), terms, components<D>);
        sums(width, to) += 1.0;
      }
    }
  }
  return sums;
}

void PatchRecovery::takeFromNeighbours(const Matrix& sums) {
  const Eigen::Index width = polynomials_.rows();
  for (Eigen::Index p = 0; p < sums.cols(); ++p)
    if (sums(width, p) > 0.0) {
      polynomials_.col(p) = sums.col(p).head(width) / sums(width, p);
      origin_[p] = Origin::Neighbours;
    }
}

template <int D>
Matrix PatchRecovery::enlarged(const Matrix& moments) const {
  const Layout<D> layout(order_);
  Matrix all = Matrix::Zero(moments.rows(), moments.cols());
  for (int e = 0; e < block_->elements(); ++e)
    for (const int to : patchesOf(e)) {
      if (origin_[to] != Origin::None) continue;
      for (const int from : patchesOf(e)) layout.addShifted(moments.col(from).data(), placeOf(from), placeOf(to), all.col(to).data());
    }
  return all;
}

template <int D>
void PatchRecovery::fitEnlarged(const Matrix& moments) {
  const Layout<D> layout(order_);
  for (Eigen::Index p = 0; p < moments.cols(); ++p) {
    if (origin_[p] != Origin::None) continue;
    const double* column = moments.col(p).data();
    for (int order = layout.orderOfPatch(column); order >= 0 && origin_[p] == Origin::None; --order)
      if (fit(layout, column, column, order, mostAmplified, polynomials_.col(p))) origin_[p] = Origin::Own;
  }
}

bool PatchRecovery::unfitted() const { return std::find(origin_.begin(), origin_.end(), Origin::None) != origin_.end(); }

// Recovered stresses at the nodes of an element.
template <int D>
void PatchRecovery::nodalOf(int e, Nodal<D>& nodal) const {
  const int terms = termsOf<D>(order_);
  const CellInfo& cell = cellInfo(block_->cells[e]);
  const Span<const int> nodes = block_->nodesOf(e), patches = patchesOf(e);
  for (int v = 0; v < cell.vertices; ++v)
    for (int k = 0; k < components<D>; ++k) nodal(k, v) = polynomials_(k * terms, patches[v]);
  if (cell.order == 1) return;
  const auto setMean = [&](int node, const int* vertices, int count) {
    const Point at = block_->point(nodes[node]);
    StressVector<D> sum = StressVector<D>::Zero();
    for (int i = 0; i < count; ++i) {
      const int patch = patches[vertices[i]];
      sum += Eigen::Map<const Matrix>(polynomials_.col(patch).data(), terms, components<D>).transpose() *
             monomials<D>(minus(at, placeOf(patch)), order_);
    }
    nodal.col(node) = (1.0 / count) * sum;
  };
  int node = cell.vertices;
  for (const auto& edge : cell.edges) setMean(node++, edge.data(), 2);
  if (D == 3)
    for (const std::vector<int>& side : cell.sideNodes)
      if (side.size() == 9) setMean(side[8], side.data(), 4), ++node;
  constexpr int all[] = {0, 1, 2, 3, 4, 5, 6, 7};
  if (node < cell.nodes) setMean(node, all, cell.vertices);
}

template <int D>
Matrix PatchRecovery::sumsAtNodes() const {
  Matrix sums = Matrix::Zero(components<D> + 1, block_->nodes());
  Nodal<D> nodal;
  for (int e = 0; e < block_->elements(); ++e) {
    nodalOf<D>(e, nodal);
    const Span<const int> nodes = block_->nodesOf(e);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      sums.col(nodes[a]).template head<components<D>>() += nodal.col(a);
      sums(components<D>, nodes[a]) += 1.0;
    }
  }
  return sums;
}

Matrix PatchRecovery::nodalSums() const { return block_->dimension == 2 ? sumsAtNodes<2>() : sumsAtNodes<3>(); }

ElementErrors PatchRecovery::errors() const { return block_->dimension == 2 ? errorsOfElements<2>() : errorsOfElements<3>(); }

template <int D>
ElementErrors PatchRecovery::errorsOfElements() const {
  ElementErrors all{Vector::Zero(block_->elements()), Vector::Zero(block_->elements())};
  Laws<D> laws(plane_);
  Nodal<D> nodal;
  for (int e = 0; e < block_->elements(); ++e) {
    const HookesLaw<D>& law = laws.of(materialOf_(e));
    const Cell cell = block_->cells[e];
    nodalOf<D>(e, nodal);
    if (isSimplex(cell) && cellInfo(cell).order == 1 && !block_->axisymmetric && !initial_.isIn(e)) {
      // A linear difference: exact mass matrix.
      ElementStress<D> element(*block_, e, referenceElement(cell, Rule::Sampling), law, displacement_, initial_);
      element.at(0);
      const StressVector<D> stress = element.stress();
      StressVector<D> sum = StressVector<D>::Zero();
      double squares = 0.0;
      for (int v = 0; v <= D; ++v) {
        const StressVector<D> difference = nodal.col(v) - stress;
        sum += difference;
        squares += law.complementary(difference);
      }
      all.error[e] = element.map().measure() / ((D + 1.0) * (D + 2.0)) * (squares + law.complementary(sum));
      all.norm[e] = element.map().measure() * law.complementary(stress);
      continue;
    }
    const ReferenceElement& reference = referenceElement(cell, Rule::Recovery);
    ElementStress<D> element(*block_, e, reference, law, displacement_, initial_);
    for (int q = 0; q < reference.points; ++q) {
      element.at(q);
      const StressVector<D> stress = element.stress();
      StressVector<D> difference = -stress;
      for (int a = 0; a < reference.nodes; ++a) difference += reference.valuesAt(q)[a] * nodal.col(a);
      all.error[e] += element.map().measure() * law.complementary(difference);
      const double whole = law.complementary(stress);
      all.norm[e] += element.map().measure() *
                     (element.isInitial() ? std::max(law.complementary(element.ofDisplacement()), kLeastNorm * whole) : whole);
    }
  }
  return all;
}

template <int D>
void PatchRecovery::recover(std::vector<PatchRecovery>& blocks, const PatchExchange& exchange) {
  int order = 1;
  for (const PatchRecovery& block : blocks) order = std::max(order, block.order());
  order = exchange.largest(order);
  const auto summed = [&](const auto& ofBlock) {
    std::vector<Matrix> all;
    exchange.local([&] {
      for (const PatchRecovery& block : blocks) all.push_back(ofBlock(block));
    });
    exchange.sum(all);
    return all;
  };
  const auto unfitted = [&] {
    const bool any = std::any_of(blocks.begin(), blocks.end(), [](const PatchRecovery& block) { return block.unfitted(); });
    return exchange.largest(any) > 0;
  };

  for (PatchRecovery& block : blocks) block.order_ = order;
  const std::vector<Matrix> moments = summed([](const PatchRecovery& block) { return block.template moments<D>(); });
  for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].template fitAlone<D>(moments[i]);
  if (unfitted()) {
    const std::vector<Matrix> sums =
        summed([&](const PatchRecovery& block) { return block.template acrossEdges<D>(moments[std::size_t(&block - blocks.data())]); });
    for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].template fitJoined<D>(moments[i], sums[i]);
  }
  // Two passes: a corner may have no neighbour with its own polynomial, but neighbours that get one in the first pass.
  for (int pass = 0; pass < 2 && unfitted(); ++pass) {
    const std::vector<Matrix> sums = summed([](const PatchRecovery& block) { return block.template fromNeighbours<D>(); });
    for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].takeFromNeighbours(sums[i]);
  }
  if (!unfitted()) return;
  const std::vector<Matrix> larger =
      summed([&](const PatchRecovery& block) { return block.template enlarged<D>(moments[std::size_t(&block - blocks.data())]); });
  for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].template fitEnlarged<D>(larger[i]);
}

void recoverPatches(std::vector<PatchRecovery>& blocks, const PatchExchange& exchange) {
  // A rank without blocks takes part in the exchanges of the others.
  const bool inSpace = exchange.largest(blocks.empty() ? 0 : blocks.front().block_->dimension) == 3;
  inSpace ? PatchRecovery::recover<3>(blocks, exchange) : PatchRecovery::recover<2>(blocks, exchange);
}

}  // namespace suture
