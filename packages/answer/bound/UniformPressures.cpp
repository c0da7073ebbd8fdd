#include <suture/answer/bound/CellParts.hpp>
#include <suture/answer/bound/SplitSide.hpp>
#include <suture/answer/bound/UniformPressures.hpp>

#include <algorithm>
#include <optional>

namespace suture {

namespace {

/// The side of the cell with its geometry; nothing if it is no plane side with four vertices of order 1.
struct WholeGeometry {
  std::vector<int> nodes;  // of the cell
  SplitSide split;
  bool isFirst;  // the triangle is the first one of the side
};

std::optional<WholeGeometry> geometryOf(const SubdomainMesh& mesh, const BoundParts<3>& parts, const PlaceOfSide& place) {
  if (isSimplex(mesh.cells[place.element]) || parts.kind.order != 1) return std::nullopt;
  const CellParts<3> cut = cellParts<3>(mesh, place.element);
  const int t = place.simplex - parts.ofMesh[place.mesh][place.element], side = cut.parts[t].sides[place.opposite];
  const std::vector<int>& nodes = cellInfo(mesh.cells[place.element]).sideNodes[side];
  if (nodes.size() != 4) return std::nullopt;
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
  for (int i = 0; i < 4; ++i) {
    result.vertices.push_back(mesh.globalNodes[mesh.nodesOf(place.element)[side->nodes[i]]]);
    result.ofCell.push_back(normal.dot(side->split.ofCell()[i].col(0)));
    result.ofTriangles.push_back(normal.dot(side->split.ofTriangles()[i].col(0)));
  }
  return result;
}

void replaceUniformPressure(const BoundedSolution& solution, const PlaceOfSide& place, double pressure, BoundParts<3>& parts) {
  const SubdomainMesh& mesh = solution.meshes[place.mesh];
  const std::optional<WholeGeometry> side = geometryOf(mesh, parts, place);
  if (!side || !side->isFirst) return;
  Matrix forces = Matrix::Zero(3, int(mesh.nodesOf(place.element).size()));
  // The traction is the pressure times the inward normal.
  for (int i = 0; i < 4; ++i)
    forces.col(side->nodes[i]) = pressure * (side->split.ofCell()[i].col(0) - side->split.ofTriangles()[i].col(0));
  addForcesOf<3>(mesh, place.mesh, place.element, forces, parts);
}

}  // namespace suture
