#include <algorithm>
#include <cmath>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElementStress.hpp>
#include <suture/quality/PatchMoments.hpp>
#include <suture/quality/PatchRecovery.hpp>

namespace suture {

using namespace patch;

namespace {

// Variance of the stress at the vertex where those at the points have a variance of one: (A^-1)_00. A few tenths in the middle of a body;
// more than this is extrapolation. Boundary patches of quadratic triangles pass, those of other cells do not.
constexpr double mostAmplified = 2.0;
// Where a patch alone is not enough, its neighbours' points count, too, but as little as possible: the first of these weights that leaves
// the vertex's value no larger a variance than that of one point. Of quadratic quadrilaterals they then decide the curvature across the
// boundary only. (Where the stress is not smooth, at the end of contact, the neighbours' polynomial is far from the stress at the vertex.)
constexpr double weights[] = {0.001, 0.1, 1.0};
constexpr double mostAmplifiedJoined = 1.0;
// Part of the whole norm squared that stands for displacements without stress: an error of theirs is then told relative to that.
constexpr double kLeastNorm = 1e-16;

/// The law of the material that elements have, one after the other.
class Laws {
 public:
  explicit Laws(PlaneModel plane) : plane_(plane) {}
  const HookesLaw& of(const Material& material) {
    if (&material != last_) law_ = HookesLaw(material, plane_);
    last_ = &material;
    return law_;
  }

 private:
  PlaneModel plane_;
  const Material* last_ = nullptr;
  HookesLaw law_;
};

}  // namespace

void PatchExchange::sum(std::vector<Matrix>&) const {}

PatchRecovery::PatchRecovery(const CellBlock& block, Materials materialOf, PlaneModel plane, Vector displacement, InitialState initial)
    : block_(&block),
      materialOf_(std::move(materialOf)),
      plane_(plane),
      displacement_(std::move(displacement)),
      initial_(std::move(initial)) {
  if (block.dimension != 2) throw InternalError("recovery of stresses in dimension " + std::to_string(block.dimension));
  std::vector<int> lastAt(block.nodes(), -1), before;  // patches of a node form a chain, of one link nearly everywhere
  for (int e = 0; e < block.elements(); ++e) {
    const Material& material = materialOf_(e);
    const Span<const int> nodes = block.nodesOf(e);
    for (int v = 0; v < cellInfo(block.cells[e]).vertices; ++v) {
      int patch = lastAt[nodes[v]];
      const auto ofAnother = [&](const Patch& p) {
        return p.young != material.young || p.poisson != material.poisson || p.material != material.number;
      };
      while (patch >= 0 && ofAnother(patches_[patch])) patch = before[patch];
      if (patch < 0) {
        patch = static_cast<int>(patches_.size());
        patches_.push_back({nodes[v], material.young, material.poisson, material.number});
        before.push_back(lastAt[nodes[v]]);
        lastAt[nodes[v]] = patch;
      }
      patchOf_.push_back(patch);
    }
    first_.push_back(static_cast<int>(patchOf_.size()));
  }
  origin_.assign(patches_.size(), Origin::None);
}

int PatchRecovery::order() const {
  int most = 1;
  for (const Cell cell : block_->cells) most = std::max(most, orderOf(cell));
  return most;
}

Matrix PatchRecovery::moments() const {
  const Layout layout(order_);
  Matrix all = Matrix::Zero(layout.width(), static_cast<Eigen::Index>(patches_.size()));
  Laws laws(plane_);
  for (int e = 0; e < block_->elements(); ++e) {
    const ReferenceElement& sampling = referenceElement(block_->cells[e], Rule::Sampling);
    const Span<const int> patches = patchesOf(e);
    ElementStress element(*block_, e, sampling, laws.of(materialOf_(e)), displacement_, initial_);
    for (int q = 0; q < sampling.points; ++q) {
      element.at(q);
      const Stress stress = element.stress();
      const Point place = element.map().place();
      for (const int patch : patches) {
        const Point vertex = placeOf(patch);
        layout.addPoint(monomials(place[0] - vertex[0], place[1] - vertex[1], order_), stress, all.col(patch).data());
      }
    }
    for (const int patch : patches) all(layout.quadratic(), patch) += orderOf(block_->cells[e]) > 1;
  }
  return all;
}

void PatchRecovery::fitAlone(const Matrix& moments) {
  const Layout layout(order_);
  polynomials_ = Matrix::Zero(layout.terms * components, moments.cols());
  for (Eigen::Index p = 0; p < moments.cols(); ++p) {
    const double* column = moments.col(p).data();
    if (fit(layout, column, column, layout.orderOfPatch(column), mostAmplified, polynomials_.col(p))) origin_[p] = Origin::Own;
  }
}

// Elements count, not sides and vertices: a side on a seam is seen from two subdomains, an element from one.
Matrix PatchRecovery::acrossSides(const Matrix& moments) const {
  const Layout layout(order_);
  Matrix all = Matrix::Zero(moments.rows(), moments.cols());
  for (int e = 0; e < block_->elements(); ++e) {
    const Span<const int> patches = patchesOf(e);
    for (std::size_t v = 0; v < patches.size(); ++v)
      for (const std::size_t w : {v + 1, v + patches.size() - 1}) {
        const int to = patches[v], from = patches[w % patches.size()];
        if (origin_[to] != Origin::None || origin_[from] != Origin::Own) continue;
        layout.addShifted(moments.col(from).data(), placeOf(from), placeOf(to), all.col(to).data());
      }
  }
  return all;
}

void PatchRecovery::fitJoined(const Matrix& moments, const Matrix& neighbours) {
  const Layout layout(order_);
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

// Elements count here, too.
Matrix PatchRecovery::fromNeighbours() const {
  const int terms = termsOf(order_), width = terms * components;
  Matrix sums = Matrix::Zero(width + 1, polynomials_.cols());
  for (int e = 0; e < block_->elements(); ++e) {
    const Span<const int> patches = patchesOf(e);
    for (const int to : patches) {
      if (origin_[to] != Origin::None) continue;
      for (const int from : patches) {
        if (origin_[from] == Origin::None) continue;
        const Point a = placeOf(from), b = placeOf(to);
        Eigen::Map<Matrix>(sums.col(to).data(), terms, components) +=
            shift(b[0] - a[0], b[1] - a[1], order_).transpose() *
            Eigen::Map<const Matrix>(polynomials_.col(from).data(), terms, components);
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

Matrix PatchRecovery::enlarged(const Matrix& moments) const {
  const Layout layout(order_);
  Matrix all = Matrix::Zero(moments.rows(), moments.cols());
  for (int e = 0; e < block_->elements(); ++e)
    for (const int to : patchesOf(e)) {
      if (origin_[to] != Origin::None) continue;
      for (const int from : patchesOf(e)) layout.addShifted(moments.col(from).data(), placeOf(from), placeOf(to), all.col(to).data());
    }
  return all;
}

void PatchRecovery::fitEnlarged(const Matrix& moments) {
  const Layout layout(order_);
  for (Eigen::Index p = 0; p < moments.cols(); ++p) {
    if (origin_[p] != Origin::None) continue;
    const double* column = moments.col(p).data();
    for (int order = layout.orderOfPatch(column); order >= 0 && origin_[p] == Origin::None; --order)
      if (fit(layout, column, column, order, mostAmplified, polynomials_.col(p))) origin_[p] = Origin::Own;
  }
}

bool PatchRecovery::unfitted() const { return std::find(origin_.begin(), origin_.end(), Origin::None) != origin_.end(); }

// Recovered stresses at the nodes of an element.
void PatchRecovery::nodalOf(int e, Nodal& nodal) const {
  const int terms = termsOf(order_);
  const Cell cell = block_->cells[e];
  const Span<const int> nodes = block_->nodesOf(e), patches = patchesOf(e);
  const auto valueAt = [&](int vertex, int node) -> Stress {
    const Point from = placeOf(patches[vertex]), at = block_->point(nodes[node]);
    return Eigen::Map<const Matrix>(polynomials_.col(patches[vertex]).data(), terms, components).transpose() *
           monomials(at[0] - from[0], at[1] - from[1], order_);
  };
  const int vertices = static_cast<int>(patches.size());
  for (int v = 0; v < vertices; ++v)
    for (int k = 0; k < components; ++k) nodal(k, v) = polynomials_(k * terms, patches[v]);
  if (orderOf(cell) > 1)
    for (const std::vector<int>& side : cellInfo(cell).sideNodes)
      nodal.col(side[2]) = 0.5 * (valueAt(side[0], side[2]) + valueAt(side[1], side[2]));
  if (cell == Cell::Quadrilateral9) nodal.col(8) = 0.25 * (valueAt(0, 8) + valueAt(1, 8) + valueAt(2, 8) + valueAt(3, 8));
}

Matrix PatchRecovery::nodalSums() const {
  Matrix sums = Matrix::Zero(components + 1, block_->nodes());
  Nodal nodal;
  for (int e = 0; e < block_->elements(); ++e) {
    nodalOf(e, nodal);
    const Span<const int> nodes = block_->nodesOf(e);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      sums.col(nodes[a]).head<components>() += nodal.col(a);
      sums(components, nodes[a]) += 1.0;
    }
  }
  return sums;
}

ElementErrors PatchRecovery::errors() const {
  ElementErrors all{Vector::Zero(block_->elements()), Vector::Zero(block_->elements())};
  Laws laws(plane_);
  Nodal nodal;
  for (int e = 0; e < block_->elements(); ++e) {
    const HookesLaw& law = laws.of(materialOf_(e));
    const Cell cell = block_->cells[e];
    nodalOf(e, nodal);
    if (cell == Cell::Triangle3 && !block_->axisymmetric && !initial_.isIn(e)) {  // a linear difference: its mass matrix is known
      ElementStress element(*block_, e, referenceElement(cell, Rule::Sampling), law, displacement_, initial_);
      element.at(0);
      const Stress stress = element.stress();
      Stress sum = Stress::Zero();
      double squares = 0.0;
      for (int v = 0; v < 3; ++v) {
        const Stress difference = nodal.col(v) - stress;
        sum += difference;
        squares += law.complementary(difference);
      }
      all.error[e] = element.map().measure() / 12.0 * (squares + law.complementary(sum));
      all.norm[e] = element.map().measure() * law.complementary(stress);
      continue;
    }
    const ReferenceElement& reference = referenceElement(cell, Rule::Recovery);
    ElementStress element(*block_, e, reference, law, displacement_, initial_);
    for (int q = 0; q < reference.points; ++q) {
      element.at(q);
      const Stress stress = element.stress();
      Stress difference = -stress;
      for (int a = 0; a < reference.nodes; ++a) difference += reference.valuesAt(q)[a] * nodal.col(a);
      all.error[e] += element.map().measure() * law.complementary(difference);
      const double whole = law.complementary(stress);
      all.norm[e] += element.map().measure() *
                     (element.isInitial() ? std::max(law.complementary(element.ofDisplacement()), kLeastNorm * whole) : whole);
    }
  }
  return all;
}

void recoverPatches(std::vector<PatchRecovery>& blocks, const PatchExchange& exchange) {
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
  const std::vector<Matrix> moments = summed([](const PatchRecovery& block) { return block.moments(); });
  for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].fitAlone(moments[i]);
  if (unfitted()) {
    const std::vector<Matrix> sums =
        summed([&](const PatchRecovery& block) { return block.acrossSides(moments[std::size_t(&block - blocks.data())]); });
    for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].fitJoined(moments[i], sums[i]);
  }
  // Twice: a corner may have no neighbour that stands alone, but neighbours that have some.
  for (int pass = 0; pass < 2 && unfitted(); ++pass) {
    const std::vector<Matrix> sums = summed([](const PatchRecovery& block) { return block.fromNeighbours(); });
    for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].takeFromNeighbours(sums[i]);
  }
  if (!unfitted()) return;
  const std::vector<Matrix> larger =
      summed([&](const PatchRecovery& block) { return block.enlarged(moments[std::size_t(&block - blocks.data())]); });
  for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].fitEnlarged(larger[i]);
}

}  // namespace suture
