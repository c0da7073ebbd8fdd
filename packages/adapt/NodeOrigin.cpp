#include <suture/adapt/NodeOrigin.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/ShapeFunctions.hpp>

namespace suture {

namespace {

void shapesAt(const CellBlock& block, const NodeOrigin& origin, ShapeJet* jets) {
  shapeJets(block.cells[origin.element], {origin.at[0], origin.at[1], origin.at[2]}, jets);
}

}  // namespace

Point pointAt(const CellBlock& block, const NodeOrigin& origin) {
  ShapeJet jets[kMostCellNodes];
  shapesAt(block, origin, jets);
  const Span<const int> nodes = block.nodesOf(origin.element);
  Point point{0, 0, 0};
  for (std::size_t k = 0; k < nodes.size(); ++k) point = plus(point, scaled(jets[k].value, block.point(nodes[k])));
  return point;
}

Matrix valuesAt(const CellBlock& block, const std::vector<NodeOrigin>& origins, const Matrix& values) {
  Matrix result = Matrix::Zero(static_cast<Eigen::Index>(origins.size()), values.cols());
  ShapeJet jets[kMostCellNodes];
  for (std::size_t i = 0; i < origins.size(); ++i) {
    shapesAt(block, origins[i], jets);
    const Span<const int> nodes = block.nodesOf(origins[i].element);
    for (std::size_t k = 0; k < nodes.size(); ++k) result.row(static_cast<Eigen::Index>(i)) += jets[k].value * values.row(nodes[k]);
  }
  return result;
}

}  // namespace suture
