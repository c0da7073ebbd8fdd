#include <suture/base/Errors.hpp>
#include <suture/mesh/ShapeFunctions.hpp>

#include <algorithm>
#include <string>

namespace suture {

namespace {

const Point square[] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 0}};
const Point cube[] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1},  {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1},  {-1, 1, 1},  {0, -1, -1},
                      {1, 0, -1},   {0, 1, -1},  {-1, 0, -1}, {0, -1, 1},  {1, 0, 1},   {0, 1, 1},  {-1, 0, 1}, {-1, -1, 0}, {1, -1, 0},
                      {1, 1, 0},    {-1, 1, 0},  {-1, 0, 0},  {1, 0, 0},   {0, -1, 0},  {0, 1, 0},  {0, 0, -1}, {0, 0, 1},   {0, 0, 0}};
const Point wedge[] = {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
const Point pyramid[] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}};

using Jet = ShapeJet;

/// A function of one coordinate.
struct Factor {
  double value, slope;
};
/// Linear on [-1, 1]. \param node  -1 or 1, where it is one
Factor linear(double node, double x) { return {(1 + node * x) / 2, node / 2}; }
/// Quadratic through -1, 0 and 1. \param node  where it is one
Factor quadratic(double node, double x) { return node == 0 ? Factor{1 - x * x, -2 * x} : Factor{x * (x + node) / 2, x + node / 2}; }

/// A factor of serendipity functions: quadratic in the middle of an edge, along it.
Factor linearOrBubble(double node, double x) { return node == 0 ? quadratic(node, x) : linear(node, x); }

/// Products of functions of one coordinate each, at one point.
template <int D>
class Products {
 public:
  /// \param functionOf  Factor(reference coordinate of the node: -1, 0 or 1; coordinate of the point)
  template <typename Function>
  Products(const Point& at, const Function& functionOf) {
    for (int k = 0; k < D; ++k)
      for (const int node : {-1, 0, 1}) factors_[k][node + 1] = functionOf(node, at[k]);
  }

  /// The product that is one at a node.
  Jet of(const Point& node) const {
    const Factor &x = at(0, node), &y = at(1, node);
    if constexpr (D == 2) return {x.value * y.value, {x.slope * y.value, x.value * y.slope, 0}};
    const Factor& z = at(D - 1, node);
    return {x.value * y.value * z.value, {x.slope * y.value * z.value, x.value * y.slope * z.value, x.value * y.value * z.slope}};
  }

 private:
  const Factor& at(int k, const Point& node) const { return factors_[k][static_cast<int>(node[k]) + 1]; }
  Factor factors_[D][3];
};

/// Serendipity functions of 8 and 20 nodes. \param products  of linearOrBubble()
template <int D>
Jet serendipity(const Products<D>& products, const Point& node, const Point& at) {
  Jet jet = products.of(node);
  double sum = 1 - D;
  for (int k = 0; k < D; ++k) {
    if (node[k] == 0) return jet;  // in the middle of an edge
    sum += node[k] * at[k];
  }
  for (int k = 0; k < D; ++k) jet.gradient[k] = jet.gradient[k] * sum + jet.value * node[k];
  jet.value *= sum;
  return jet;
}

/// The barycentric coordinate of a vertex of the triangle (dimension 2) or the tetrahedron.
Jet barycentric(int dimension, int vertex, const Point& at) {
  Jet l;
  if (vertex > 0) {
    l.value = at[vertex - 1];
    l.gradient[vertex - 1] = 1.0;
    return l;
  }
  l.value = 1.0;
  for (int k = 0; k < dimension; ++k) l.value -= at[k], l.gradient[k] = -1.0;
  return l;
}

void simplexJets(const CellInfo& info, const Point& at, Jet* jets) {
  Jet l[4];
  for (int i = 0; i < info.vertices; ++i) jets[i] = l[i] = barycentric(info.dimension, i, at);
  if (info.order == 1) return;
  for (int i = 0; i < info.vertices; ++i) {
    for (int k = 0; k < info.dimension; ++k) jets[i].gradient[k] *= 4 * l[i].value - 1;
    jets[i].value *= 2 * l[i].value - 1;
  }
  for (int i = info.vertices; i < info.nodes; ++i) {
    const Jet &a = l[info.edges[i - info.vertices][0]], &b = l[info.edges[i - info.vertices][1]];
    jets[i].value = 4 * a.value * b.value;
    for (int k = 0; k < 3; ++k) jets[i].gradient[k] = 4 * (a.value * b.gradient[k] + b.value * a.gradient[k]);
  }
}

Jet wedgeFunction(int i, const Point& at) {
  const Jet l = barycentric(2, i % 3, at);
  const Factor along = linear(wedge[i][2], at[2]);
  return {l.value * along.value, {l.gradient[0] * along.value, l.gradient[1] * along.value, l.value * along.slope}};
}

Jet pyramidFunction(int i, const Point& at) {
  if (i == 4) return {at[2], {0, 0, 1}};
  const double p = pyramid[i][0], q = pyramid[i][1], x = at[0], y = at[1], z = at[2];
  const double below = std::max(1 - z, 1e-14), ratio = p * q / below;
  return {((1 + p * x) * (1 + q * y) - z + ratio * x * y * z) / 4,
          {(p * (1 + q * y) + ratio * y * z) / 4, (q * (1 + p * x) + ratio * x * z) / 4, (ratio * x * y / below - 1) / 4}};
}

}  // namespace

ReferencePoint referencePoint(Cell cell, int node) {
  const CellInfo& info = cellInfo(cell);
  if (cell == Cell::Wedge6) return wedge[node];
  if (cell == Cell::Pyramid5) return pyramid[node];
  if (!isSimplex(cell)) return info.dimension == 2 ? square[node] : cube[node];
  Point place{0, 0, 0};
  if (node < info.vertices) {
    if (node > 0) place[node - 1] = 1;
    return place;
  }
  for (const int vertex : info.edges[node - info.vertices])
    if (vertex > 0) place[vertex - 1] = 0.5;
  return place;
}

ReferencePoint referenceCentre(Cell cell) {
  const int vertices = cellInfo(cell).vertices;
  Point centre{0, 0, 0};
  for (int i = 0; i < vertices; ++i) {
    const Point p = referencePoint(cell, i);
    for (int k = 0; k < 3; ++k) centre[k] += p[k] / vertices;
  }
  return centre;
}

void shapeJets(Cell cell, const ReferencePoint& at, ShapeJet* jets) {
  const CellInfo& info = cellInfo(cell);
  const auto fill = [&](const auto& functionOf) {
    for (int i = 0; i < info.nodes; ++i) jets[i] = functionOf(i);
  };
  switch (cell) {
    case Cell::Triangle3:
    case Cell::Triangle6:
    case Cell::Tetrahedron4:
    case Cell::Tetrahedron10:
      return simplexJets(info, at, jets);
    case Cell::Quadrilateral4:
      return fill([&, all = Products<2>(at, linear)](int i) { return all.of(square[i]); });
    case Cell::Quadrilateral8:
      return fill([&, all = Products<2>(at, linearOrBubble)](int i) { return serendipity(all, square[i], at); });
    case Cell::Quadrilateral9:
      return fill([&, all = Products<2>(at, quadratic)](int i) { return all.of(square[i]); });
    case Cell::Hexahedron8:
      return fill([&, all = Products<3>(at, linear)](int i) { return all.of(cube[i]); });
    case Cell::Hexahedron20:
      return fill([&, all = Products<3>(at, linearOrBubble)](int i) { return serendipity(all, cube[i], at); });
    case Cell::Hexahedron27:
      return fill([&, all = Products<3>(at, quadratic)](int i) { return all.of(cube[i]); });
    case Cell::Wedge6:
      return fill([&](int i) { return wedgeFunction(i, at); });
    case Cell::Pyramid5:
      return fill([&](int i) { return pyramidFunction(i, at); });
  }
}

SideShape sideShape(int nodes, double xi) {
  if (nodes != 2 && nodes != 3) throw InternalError("a side of " + std::to_string(nodes) + " nodes");
  constexpr double places[] = {-1, 1, 0};
  SideShape shape;
  for (int i = 0; i < nodes; ++i) {
    const Factor factor = nodes == 2 ? linear(places[i], xi) : quadratic(places[i], xi);
    shape.value[i] = factor.value;
    shape.slope[i] = factor.slope;
  }
  return shape;
}

}  // namespace suture
