#include <algorithm>
#include <cmath>
#include <suture/answer/bound/GapLift.hpp>

namespace suture {
namespace {

constexpr int kMostEdges = 3;
using Edges = std::array<double, kMostEdges>;

/// True if the quadratic form with the diagonal g and the off-diagonal entries b (edges (0,1), (1,2), (0,2)) is nonnegative for nonnegative
/// arguments. `root`: square roots of g; b >= -root root is required.
bool isCopositive(const Edges& root, const Edges& b) {
  double sum = root[0] * root[1] * root[2], product = 2;
  for (int edge = 0; edge < kMostEdges; ++edge) {
    const auto [i, j] = edgeVertices(edge);
    sum += b[std::size_t(edge)] * root[std::size_t(3 - i - j)];
    product *= std::max(0.0, b[std::size_t(edge)] + root[std::size_t(i)] * root[std::size_t(j)]);
  }
  return sum + std::sqrt(product) >= 0;
}

/// The least common part of the way from b to max(b, 0) that makes the form copositive: bisection from above.
Edges madeCopositive(const Edges& root, const Edges& b) {
  const auto raised = [&b](double part) {
    Edges at = b;
    for (double& value : at) value += part * std::max(0.0, -value);
    return at;
  };
  if (isCopositive(root, b)) return b;
  double low = 0, high = 1;
  for (int halving = 0; halving < 50; ++halving) {
    const double middle = 0.5 * (low + high);
    (isCopositive(root, raised(middle)) ? high : low) = middle;
  }
  return raised(high);
}

}  // namespace

std::vector<double> liftOfGaps(const PressedSides& sides, const Matrix& gaps) {
  std::vector<double> lift(sides.places.size(), 0.0);
  if (sides.degree == 1) return lift;
  const int vertices = sides.vertices(), edges = sides.sideNodes() - vertices;
  for (int side = 0; side < sides.sides(); ++side) {
    Edges root{}, b{}, raised{};
    for (int i = 0; i < vertices; ++i) root[std::size_t(i)] = std::sqrt(std::max(0.0, gaps(i, side)));
    for (int edge = 0; edge < edges; ++edge) {
      const auto [i, j] = edgeVertices(edge);
      b[std::size_t(edge)] = 2 * gaps(vertices + edge, side) - 0.5 * (std::max(0.0, gaps(i, side)) + std::max(0.0, gaps(j, side)));
      raised[std::size_t(edge)] = std::max(b[std::size_t(edge)], -root[std::size_t(i)] * root[std::size_t(j)]);
    }
    if (vertices == 3) raised = madeCopositive(root, raised);
    for (int edge = 0; edge < edges; ++edge) {
      double& height = lift[static_cast<std::size_t>(sides.nodesOf(side)[vertices + edge])];
      height = std::max(height, 0.5 * (raised[std::size_t(edge)] - b[std::size_t(edge)]));
    }
  }
  return lift;
}

double gapWork(const PressedSides& sides, const Matrix& pressures, const Matrix& gaps) {
  const Matrix& mass = sideMass(sides.dimension, sides.degree);
  double work = 0;
  for (int side = 0; side < sides.sides(); ++side)
    work += sides.sizes[static_cast<std::size_t>(side)] * pressures.col(side).dot(mass * gaps.col(side));
  return work;
}

}  // namespace suture
