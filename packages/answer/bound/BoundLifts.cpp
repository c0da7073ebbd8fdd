#include <suture/answer/bound/BoundLifts.hpp>
#include <suture/answer/bound/CellParts.hpp>
#include <suture/answer/bound/SimplexLaw.hpp>
#include <suture/answer/bound/SupportedSides.hpp>

#include <algorithm>

namespace suture {

namespace {

/// Energy of the elastic supports of an element whose nodes are displaced.
template <int D>
double energyOfSupports(const BoundParts<D>& parts, const BoundElement<D>& element, const typename SimplexField<D>::Nodal& nodal) {
  double energy = 0.0;
  for (int a = 0; a <= D; ++a) {
    if (element.boundary[a] < 0 || !parts.boundary[element.boundary[a]].isSupported()) continue;
    Eigen::Matrix<double, D, 6> moved = Eigen::Matrix<double, D, 6>::Zero();
    for (int j = 0; j < SimplexNodes<D>::sideNodes(parts.kind.order); ++j) moved.col(j) = nodal.col(SimplexNodes<D>::ofSide(a, j));
    energy += supportEnergy(parts.boundary[element.boundary[a]], parts.kind.order, sideSize(element, a), moved);
  }
  return energy;
}

/// Lifts of the nodes of a mesh, by local numbers.
std::map<int, Point> liftsIn(const SubdomainMesh& mesh, const std::map<GlobalId, Point>& lifts) {
  std::map<int, Point> here;
  for (const auto& [node, value] : lifts) {
    const auto found = std::lower_bound(mesh.globalNodes.begin(), mesh.globalNodes.end(), node);
    if (found != mesh.globalNodes.end() && *found == node) here[int(found - mesh.globalNodes.begin())] = value;
  }
  return here;
}

/// Displacements at the nodes of a simplex of a cell; the middle of a diagonal moves with its ends.
template <int D>
typename SimplexField<D>::Nodal liftsOfSimplex(const Span<const int>& ofCell, const typename CellParts<D>::Part& part, int order,
                                               const std::map<int, Point>& lifts) {
  typename SimplexField<D>::Nodal nodal = SimplexField<D>::Nodal::Zero();
  for (int i = 0; i < SimplexNodes<D>::nodes(order); ++i) {
    const int node = part.nodes[i];
    if (node >= int(ofCell.size())) {
      const auto& ends = SimplexNodes<D>::ends[i - D - 1];
      nodal.col(i) = 0.5 * (nodal.col(ends[0]) + nodal.col(ends[1]));
      continue;
    }
    const auto found = lifts.find(ofCell[node]);
    for (int k = 0; k < D && found != lifts.end(); ++k) nodal(k, i) = found->second[k];
  }
  return nodal;
}

}  // namespace

/// On simplices the lifts are displacements of the elements, and the work of their forces is that of the contact forces. On quadrilaterals
/// they are not: there u_h is replaced by its interpolant, and the difference of the works is added;
/// in 3D in all cells, because both differ on the sides between them.
template <int D>
Lifts liftParts(const BoundParts<D>& parts, const BoundedSolution& solution, const std::map<GlobalId, Point>& lifts) {
  Lifts result;
  result.squares = Vector::Zero(Eigen::Index(parts.elements.size()));
  if (lifts.empty()) return result;
  for (std::size_t m = 0; m < solution.meshes.size(); ++m) {
    const SubdomainMesh& mesh = solution.meshes[m];
    const std::map<int, Point> here = liftsIn(mesh, lifts);
    for (int e = 0; e < mesh.elements() && !here.empty(); ++e) {
      const Span<const int> all = mesh.nodesOf(e);
      if (std::none_of(all.begin(), all.end(), [&](int node) { return here.count(node) > 0; })) continue;
      const CellParts<D> cut = cellParts<D>(mesh, e);
      const SimplexLaw<D> law(solution.model.materialOf(mesh, e, mesh.body), solution.model.plane);
      for (std::size_t t = 0; t < cut.parts.size(); ++t) {
        const int number = parts.ofMesh[m][e] + int(t);
        const BoundElement<D>& element = parts.elements[number];
        const SimplexField<D> field(element.places);
        const auto nodal = liftsOfSimplex<D>(all, cut.parts[t], parts.kind.order, here);
        const typename SimplexField<D>::AtVertices change = law.stiffness * field.strains(nodal, parts.kind.order);
        result.squares[number] = field.energy(change, element.compliance) + energyOfSupports(parts, element, nodal);
        if (isSimplex(mesh.cells[e])) continue;
        const int count = SimplexNodes<D>::nodes(parts.kind.order);
        const typename SimplexField<D>::Nodal more = forcesOfStresses(element, parts.kind) - element.forces;
        result.energy += more.leftCols(count).cwiseProduct(nodal.leftCols(count)).sum();
      }
      if (D == 2 && !isSimplex(mesh.cells[e])) result.energy -= parts.interpolation[m][e] / 2;
    }
  }
  if (D == 3) {
    for (const Vector& of : parts.interpolation) result.energy -= of.sum() / 2;
    result.energy += parts.uncertainty;
  }
  return result;
}

template Lifts liftParts(const BoundParts<2>&, const BoundedSolution&, const std::map<GlobalId, Point>&);
template Lifts liftParts(const BoundParts<3>&, const BoundedSolution&, const std::map<GlobalId, Point>&);

}  // namespace suture
