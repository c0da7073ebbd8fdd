#include <suture/answer/bound/CellParts.hpp>
#include <suture/answer/bound/LinearPressures.hpp>
#include <suture/answer/bound/SplitSide.hpp>

#include <algorithm>
#include <optional>

namespace suture {

namespace {

/// The side of the cell with its geometry.
struct WholeGeometry {
  std::vector<int> nodes;  // local numbers in the cell
  SplitSide split;
  bool isFirst;  // the triangle is the first one of the side
};

/// Nothing if it is no plane side with four vertices, or has no node at its centre for the middle of the diagonal.
std::optional<WholeGeometry> geometryOf(const SubdomainMesh& mesh, const BoundParts<3>& parts, const PlaceOfSide& place) {
  if (isSimplex(mesh.cells[place.element])) return std::nullopt;
  const CellParts<3> cut = cellParts<3>(mesh, place.element);
  const int t = place.simplex - parts.ofMesh[place.mesh][place.element], side = cut.parts[t].sides[place.opposite];
  const std::vector<int>& nodes = cellInfo(mesh.cells[place.element]).sideNodes[side];
  if (nodes.size() != 4 && nodes.size() != 9) return std::nullopt;
  // The diagonal joins the neighbours of the vertex that the triangle lacks.
  int lacking = 0;
  for (int i = 0; i < 4; ++i) {
    bool has = false;
    for (int v = 0; v < 4; ++v) has = has || (v != place.opposite && cut.parts[t].nodes[v] == nodes[i]);
    if (!has) lacking = i;
  }
  std::vector<Point> points;
  for (const int node : nodes) points.push_back(mesh.point(mesh.nodesOf(place.element)[node]));
  SplitSide split(points, lacking % 2 == 0);
  if (!split.isPlane()) return std::nullopt;
  bool isFirst = true;
  for (int other = 0; other < t; ++other)
    isFirst = isFirst && std::count(cut.parts[other].sides.begin(), cut.parts[other].sides.end(), side) == 0;
  return WholeGeometry{nodes, split, isFirst};
}

}  // namespace

WholeSide wholeSide(const SubdomainMesh& mesh, const BoundParts<3>& parts, const PlaceOfSide& place) {
  WholeSide result;
  const std::optional<WholeGeometry> side = geometryOf(mesh, parts, place);
  if (!side) return result;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const SplitSide::Moment& moment : side->split.ofCell()) normal += moment.col(0);
  normal.normalize();
  for (std::size_t i = 0; i < side->nodes.size(); ++i) {
    result.nodes.push_back(mesh.globalNodes[mesh.nodesOf(place.element)[side->nodes[i]]]);
    const std::size_t onTriangles = i < 8 ? i : std::size_t(side->split.newNode());
    for (int k = 0; k < 4; ++k) {
      result.ofCell.push_back(normal.dot(side->split.ofCell()[i].col(k)));
      result.ofTriangles.push_back(normal.dot(side->split.ofTriangles()[onTriangles].col(k)));
    }
  }
  return result;
}

void replaceLinearTraction(const BoundedSolution& solution, const PlaceOfSide& place, const LinearTraction& traction,
                           BoundParts<3>& parts) {
  const SubdomainMesh& mesh = solution.meshes[place.mesh];
  const std::optional<WholeGeometry> side = geometryOf(mesh, parts, place);
  if (!side || !side->isFirst) return;
  const WholeSide whole = wholeSide(mesh, parts, place);
  Matrix forces = Matrix::Zero(3, int(mesh.nodesOf(place.element).size()));
  for (std::size_t i = 0; i < side->nodes.size(); ++i)
    for (std::size_t c = 0; c < 4; ++c)
      for (int k = 0; k < 3; ++k)
        forces(k, side->nodes[i]) += traction[c][std::size_t(k)] * (whole.ofTriangles[4 * i + c] - whole.ofCell[4 * i + c]);
  addForcesOf<3>(mesh, place.mesh, place.element, forces, parts);
}

}  // namespace suture
