#include <suture/mesh/ShapeFunctions.hpp>

#include <algorithm>

namespace suture {

namespace {

const Point square[] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 0}};
const Point cube[] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1},  {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1},  {-1, 1, 1},  {0, -1, -1},
                      {1, 0, -1},   {0, 1, -1},  {-1, 0, -1}, {0, -1, 1},  {1, 0, 1},   {0, 1, 1},  {-1, 0, 1}, {-1, -1, 0}, {1, -1, 0},
                      {1, 1, 0},    {-1, 1, 0},  {-1, 0, 0},  {1, 0, 0},   {0, -1, 0},  {0, 1, 0},  {0, 0, -1}, {0, 0, 1},   {0, 0, 0}};
const Point wedge[] = {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
const Point pyramid[] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}};

using Jet = ShapeJet;

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

Jet simplexFunction(const CellInfo& cell, int i, const Point& at) {
  if (i < cell.vertices) {
    Jet l = barycentric(cell.dimension, i, at);
    if (cell.order == 1) return l;
    for (double& g : l.gradient) g *= 4 * l.value - 1;
    l.value *= 2 * l.value - 1;
    return l;
  }
  const auto& edge = cell.edges[i - cell.vertices];
  const Jet a = barycentric(cell.dimension, edge[0], at), b = barycentric(cell.dimension, edge[1], at);
  Jet product;
  product.value = 4 * a.value * b.value;
  for (int k = 0; k < 3; ++k) product.gradient[k] = 4 * (a.value * b.gradient[k] + b.value * a.gradient[k]);
  return product;
}

/// A product of functions of one coordinate each. \param factor  factor[k], slope[k]: value and derivative for coordinate k
Jet productOf(int dimension, const double* factor, const double* slope) {
  Jet product;
  product.value = 1.0;
  for (int k = 0; k < dimension; ++k) {
    product.value *= factor[k];
    product.gradient[k] = slope[k];
    for (int j = 0; j < dimension; ++j)
      if (j != k) product.gradient[k] *= factor[j];
  }
  return product;
}

/// Linear in each coordinate. \param p  reference point of the node
Jet linearProduct(int dimension, const Point& p, const Point& at) {
  double factor[3], slope[3];
  for (int k = 0; k < dimension; ++k) factor[k] = (1 + p[k] * at[k]) / 2, slope[k] = p[k] / 2;
  return productOf(dimension, factor, slope);
}

/// Quadratic in each coordinate: through -1, 0 and 1.
Jet quadraticProduct(int dimension, const Point& p, const Point& at) {
  double factor[3], slope[3];
  for (int k = 0; k < dimension; ++k) {
    const double x = at[k];
    factor[k] = p[k] == 0 ? 1 - x * x : x * (x + p[k]) / 2;
    slope[k] = p[k] == 0 ? -2 * x : x + p[k] / 2;
  }
  return productOf(dimension, factor, slope);
}

/// Serendipity functions of 8 and 20 nodes.
Jet serendipity(int dimension, const Point& p, const Point& at) {
  double factor[3], slope[3], sum = 1 - dimension;
  bool isMiddle = false;
  for (int k = 0; k < dimension; ++k) {
    const bool middle = p[k] == 0;
    isMiddle = isMiddle || middle;
    factor[k] = middle ? 1 - at[k] * at[k] : (1 + p[k] * at[k]) / 2;
    slope[k] = middle ? -2 * at[k] : p[k] / 2;
    sum += p[k] * at[k];
  }
  Jet jet = productOf(dimension, factor, slope);
  if (isMiddle) return jet;
  for (int k = 0; k < dimension; ++k) jet.gradient[k] = jet.gradient[k] * sum + jet.value * p[k];
  jet.value *= sum;
  return jet;
}

Jet wedgeFunction(int i, const Point& at) {
  const Jet l = barycentric(2, i % 3, at);
  const double half = (1 + wedge[i][2] * at[2]) / 2;
  return {l.value * half, {l.gradient[0] * half, l.gradient[1] * half, l.value * wedge[i][2] / 2}};
}

Jet pyramidFunction(int i, const Point& at) {
  if (i == 4) return {at[2], {0, 0, 1}};
  const double p = pyramid[i][0], q = pyramid[i][1], x = at[0], y = at[1], z = at[2];
  const double below = std::max(1 - z, 1e-14), ratio = p * q / below;
  return {((1 + p * x) * (1 + q * y) - z + ratio * x * y * z) / 4,
          {(p * (1 + q * y) + ratio * y * z) / 4, (q * (1 + p * x) + ratio * x * z) / 4, (ratio * x * y / below - 1) / 4}};
}

Jet jetOf(Cell cell, int i, const Point& at) {
  switch (cell) {
    case Cell::Triangle3:
    case Cell::Triangle6:
    case Cell::Tetrahedron4:
    case Cell::Tetrahedron10:
      return simplexFunction(cellInfo(cell), i, at);
    case Cell::Quadrilateral4:
      return linearProduct(2, square[i], at);
    case Cell::Quadrilateral8:
      return serendipity(2, square[i], at);
    case Cell::Quadrilateral9:
      return quadraticProduct(2, square[i], at);
    case Cell::Hexahedron8:
      return linearProduct(3, cube[i], at);
    case Cell::Hexahedron20:
      return serendipity(3, cube[i], at);
    case Cell::Hexahedron27:
      return quadraticProduct(3, cube[i], at);
    case Cell::Wedge6:
      return wedgeFunction(i, at);
    case Cell::Pyramid5:
      return pyramidFunction(i, at);
  }
  return {};
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
  if (!isSimplex(cell)) {
    for (int i = 0; i < info.nodes; ++i) jets[i] = jetOf(cell, i, at);
    return;
  }
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

double shapeFunction(Cell cell, int i, const ReferencePoint& at) { return jetOf(cell, i, at).value; }

ReferencePoint shapeGradient(Cell cell, int i, const ReferencePoint& at) { return jetOf(cell, i, at).gradient; }

}  // namespace suture
