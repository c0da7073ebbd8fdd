#include <suture/answer/bound/PressedSides.hpp>
#include <suture/base/Errors.hpp>

#include <cmath>
#include <string>

namespace suture {
namespace {

constexpr int kEdge[3][2] = {{0, 1}, {1, 2}, {0, 2}};

Matrix massOf(int dimension, int degree) {
  if (dimension == 2) {
    if (degree == 1) return (Matrix(2, 2) << 2, 1, 1, 2).finished() / 6;
    return (Matrix(3, 3) << 4, -1, 2, -1, 4, 2, 2, 2, 16).finished() / 30;
  }
  if (degree == 1) return (Matrix(3, 3) << 2, 1, 1, 1, 2, 1, 1, 1, 2).finished() / 12;
  Matrix mass = Matrix::Zero(6, 6);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      mass(i, j) = i == j ? 6 : -1;
      mass(3 + i, 3 + j) = i == j ? 32 : 16;
      mass(i, 3 + j) = mass(3 + j, i) = kEdge[j][0] == i || kEdge[j][1] == i ? 0 : -4;
    }
  return mass / 180;
}

Matrix bernsteinOf(int dimension, int degree) {
  if (degree == 1) return Matrix::Identity(dimension, dimension);
  const int edges = dimension == 2 ? 1 : 3;
  Matrix values = Matrix::Identity(dimension + edges, dimension + edges);
  for (int edge = 0; edge < edges; ++edge) {
    values(dimension + edge, dimension + edge) = 0.5;
    for (const int vertex : kEdge[edge]) values(dimension + edge, vertex) = 0.25;
  }
  return values;
}

/// The matrix of each of the four kinds of sides.
template <typename Make>
std::array<Matrix, 4> forEachKind(Make make) {
  return {make(2, 1), make(2, 2), make(3, 1), make(3, 2)};
}

const Matrix& ofKind(const std::array<Matrix, 4>& kinds, int dimension, int degree) {
  if (dimension < 2 || dimension > 3 || degree < 1 || degree > 2)
    throw InternalError("sides of dimension " + std::to_string(dimension) + " and degree " + std::to_string(degree) +
                        " in the bound of contact, expected dimension 2 or 3 and degree 1 or 2");
  return kinds[static_cast<std::size_t>(2 * (dimension - 2) + degree - 1)];
}

}  // namespace

std::array<int, 2> edgeVertices(int edge) { return {kEdge[edge][0], kEdge[edge][1]}; }

const Matrix& sideMass(int dimension, int degree) {
  static const std::array<Matrix, 4> kinds = forEachKind(massOf);
  return ofKind(kinds, dimension, degree);
}

const Matrix& bernsteinValues(int dimension, int degree) {
  static const std::array<Matrix, 4> kinds = forEachKind(bernsteinOf);
  return ofKind(kinds, dimension, degree);
}

void check(const PressedSides& sides) {
  sideMass(sides.dimension, sides.degree);
  if (sides.nodes.size() != sides.sizes.size() * static_cast<std::size_t>(sides.sideNodes()))
    throw InternalError(std::to_string(sides.nodes.size()) + " nodes of " + std::to_string(sides.sides()) + " contact sides, expected " +
                        std::to_string(sides.sideNodes()) + " per side");
  if (sides.forces.size() != sides.places.size())
    throw InternalError(std::to_string(sides.forces.size()) + " forces of " + std::to_string(sides.count()) + " contact nodes");
  for (const int node : sides.nodes)
    if (node < 0 || node >= sides.count())
      throw InternalError("contact node " + std::to_string(node) + " of a side, expected 0 to " + std::to_string(sides.count() - 1));
  for (const double size : sides.sizes)
    if (!(size > 0 && std::isfinite(size))) throw InternalError("size " + std::to_string(size) + " of a contact side, expected > 0");
  for (const double force : sides.forces)
    if (!std::isfinite(force)) throw InternalError("a contact force is not finite");
}

}  // namespace suture
