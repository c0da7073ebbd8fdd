#include <Eigen/Cholesky>
#include <suture/answer/bound/CellParts.hpp>
#include <suture/answer/bound/SimplexField.hpp>

#include <algorithm>
#include <functional>

namespace suture {

namespace {

// No edge of a usual mesh is orthogonal to it.
constexpr double kDirection[3] = {0.8137941, 0.4761823, 0.3330519};

/// Columns: forces of unit components on both resultants and the moment, at a place relative to the origin of moments.
Eigen::Matrix<double, 3, 2> resultantsAt(const Eigen::Vector2d& x) {
  Eigen::Matrix<double, 3, 2> all;
  all << 1, 0, 0, 1, -x[1], x[0];
  return all;
}

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& x) {
  Eigen::Matrix3d all;
  all << 0, -x[2], x[1], x[2], 0, -x[0], -x[1], x[0], 0;
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
  const auto along = [&](int node) {
    const Point p = block.point(node);
    return kDirection[0] * p[0] + kDirection[1] * p[1] + kDirection[2] * p[2];
  };
  const auto isBefore = [&](int a, int b) {
    if constexpr (D == 2) return a < b;
    const double one = along(a), other = along(b);
    return one < other || (one == other && a < b);
  };
  for (const CellSimplex& simplex : splitCell(block, element, isBefore)) {
    typename CellParts<D>::Part part;
    std::array<int, D + 1> vertices;
    std::copy_n(simplex.begin(), D + 1, vertices.begin());
    for (int i = 0; i <= D; ++i)
      for (int j = 0; j < i; ++j)
        if (nodes[vertices[j]] > nodes[vertices[i]]) part.orientation = -part.orientation;
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

/// With y_t multipliers of the resultants of simplex t, the forces at a node change by B^T (y_t - mean of y over the simplices there).
void splitForces(const CellParts<3>& parts, const Eigen::Matrix3Xd& forces, const Eigen::Matrix3Xd& places, int order,
                 BoundElement<3>* simplices) {
  using Resultants = Eigen::Matrix<double, 6, 3>;
  const int count = SimplexNodes<3>::nodes(order), simplexCount = int(parts.parts.size()), nodes = int(forces.cols());
  std::vector<std::vector<std::pair<int, int>>> at(static_cast<std::size_t>(nodes));  // simplices with a node, and its number there
  for (int t = 0; t < simplexCount; ++t)
    for (int i = 0; i < count; ++i) at[std::size_t(parts.parts[t].nodes[i])].push_back({t, i});
  const Eigen::Vector3d origin = simplices[0].places.rowwise().mean();
  const double scale = (simplices[0].places.rowwise().maxCoeff() - simplices[0].places.rowwise().minCoeff()).norm();
  const auto resultants = [&](const Eigen::Vector3d& place) {
    const Eigen::Vector3d arm = (place - origin) / scale;
    Resultants all;
    all << Eigen::Matrix3d::Identity(), crossMatrix(arm);
    return all;
  };
  Vector rest = Vector::Zero(6 * simplexCount);
  Matrix matrix = Matrix::Zero(6 * simplexCount, 6 * simplexCount);
  for (int node = 0; node < nodes; ++node) {
    const auto& here = at[std::size_t(node)];
    if (here.empty()) continue;
    Eigen::Vector3d sum = forces.col(node);
    for (const auto& [t, i] : here) sum -= simplices[t].forces.col(i);
    const Resultants own = resultants(places.col(node));
    const Eigen::Matrix<double, 6, 6> square = own * own.transpose();
    for (const auto& [t, i] : here) {
      simplices[t].forces.col(i) += sum / double(here.size());
      rest.segment<6>(6 * t) += own * simplices[t].forces.col(i);
      matrix.block<6, 6>(6 * t, 6 * t) += square;
      for (const auto& [other, j] : here) matrix.block<6, 6>(6 * t, 6 * other) -= square / double(here.size());
    }
  }
  for (int t = 0; t < simplexCount; ++t) {
    Eigen::Matrix<double, 3, 4> sources = simplices[t].sources;
    if (order == 1) sources.colwise() = simplices[t].sources.col(0).eval();
    const auto ofSource = SimplexField<3>(simplices[t].places).forcesOfSources(sources, 1);
    for (int i = 0; i < 4; ++i) rest.segment<6>(6 * t) += resultants(simplices[t].places.col(i)) * ofSource.col(i);
    for (int other = 0; other < simplexCount; ++other) matrix.block<6, 6>(6 * t, 6 * other).diagonal().array() += 1.0;  // equal multipliers
  }
  const Vector y = matrix.llt().solve(rest);
  for (int node = 0; node < nodes; ++node) {
    const auto& here = at[std::size_t(node)];
    if (here.size() < 2) continue;
    const Resultants own = resultants(places.col(node));
    Eigen::Matrix<double, 6, 1> mean = Eigen::Matrix<double, 6, 1>::Zero();
    for (const auto& [t, i] : here) mean += y.segment<6>(6 * t) / double(here.size());
    for (const auto& [t, i] : here) simplices[t].forces.col(i) -= own.transpose() * (y.segment<6>(6 * t) - mean);
  }
}

template CellParts<2> cellParts(const CellBlock&, int);
template CellParts<3> cellParts(const CellBlock&, int);

}  // namespace suture
