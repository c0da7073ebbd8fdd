#include <suture/answer/bound/BoundParts.hpp>
#include <suture/answer/bound/BoundedField.hpp>
#include <suture/answer/bound/CellParts.hpp>
#include <suture/answer/bound/SideConditions.hpp>
#include <suture/answer/bound/SplitQuadrilateral.hpp>
#include <suture/answer/bound/SplitSolid.hpp>
#include <suture/answer/bound/SupportedSides.hpp>
#include <suture/base/Point.hpp>

#include <algorithm>

namespace suture {

namespace {

// Distance of a mid-side node from the middle, relative to the edge, up to which forces of straight elements are those of the solver.
constexpr double kExactlyStraight = 1e-11;

template <int D>
class Collector {
 public:
  Collector(const BoundedSolution& solution, const BoundaryParts& parts, const BoundKind& kind, const SharedStresses* shared)
      : solution_(solution), parts_(parts), shared_(shared) {
    result_.kind = kind;
  }

  BoundParts<D> collect() {
    result_.onA.resize(parts_.touching.size());
    result_.onB.resize(parts_.touching.size());
    std::size_t elements = 0;
    for (const SubdomainMesh& mesh : solution_.meshes) elements += std::size_t(mesh.elements());
    result_.elements.reserve(elements);
    for (std::size_t m = 0; m < solution_.meshes.size(); ++m) addMesh(static_cast<int>(m));
    return std::move(result_);
  }

 private:
  using Nodes = SimplexNodes<D>;
  /// Nodes of an element in the order of SimplexNodes: numbers in the mesh, and within the element.
  struct Ordered {
    std::array<int, (D == 2 ? 6 : 10)> node{}, local{};
    int count = D + 1;
    bool isStraight = true;  ///< so exactly that forces can be integrated in closed form
  };

  void addMesh(int m) {
    const SubdomainMesh& mesh = solution_.meshes[m];
    if (mesh.axisymmetric) result_.reasons.insert("the scene is axisymmetric");
    const SideConditions<D> conditions(mesh, solution_.model, parts_, solution_.displacement[m], result_.reasons);
    BoundedField<D> field(solution_, m, result_.kind, result_.reasons);
    result_.ofMesh.emplace_back();
    result_.ofMesh.back().reserve(std::size_t(mesh.elements()) + 1);
    const bool hasCells = std::any_of(mesh.cells.begin(), mesh.cells.end(), [](Cell cell) { return !isSimplex(cell); });
    result_.interpolation.push_back(hasCells ? Vector(Vector::Zero(mesh.elements())) : Vector());
    for (int e = 0; e < mesh.elements(); ++e) {
      result_.ofMesh.back().push_back(static_cast<int>(result_.elements.size()));
      if (isSimplex(mesh.cells[e])) {
        addSimplex(m, e, field, conditions);
        continue;
      }
      const CellParts<D> parts = cellParts<D>(mesh, e);
      if constexpr (D == 2)
        addCell(m, e, parts, splitQuadrilateral(field, e, parts, result_.oscillation), conditions);
      else
        addCell(m, e, parts, SplitSolid(field, m, e, parts, conditions, *shared_).split(result_.oscillation), conditions);
    }
    result_.ofMesh.back().push_back(static_cast<int>(result_.elements.size()));
  }

  void addSimplex(int m, int e, BoundedField<D>& field, const SideConditions<D>& conditions) {
    const SubdomainMesh& mesh = field.mesh();
    const int degree = result_.kind.order;
    BoundElement<D>& element = result_.elements.emplace_back();
    const Ordered nodes = orderedNodes(mesh, e, element);
    const SimplexField<D> simplex(element.places);
    const SimplexLaw<D>& law = field.lawOf(e);
    element.compliance = law.compliance;
    element.stresses = law.stiffness * simplex.strains(nodal(field.displacement(), nodes), degree);
    result_.solutionNorm += simplex.energy(element.stresses, element.compliance);
    if (field.initial().isIn(e)) field.addInitialStress(e, law, element);
    if (!law.isFull || !nodes.isStraight || mesh.axisymmetric || field.initial().isIn(e)) {
      const typename BoundedField<D>::Forces all = field.forcesOf(e, field.balanced(), field.initial(), law);
      element.forces.setZero();
      for (int i = 0; i < nodes.count; ++i) element.forces.col(i) = all.col(nodes.local[i]);
    } else if (field.isCorrected()) {
      element.forces = simplex.forces(law.stiffness * simplex.strains(nodal(field.balanced(), nodes), degree), degree);
    } else {
      element.forces = simplex.forces(element.stresses, degree);
    }
    field.sources().subtractForces(e, nodes.node.data(), nodes.count, element.forces);
    result_.oscillation += field.sources().setSources(e, simplex.volume(), element);
    element.boundary.fill(-1);
    for (int a = 0; a <= D; ++a) {
      const int side = sideOpposite(mesh.cells[e], nodes.local[a]);
      if (conditions.isInner(e, side)) continue;
      const PlaceOfSide place{m, e, int(result_.elements.size()) - 1, a};
      element.boundary[a] = addBoundary(conditions, place, side, nodes.node.data(), element);
    }
  }

  void addCell(int m, int e, const CellParts<D>& parts, const SplitElement<D>& split, const SideConditions<D>& conditions) {
    result_.interpolation[m][e] = split.interpolation;
    result_.uncertainty += split.uncertainty;
    result_.solutionNorm += split.square;
    result_.energyOfForm += split.energyOfForm;
    for (std::size_t t = 0; t < split.simplices.size(); ++t) append(m, e, parts.parts[t], split.simplices[t], conditions);
  }

  void append(int m, int e, const typename CellParts<D>::Part& part, const BoundElement<D>& simplex, const SideConditions<D>& conditions) {
    const Span<const int> all = solution_.meshes[m].nodesOf(e);
    std::array<int, Nodes::most> nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const int node = part.nodes[i];
      nodes[i] = node >= 0 && node < int(all.size()) ? all[node] : -1;
    }
    result_.elements.push_back(simplex);
    BoundElement<D>& element = result_.elements.back();
    element.boundary.fill(-1);
    for (int a = 0; a <= D; ++a) {
      const int side = part.sides[a];
      if (side < 0 || conditions.isInner(e, side)) continue;
      element.boundary[a] = addBoundary(conditions, {m, e, int(result_.elements.size()) - 1, a}, side, nodes.data(), element);
    }
  }

  /// \param nodes  of the simplex
  int addBoundary(const SideConditions<D>& conditions, const PlaceOfSide& place, int side, const int* nodes,
                  const BoundElement<D>& element) {
    std::vector<int> onSide;
    for (int j = 0; j < Nodes::sideNodes(result_.kind.order); ++j) onSide.push_back(nodes[Nodes::ofSide(place.opposite, j)]);
    const int number = static_cast<int>(result_.boundary.size());
    for (const int i : conditions.contactsOnA(place.element, side)) result_.onA[i].push_back(number);
    for (const int i : conditions.contactsOnB(place.element, side)) result_.onB[i].push_back(number);
    result_.boundary.push_back(conditions.of(place.element, side, onSide));
    const SideCondition<D>& own = result_.boundary.back();
    if (own.isSupported()) result_.solutionNorm += supportEnergy(own, result_.kind.order, sideSize(element, place.opposite), own.moved);
    result_.places.push_back(place);
    return number;
  }

  /// Number of the side opposite to a vertex, by its number in the element.
  static int sideOpposite(Cell cell, int local) {
    const auto& sides = cellInfo(cell).sideNodes;
    for (std::size_t s = 0; s < sides.size(); ++s)
      if (std::find(sides[s].begin(), sides[s].end(), local) == sides[s].end()) return int(s);
    throw InternalError("a simplex without a side opposite to a vertex");
  }

  Ordered orderedNodes(const SubdomainMesh& mesh, int e, BoundElement<D>& element) {
    const Span<const int> all = mesh.nodesOf(e);
    Ordered nodes;
    for (int i = 0; i <= D; ++i) nodes.local[i] = i;
    // Ascending also in the numbers of the mesh.
    std::sort(nodes.local.begin(), nodes.local.begin() + D + 1, [&](int a, int b) { return all[a] < all[b]; });
    for (int i = 0; i <= D; ++i) {
      nodes.node[i] = all[nodes.local[i]];
      element.vertices[i] = mesh.globalNodes[nodes.node[i]];
      const Point p = mesh.point(nodes.node[i]);
      for (int k = 0; k < D; ++k) element.places(k, i) = p[k];
    }
    if (result_.kind.order == 2) addMiddles(mesh, e, nodes);
    return nodes;
  }

  void addMiddles(const SubdomainMesh& mesh, int e, Ordered& nodes) {
    const Span<const int> all = mesh.nodesOf(e);
    const CellInfo& cell = cellInfo(mesh.cells[e]);
    for (int edge = 0; edge < Nodes::edges; ++edge) {
      const int a = nodes.local[Nodes::ends[edge][0]], b = nodes.local[Nodes::ends[edge][1]];
      int i = 0;
      while (cell.edges[i] != std::array<int, 2>{a, b} && cell.edges[i] != std::array<int, 2>{b, a}) ++i;
      nodes.local[nodes.count] = cell.vertices + i;
      const int middle = nodes.node[nodes.count++] = all[cell.vertices + i];
      const Point first = mesh.point(all[a]), second = mesh.point(all[b]);
      const double off = norm(minus(mesh.point(middle), scaled(0.5, plus(first, second)))), length = norm(minus(first, second));
      if (off > kStraightSide * length) result_.reasons.insert(kCurvedSides);
      nodes.isStraight = nodes.isStraight && off <= kExactlyStraight * length;
    }
  }

  /// Displacements relative to the first node.
  static typename SimplexField<D>::Nodal nodal(const Vector& u, const Ordered& nodes) {
    typename SimplexField<D>::Nodal all = SimplexField<D>::Nodal::Zero();
    for (int i = 1; i < nodes.count; ++i)
      all.col(i) = u.template segment<D>(D * Eigen::Index(nodes.node[i])) - u.template segment<D>(D * Eigen::Index(nodes.node[0]));
    return all;
  }

  const BoundedSolution& solution_;
  const BoundaryParts& parts_;
  const SharedStresses* shared_;
  BoundParts<D> result_;
};

}  // namespace

bool hasOnlySimplices(const std::vector<SubdomainMesh>& meshes, std::array<int, 2>& orders) {
  bool all = true;
  for (const SubdomainMesh& mesh : meshes)
    for (const Cell cell : mesh.cells) {
      const int order = cellInfo(cell).order;
      orders = {std::min(orders[0], order), std::max(orders[1], order)};
      all = all && isSimplex(cell);
    }
  return all;
}

template <int D>
BoundParts<D> boundParts(const BoundedSolution& solution, const BoundaryParts& parts, const BoundKind& kind, const SharedStresses* shared) {
  return Collector<D>(solution, parts, kind, shared).collect();
}

template <int D>
std::array<int, SimplexNodes<D>::most> nodesOfSimplex(const BoundParts<D>& parts, const SubdomainMesh& mesh, const PlaceOfSide& place) {
  const CellParts<D> cut = cellParts<D>(mesh, place.element);
  std::array<int, SimplexNodes<D>::most> nodes = cut.parts[place.simplex - parts.ofMesh[place.mesh][place.element]].nodes;
  const Span<const int> all = mesh.nodesOf(place.element);
  const int count = int(all.size());
  for (int& node : nodes) {
    if (node >= count) {
      const auto& [a, b] = cut.diagonals[std::size_t(node - count)];
      const int middle = middleOf(mesh.cells[place.element], a, b);
      const Point ends = plus(mesh.point(all[a]), mesh.point(all[b]));
      const bool isThere = middle >= 0 && norm(minus(mesh.point(all[middle]), scaled(0.5, ends))) <=
                                              kStraightSide * norm(minus(mesh.point(all[a]), mesh.point(all[b])));
      node = isThere ? middle : -1;
    }
    if (node >= 0) node = all[node];
  }
  return nodes;
}

template <int D>
typename SimplexField<D>::Nodal forcesOfStresses(const BoundElement<D>& element, const BoundKind& kind) {
  const SimplexField<D> field(element.places);
  Eigen::Matrix<double, D, D + 1> sources = element.sources;
  if (kind.degree == 1) sources.colwise() = element.sources.col(0).eval();
  return field.forces(element.stresses, kind.order) - field.forcesOfSources(sources, kind.order);
}

template <int D>
void addForcesOf(const SubdomainMesh& mesh, int m, int e, const Matrix& forces, BoundParts<D>& parts) {
  const CellParts<D> cut = cellParts<D>(mesh, e);
  BoundElement<D>* first = &parts.elements[parts.ofMesh[m][e]];
  if (isSimplex(mesh.cells[e])) {
    for (int i = 0; i < SimplexNodes<D>::nodes(parts.kind.order); ++i) first->forces.col(i) += forces.col(cut.parts[0].nodes[i]);
    return;
  }
  if constexpr (D == 2) {
    std::array<BoundElement<2>, 2> unloaded{first[0], first[1]};
    for (BoundElement<2>& own : unloaded) own.sources.setZero(), own.forces.setZero();
    splitForces(cut, withNewNode(mesh.cells[e], cut, forces), parts.kind.order, unloaded.data());
    for (int t = 0; t < 2; ++t) first[t].forces += unloaded[t].forces;
  } else {
    std::vector<BoundElement<3>> unloaded(first, first + cut.parts.size());
    for (BoundElement<3>& own : unloaded) own.sources.setZero(), own.forces.setZero();
    const Eigen::Matrix3Xd places = placesOfParts(mesh, e, cut);
    Eigen::Matrix3Xd all = Eigen::Matrix3Xd::Zero(3, places.cols());
    all.leftCols(forces.cols()) = forces;
    moveCentreForces(mesh.cells[e], cut, places, all);
    splitForces(cut, all, places, parts.kind.order, unloaded.data());
    for (std::size_t t = 0; t < unloaded.size(); ++t) first[t].forces += unloaded[t].forces;
  }
}

void raiseDegree(BoundParts<2>& parts) {
  if (parts.kind.order == parts.kind.degree) return;
  for (SideCondition<2>& side : parts.boundary) {
    side.traction.col(2) = 0.5 * (side.traction.col(0) + side.traction.col(1));
    side.moved.col(2) = 0.5 * (side.moved.col(0) + side.moved.col(1));
  }
}

#define SUTURE_BOUND_PARTS(D)                                                                                                     \
  template struct BoundParts<D>;                                                                                                  \
  template BoundParts<D> boundParts(const BoundedSolution&, const BoundaryParts&, const BoundKind&, const SharedStresses*);       \
  template std::array<int, SimplexNodes<D>::most> nodesOfSimplex(const BoundParts<D>&, const SubdomainMesh&, const PlaceOfSide&); \
  template typename SimplexField<D>::Nodal forcesOfStresses(const BoundElement<D>&, const BoundKind&);                            \
  template void addForcesOf(const SubdomainMesh&, int, int, const Matrix&, BoundParts<D>&);
SUTURE_BOUND_PARTS(2)
SUTURE_BOUND_PARTS(3)
#undef SUTURE_BOUND_PARTS

}  // namespace suture
