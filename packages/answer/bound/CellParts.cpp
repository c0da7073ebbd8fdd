#include <Eigen/Cholesky>
#include <suture/answer/bound/CellParts.hpp>
#include <suture/answer/bound/SimplexField.hpp>

#include <algorithm>
#include <functional>

namespace suture {

namespace {

/// Columns: forces of unit components on both resultants and the moment, at a place relative to the origin of moments.
Eigen::Matrix<double, 3, 2> resultantsAt(const Eigen::Vector2d& x) {
  Eigen::Matrix<double, 3, 2> all;
  all << 1, 0, 0, 1, -x[1], x[0];
  return all;
}

Eigen::Vector2d placeOf(const BoundElement<2>& element, int node) {
  if (node <= 2) return element.places.col(node);
  const auto& ends = SimplexNodes<2>::ends[node - 3];
  return 0.5 * (element.places.col(ends[0]) + element.places.col(ends[1]));
}

}  // namespace

template <int D>
CellParts<D> cellParts(const CellBlock& block, int element) {
  const CellInfo& cell = cellInfo(block.cells[element]);
  const Span<const int> nodes = block.nodesOf(element);
  CellParts<D> result;
  for (const CellSimplex& simplex : splitCell(block, element, std::less<int>())) {
    typename CellParts<D>::Part part;
    std::array<int, D + 1> vertices;
    std::copy_n(simplex.begin(), D + 1, vertices.begin());
    std::sort(vertices.begin(), vertices.end(), [&](int a, int b) { return nodes[a] < nodes[b]; });
    std::copy(vertices.begin(), vertices.end(), part.nodes.begin());
    for (int e = 0; e < SimplexNodes<D>::edges; ++e) {
      const int a = vertices[SimplexNodes<D>::ends[e][0]], b = vertices[SimplexNodes<D>::ends[e][1]];
      int& node = part.nodes[D + 1 + e];
      node = -2;
      for (std::size_t i = 0; i < cell.edges.size(); ++i)
        if (std::minmax(cell.edges[i][0], cell.edges[i][1]) == std::minmax(a, b)) node = cell.order == 1 ? -1 : cell.vertices + int(i);
      if (node != -2) continue;
      const std::array<int, 2> ends{{std::min(a, b), std::max(a, b)}};
      const auto found = std::find(result.diagonals.begin(), result.diagonals.end(), ends);
      node = cell.nodes + int(found - result.diagonals.begin());
      if (found == result.diagonals.end()) result.diagonals.push_back(ends);
    }
    for (int a = 0; a <= D; ++a) {
      int onSide[D];
      for (int i = 0, j = 0; i <= D; ++i)
        if (i != a) onSide[j++] = vertices[i];
      part.sides[a] = sideThrough(cell, onSide, D);
    }
    result.parts.push_back(part);
  }
  return result;
}

/// The forces at the diagonal's nodes are given to both triangles in equal parts; then B_0^T y balances the first one, and with the
/// opposite sign the second.
void splitForces(const CellParts<2>& parts, const Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 10>& forces, int order,
                 BoundElement<2>* simplices) {
  const int count = SimplexNodes<2>::nodes(order);
  const Eigen::Vector2d origin = simplices[0].places.rowwise().mean();
  const double scale = (simplices[0].places.rowwise().maxCoeff() - simplices[0].places.rowwise().minCoeff()).norm();
  const auto rigidAt = [&](int i) { return resultantsAt((placeOf(simplices[0], i) - origin) / scale); };
  const auto& other = parts.parts[1].nodes;
  const auto partner = [&](int node) {
    const auto found = std::find(other.begin(), other.begin() + count, node);
    return found == other.begin() + count ? -1 : int(found - other.begin());
  };
  for (int i = 0; i < count; ++i)
    if (std::find(parts.parts[0].nodes.begin(), parts.parts[0].nodes.begin() + count, other[i]) == parts.parts[0].nodes.begin() + count)
      simplices[1].forces.col(i) = forces.col(other[i]);
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d resultant = Eigen::Vector3d::Zero();
  const auto ofSource = SimplexField<2>(simplices[0].places).forcesOfSources(simplices[0].sources, 1);
  for (int i = 0; i < count; ++i) {
    const int node = parts.parts[0].nodes[i], j = partner(node);
    const auto own = rigidAt(i);
    if (j < 0) {
      simplices[0].forces.col(i) = forces.col(node);
    } else {
      const Eigen::Vector2d half = 0.5 * (forces.col(node) - simplices[0].forces.col(i) - simplices[1].forces.col(j));
      simplices[0].forces.col(i) += half;
      simplices[1].forces.col(j) += half;
      matrix += own * own.transpose();
    }
    resultant += own * simplices[0].forces.col(i);
    if (i <= 2) resultant += own * ofSource.col(i);
  }
  const Eigen::Vector3d y = matrix.llt().solve(resultant);
  for (int i = 0; i < count; ++i) {
    const int j = partner(parts.parts[0].nodes[i]);
    if (j < 0) continue;
    const Eigen::Vector2d change = rigidAt(i).transpose() * y;
    simplices[0].forces.col(i) -= change;
    simplices[1].forces.col(j) += change;
  }
}

template CellParts<2> cellParts(const CellBlock&, int);
template CellParts<3> cellParts(const CellBlock&, int);

}  // namespace suture
