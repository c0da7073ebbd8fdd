#include <suture/mesh/SideGeometry.hpp>
#include <suture/pairs/mortar/ShapeValues.hpp>

#include <algorithm>

namespace suture {

namespace {
constexpr double kToVertices = 0.2;  // alpha: integrals of 2/15 and 1/5 on triangles, of 1/20 and 1/5 on quadrilaterals of area one
}

ShapeValues sideValues(int nodes, int dimension, const ReferencePoint& at) {
  ShapeValues values{};
  if (dimension == 2) {
    const SideShape shape = sideShape(nodes, at[0]);
    std::copy(shape.value.begin(), shape.value.end(), values.begin());
    return values;
  }
  ShapeJet jets[kMostSideNodes];
  shapeJets(sideCell(nodes), at, jets);
  for (int i = 0; i < nodes; ++i) values[i] = jets[i].value;
  return values;
}

ShapeValues multiplierValues(int functions, int dimension, const ReferencePoint& at) {
  ShapeValues values = sideValues(functions, dimension, at);
  if (dimension == 2 || (functions != 6 && functions != 8)) return values;
  const int vertices = functions / 2;
  for (int k = 0; k < vertices; ++k) values[k] += kToVertices * (values[vertices + k] + values[vertices + (k + vertices - 1) % vertices]);
  for (int k = vertices; k < functions; ++k) values[k] *= 1 - 2 * kToVertices;
  return values;
}

}  // namespace suture
