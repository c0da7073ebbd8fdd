#include <suture/answer/bound/BoundParts.hpp>
#include <suture/answer/bound/QuadrilateralField.hpp>
#include <suture/answer/bound/SplitQuadrilateral.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>

#include <cmath>

namespace suture {

namespace {

// Difference between the area of a quadrilateral and those of its triangles, relative to it, that is round-off.
constexpr double kSameArea = 1e-9;

/// True if a quadrilateral is not the bilinear image of the reference cell.
bool isCurvedQuadrilateral(const SubdomainMesh& mesh, int e) {
  const CellInfo& cell = cellInfo(mesh.cells[e]);
  const Span<const int> all = mesh.nodesOf(e);
  for (std::size_t i = 0; i < cell.edges.size() && cell.order == 2; ++i) {
    const Point first = mesh.point(all[cell.edges[i][0]]), second = mesh.point(all[cell.edges[i][1]]);
    const Point middle = scaled(0.5, plus(first, second));
    if (norm(minus(mesh.point(all[cell.vertices + int(i)]), middle)) > kStraightSide * norm(minus(first, second))) return true;
  }
  if (mesh.cells[e] != Cell::Quadrilateral9) return false;
  const Point one = plus(mesh.point(all[0]), mesh.point(all[2])), other = plus(mesh.point(all[1]), mesh.point(all[3]));
  const double size = norm(minus(mesh.point(all[2]), mesh.point(all[0])));
  return norm(minus(mesh.point(all[8]), scaled(0.25, plus(one, other)))) > kStraightSide * size;
}

std::vector<BoundElement<2>> trianglesOf(BoundedField<2>& field, int e, const CellParts<2>& parts, const SimplexLaw<2>& law,
                                         double& oscillation) {
  const SubdomainMesh& mesh = field.mesh();
  const Span<const int> all = mesh.nodesOf(e);
  std::vector<BoundElement<2>> triangles(2);
  double area = 0.0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    BoundElement<2>& own = triangles[t];
    for (int i = 0; i < 3; ++i) {
      const int node = all[parts.parts[t].nodes[i]];
      own.vertices[i] = mesh.globalNodes[node];
      const Point p = mesh.point(node);
      own.places.col(i) << p[0], p[1];
    }
    own.compliance = law.compliance;
    const double size = SimplexField<2>(own.places).volume();
    area += size;
    oscillation += field.sources().setSources(e, size, own);
  }
  if (std::abs(area - signedSize(mesh, e)) > kSameArea * area) field.remark("elements are so distorted that their parts overlap");
  return triangles;
}

}  // namespace

QuadrilateralForces withNewNode(Cell cell, const CellParts<2>& parts, const QuadrilateralForces& forces) {
  QuadrilateralForces all(2, forces.cols() + 1);
  all.leftCols(forces.cols()) = forces;
  const int middle = middleOf(cell, parts.diagonals[0][0], parts.diagonals[0][1]);
  if (middle < 0) {
    all.col(forces.cols()).setZero();
  } else {
    all.col(forces.cols()) = forces.col(middle);
    all.col(middle).setZero();
  }
  return all;
}

SplitElement<2> splitQuadrilateral(BoundedField<2>& field, int e, const CellParts<2>& parts, double& oscillation) {
  const SubdomainMesh& mesh = field.mesh();
  const SimplexLaw<2>& law = field.lawOf(e);
  const bool isCurved = isCurvedQuadrilateral(mesh, e);
  if (isCurved) field.remark(kCurvedSides);
  SplitElement<2> result;
  result.simplices = trianglesOf(field, e, parts, law, oscillation);
  const QuadrilateralField::Nodal u = field.nodalOf(e, field.displacement());
  const bool isInitial = field.initial().isIn(e);
  const InterpolantDifference difference =
      QuadrilateralField(mesh, e, parts, isCurved).set(u, law.stiffness, !field.sources().empty(), result.simplices.data());
  result.interpolation = difference.functional;
  if (!difference.isAccurate) field.remark("elements are so distorted that their energies are not known exactly");
  result.square = difference.square;
  for (const BoundElement<2>& own : result.simplices) result.square += SimplexField<2>(own.places).energy(own.stresses, own.compliance);
  BoundedField<2>::Forces forces = field.forcesOf(e, field.balanced(), field.initial(), law);
  const BoundedField<2>::Forces internal =
      field.isCorrected() || isInitial ? field.forcesOf(e, field.displacement(), InitialState(), law) : forces;
  result.energyOfForm = (result.square - internal.cwiseProduct(u).sum()) / 2;
  const Span<const int> all = mesh.nodesOf(e);
  field.sources().subtractForces(e, all.begin(), int(all.size()), forces);
  for (BoundElement<2>& own : result.simplices) {
    if (isInitial) field.addInitialStress(e, law, own);
    own.forces = forcesOfStresses(own, field.kind());
  }
  splitForces(parts, withNewNode(mesh.cells[e], parts, forces), field.kind().order, result.simplices.data());
  return result;
}

}  // namespace suture
