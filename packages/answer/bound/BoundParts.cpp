#include <suture/answer/bound/BoundParts.hpp>
#include <suture/answer/bound/CellParts.hpp>
#include <suture/answer/bound/QuadrilateralField.hpp>
#include <suture/answer/bound/SideConditions.hpp>
#include <suture/answer/bound/SimplexLaw.hpp>
#include <suture/answer/bound/SupportedSides.hpp>
#include <suture/base/Point.hpp>
#include <suture/elasticity/ElementStress.hpp>
#include <suture/mesh/CellGeometry.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace suture {

namespace {

// Distance of a mid-side node from the middle, and deviation of loads from polynomials, relative to the size, that are round-off.
constexpr double kStraightSide = 1e-9;
constexpr double kPolynomial = 1e-9;
// Distance of a mid-side node from the middle, relative to the edge, up to which forces of straight elements are those of the solver.
constexpr double kExactlyStraight = 1e-11;
constexpr const char* kCurvedSides = "elements have curved sides";

/// Forces at the nodes of a quadrilateral, and at the middle of its diagonal.
using CellForces = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 10>;

/// A force at the centre of a cell acts at the middle of the diagonal there.
CellForces withNewNode(Cell cell, const CellParts<2>& parts, const CellForces& forces) {
  CellForces all(2, forces.cols() + 1);
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

template <int D>
class Collector {
 public:
  Collector(const BoundedSolution& solution, const BoundaryParts& parts, const BoundKind& kind) : solution_(solution), parts_(parts) {
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
  using Place = Eigen::Matrix<double, D, 1>;
  static constexpr int n = BoundElement<D>::stress;
  /// Nodes of an element in the order of SimplexNodes: numbers in the mesh, and within the element.
  struct Ordered {
    std::array<int, (D == 2 ? 6 : 10)> node{}, local{};
    int count = D + 1;
    bool isStraight = true;  ///< so exactly that forces can be integrated in closed form
  };

  void addMesh(int m) {
    const SubdomainMesh& mesh = solution_.meshes[m];
    result_.ofMesh.emplace_back();
    noteKinds(mesh);
    const SideConditions<D> conditions(mesh, solution_.model, parts_, solution_.displacement[m], result_.reasons);
    const InitialState initial(solution_.model, mesh.body);
    const Vector& displacement = solution_.displacement[m];
    const bool corrected = solution_.balancing && solution_.balancing->correction[m].size() > 0;
    const Vector balanced = corrected ? Vector(displacement + solution_.balancing->correction[m]) : displacement;
    const std::vector<const Load*> loads = bodyLoads(mesh);
    Vector scratch = Vector::Zero(displacement.size());
    result_.ofMesh.back().reserve(std::size_t(mesh.elements()) + 1);
    const bool hasCells = std::any_of(mesh.cells.begin(), mesh.cells.end(), [](Cell cell) { return !isSimplex(cell); });
    result_.interpolation.push_back(hasCells ? Vector(Vector::Zero(mesh.elements())) : Vector());
    for (int e = 0; e < mesh.elements(); ++e) {
      result_.ofMesh.back().push_back(static_cast<int>(result_.elements.size()));
      if constexpr (D == 2)
        if (!isSimplex(mesh.cells[e])) {
          addQuadrilateral(m, e, displacement, balanced, corrected, initial, loads, scratch, conditions);
          continue;
        }
      BoundElement<D>& element = result_.elements.emplace_back();
      const Ordered nodes = orderedNodes(mesh, e, element);
      const SimplexField<D> field(element.places);
      const SimplexLaw<D>& law = lawOf(mesh, e);
      element.compliance = law.compliance;
      addStresses(e, nodes, displacement, initial, law, field, element);
      if (!law.isFull || !nodes.isStraight || mesh.axisymmetric || initial.isIn(e))
        addForces(mesh, e, nodes, balanced, initial, law, element);
      else if (corrected)
        element.forces = field.forces(law.stiffness * field.strains(nodal(balanced, nodes), result_.kind.order), result_.kind.order);
      else
        element.forces = field.forces(element.stresses, result_.kind.order);
      addLoads(mesh, e, nodes, loads, scratch, field.volume(), element);
      element.boundary.fill(-1);
      for (int a = 0; a <= D; ++a) {
        const int side = sideOpposite(mesh.cells[e], nodes.local[a]);
        if (conditions.isInner(e, side)) continue;
        const PlaceOfSide place{m, e, int(result_.elements.size()) - 1, a};
        element.boundary[a] = addBoundary(conditions, place, side, nodes.node.data(), element);
      }
    }
    result_.ofMesh.back().push_back(static_cast<int>(result_.elements.size()));
  }

  /// The two triangles of a quadrilateral.
  void addQuadrilateral(int m, int e, const Vector& displacement, const Vector& balanced, bool corrected, const InitialState& initial,
                        const std::vector<const Load*>& loads, Vector& scratch, const SideConditions<2>& conditions) {
    const SubdomainMesh& mesh = solution_.meshes[m];
    const SimplexLaw<2>& law = lawOf(mesh, e);
    const CellParts<2> parts = cellParts<2>(mesh, e);
    const bool isCurved = isCurvedCell(mesh, e);
    if (isCurved) result_.reasons.insert(kCurvedSides);
    std::array<BoundElement<2>, 2> triangles = trianglesOf(mesh, e, parts, law, loads);
    const QuadrilateralField field(mesh, e, parts, isCurved);
    const QuadrilateralField::Nodal u = nodalOf(mesh, e, displacement);
    const InterpolantDifference difference = field.set(u, law.stiffness, !loads.empty(), triangles.data());
    result_.interpolation[m][e] = difference.functional;
    if (!difference.isAccurate) result_.reasons.insert("elements are so distorted that their energies are not known exactly");
    double square = difference.square;
    for (const BoundElement<2>& own : triangles) square += SimplexField<2>(own.places).energy(own.stresses, own.compliance);
    result_.solutionNorm += square;
    CellForces forces = forcesOfCell(mesh, e, balanced, initial, law);
    const CellForces internal = corrected || initial.isIn(e) ? forcesOfCell(mesh, e, displacement, InitialState(), law) : forces;
    result_.energyOfForm += (square - internal.cwiseProduct(u).sum()) / 2;
    const Span<const int> all = mesh.nodesOf(e);
    takeLoads(mesh, e, loads, scratch, all.begin(), int(all.size()), forces);
    for (BoundElement<2>& own : triangles) {
      if (initial.isIn(e)) addInitialStress(e, initial, law, own);
      own.forces = forcesOfStresses(own, result_.kind);
    }
    splitForces(parts, withNewNode(mesh.cells[e], parts, forces), result_.kind.order, triangles.data());
    for (std::size_t t = 0; t < triangles.size(); ++t) append(m, e, parts, t, triangles[t], conditions);
  }

  void append(int m, int e, const CellParts<2>& parts, std::size_t t, const BoundElement<2>& triangle,
              const SideConditions<2>& conditions) {
    const Span<const int> all = solution_.meshes[m].nodesOf(e);
    std::array<int, SimplexNodes<2>::most> nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const int node = parts.parts[t].nodes[i];
      nodes[i] = node >= 0 && node < int(all.size()) ? all[node] : -1;
    }
    result_.elements.push_back(triangle);
    BoundElement<2>& element = result_.elements.back();
    element.boundary.fill(-1);
    for (int a = 0; a < 3; ++a) {
      const int side = parts.parts[t].sides[a];
      if (side < 0 || conditions.isInner(e, side)) continue;
      element.boundary[a] = addBoundary(conditions, {m, e, int(result_.elements.size()) - 1, a}, side, nodes.data(), element);
    }
  }

  std::array<BoundElement<2>, 2> trianglesOf(const SubdomainMesh& mesh, int e, const CellParts<2>& parts, const SimplexLaw<2>& law,
                                             const std::vector<const Load*>& loads) {
    const Span<const int> all = mesh.nodesOf(e);
    std::array<BoundElement<2>, 2> triangles;
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
      addSources(mesh, e, loads, size, own);
    }
    if (std::abs(area - signedSize(mesh, e)) > kPolynomial * area)
      result_.reasons.insert("elements are so distorted that their parts overlap");
    return triangles;
  }

  static QuadrilateralField::Nodal nodalOf(const SubdomainMesh& mesh, int e, const Vector& u) {
    const Span<const int> all = mesh.nodesOf(e);
    QuadrilateralField::Nodal values(2, int(all.size()));
    for (std::size_t i = 0; i < all.size(); ++i) values.col(int(i)) = u.template segment<2>(2 * Eigen::Index(all[i]));
    return values;
  }

  /// True if a quadrilateral is not the bilinear image of the reference cell.
  static bool isCurvedCell(const SubdomainMesh& mesh, int e) {
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

  /// Forces of a quadrilateral, by its form, on its nodes.
  static CellForces forcesOfCell(const SubdomainMesh& mesh, int e, const Vector& u, const InitialState& initial, const SimplexLaw<2>& law) {
    CellForces forces = CellForces::Zero(2, int(mesh.nodesOf(e).size()));
    const ReferenceElement& reference = stiffnessElement(mesh, e);
    ElementStress<2> stress(mesh, e, reference, law.ofElements, u, initial);
    for (int q = 0; q < reference.points; ++q) {
      stress.at(q);
      const StressVector<2> s = stress.map().measure() * stress.stress();
      for (int i = 0; i < int(forces.cols()); ++i) forces.col(i) += forceOfStress<2>(stress.map().gradient(i), s);
    }
    return forces;
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

  void noteKinds(const SubdomainMesh& mesh) {
    if (mesh.axisymmetric) result_.reasons.insert("the scene is axisymmetric");
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

  const SimplexLaw<D>& lawOf(const SubdomainMesh& mesh, int e) {
    const Material& material = solution_.model.materialOf(mesh, e, mesh.body);
    const bool isMixed = material.element == ElementForm::Mixed && !(material.enhanced && mayBeEnhanced(mesh.cells[e]));
    if (&material == lastMaterial_ && isMixed == lastIsMixed_) return *lastLaw_;
    auto& law = laws_[&material];
    lastIsMixed_ = isMixed;
    if (isMixed) result_.reasons.insert("elements have a separate pressure (Mixed), which differs from that of their displacements");
    if (!law) law = std::make_unique<SimplexLaw<D>>(material, solution_.model.plane);
    lastMaterial_ = &material;
    lastLaw_ = law.get();
    return *law;
  }

  /// Forces by the quadrature of the stiffness, for every form and geometry of the elements.
  void addForces(const SubdomainMesh& mesh, int e, const Ordered& nodes, const Vector& u, const InitialState& initial,
                 const SimplexLaw<D>& law, BoundElement<D>& element) {
    element.forces.setZero();
    const ReferenceElement& reference = stiffnessElement(mesh, e);
    ElementStress<D> stress(mesh, e, reference, law.ofElements, u, initial);
    for (int q = 0; q < reference.points; ++q) {
      stress.at(q);
      const StressVector<D> s = stress.map().measure() * stress.stress();
      for (int i = 0; i < nodes.count; ++i) element.forces.col(i) += forceOfStress<D>(stress.map().gradient(nodes.local[i]), s);
    }
  }

  std::vector<const Load*> bodyLoads(const SubdomainMesh& mesh) {
    std::vector<const Load*> loads;
    for (const Load& load : solution_.model.loads) {
      const bool acts = load.onBody() && load.actsOn(solution_.model.bodies[mesh.body]);
      if (acts && load.onElements()) loads.push_back(&load);
      if (acts && load.isInitial() && (!load.expressions.empty() || load.isLocal))
        result_.reasons.insert("initial strains or stresses vary within the elements");
    }
    return loads;
  }

  Place bodyForce(const SubdomainMesh& mesh, int e, const std::vector<const Load*>& loads, const Place& place) {
    Point at{0, 0, 0};
    for (int k = 0; k < D; ++k) at[k] = place[k];
    Place sum = Place::Zero();
    for (const Load* load : loads) {
      const double mass = load->usesDensity() ? solution_.model.materialOf(mesh, e, mesh.body).density.value_or(0.0) : 1.0;
      const Point value = load->at(at);
      for (int k = 0; k < D; ++k) sum[k] += load->factor * mass * value[k];
    }
    return sum;
  }

  void addLoads(const SubdomainMesh& mesh, int e, const Ordered& nodes, const std::vector<const Load*>& loads, Vector& scratch,
                double volume, BoundElement<D>& element) {
    takeLoads(mesh, e, loads, scratch, nodes.node.data(), nodes.count, element.forces);
    addSources(mesh, e, loads, volume, element);
  }

  /// Subtracts the forces of loads on the nodes of an element. \param nodes  at the columns of `forces`
  template <typename Forces>
  void takeLoads(const SubdomainMesh& mesh, int e, const std::vector<const Load*>& loads, Vector& scratch, const int* nodes, int count,
                 Forces& forces) const {
    if (loads.empty()) return;
    const auto density = [&](int i) { return solution_.model.materialOf(mesh, i, mesh.body).density.value_or(0.0); };
    for (const Load* load : loads) addBodyForce(mesh, {e}, *load, scratch, density);
    for (int i = 0; i < count; ++i) {
      forces.col(i) -= scratch.template segment<D>(D * Eigen::Index(nodes[i]));
      scratch.template segment<D>(D * Eigen::Index(nodes[i])).setZero();
    }
  }

  void addSources(const SubdomainMesh& mesh, int e, const std::vector<const Load*>& loads, double volume, BoundElement<D>& element) {
    element.sources.setZero();
    if (loads.empty()) return;
    const Place centre = element.places.rowwise().mean();
    const Place middle = bodyForce(mesh, e, loads, centre);
    Eigen::Matrix<double, D, D + 1> corners;
    for (int i = 0; i <= D; ++i) corners.col(i) = bodyForce(mesh, e, loads, element.places.col(i));
    if (result_.kind.degree == 1)
      element.sources.col(0) = middle;
    else
      element.sources = corners;
    // Deviation from the polynomial at the centre and in the middle of the edges.
    double deviation = result_.kind.degree == 1 ? 0.0 : (middle - corners.rowwise().mean()).norm();
    for (int edge = 0; edge < Nodes::edges; ++edge) {
      const int i = Nodes::ends[edge][0], j = Nodes::ends[edge][1];
      const Place value = bodyForce(mesh, e, loads, 0.5 * (element.places.col(i) + element.places.col(j)));
      const Place expected = result_.kind.degree == 1 ? middle : Place(0.5 * (corners.col(i) + corners.col(j)));
      deviation = std::max(deviation, (value - expected).norm());
    }
    for (int i = 0; i <= D && result_.kind.degree == 1; ++i) deviation = std::max(deviation, (corners.col(i) - middle).norm());
    if (deviation <= kPolynomial * corners.cwiseAbs().maxCoeff()) return;
    result_.reasons.insert("body forces are not polynomials of degree " + std::to_string(result_.kind.degree - 1));
    // |f - f_h| h / pi (Poincare's inequality on a convex element) over the square root of the smallest stiffness.
    const double h = (element.places.rowwise().maxCoeff() - element.places.rowwise().minCoeff()).norm();
    const double soft = 1.0 / element.compliance.diagonal().maxCoeff();
    result_.oscillation += volume * deviation * deviation * h * h / (9.87 * soft);
  }

  /// Displacements relative to the first node.
  static typename SimplexField<D>::Nodal nodal(const Vector& u, const Ordered& nodes) {
    typename SimplexField<D>::Nodal all = SimplexField<D>::Nodal::Zero();
    for (int i = 1; i < nodes.count; ++i)
      all.col(i) = u.template segment<D>(D * Eigen::Index(nodes.node[i])) - u.template segment<D>(D * Eigen::Index(nodes.node[0]));
    return all;
  }

  void addStresses(int e, const Ordered& nodes, const Vector& u, const InitialState& initial, const SimplexLaw<D>& law,
                   const SimplexField<D>& field, BoundElement<D>& element) {
    element.stresses = law.stiffness * field.strains(nodal(u, nodes), result_.kind.order);
    result_.solutionNorm += field.energy(element.stresses, element.compliance);
    if (initial.isIn(e)) addInitialStress(e, initial, law, element);
  }

  void addInitialStress(int e, const InitialState& initial, const SimplexLaw<D>& law, BoundElement<D>& element) const {
    const auto c = stressPlaces<D>();
    for (int q = 0; q <= D; ++q) {
      Point at{0, 0, 0};
      const Place place = result_.kind.degree == 1 ? Place(element.places.rowwise().mean()) : Place(element.places.col(q));
      for (int k = 0; k < D; ++k) at[k] = place[k];
      const auto values = initial.template at<D>(e, at, law.full);
      const StressVector<D> stress = values.stress - law.full.pointwise * values.strain;
      for (int i = 0; i < n; ++i) element.stresses(i, q) += stress[c[i]];
    }
  }

  const BoundedSolution& solution_;
  const BoundaryParts& parts_;
  BoundParts<D> result_;
  std::map<const Material*, std::unique_ptr<SimplexLaw<D>>> laws_;
  const Material* lastMaterial_ = nullptr;
  const SimplexLaw<D>* lastLaw_ = nullptr;
  bool lastIsMixed_ = false;
};

}  // namespace

bool canBeBounded(const std::vector<SubdomainMesh>& meshes, std::array<int, 2>& orders, bool& simplices) {
  bool all = true;
  for (const SubdomainMesh& mesh : meshes)
    for (const Cell cell : mesh.cells) {
      const int order = cellInfo(cell).order;
      orders = {std::min(orders[0], order), std::max(orders[1], order)};
      if (isSimplex(cell)) continue;
      simplices = false;
      all = all && mesh.dimension == 2;
    }
  return all;
}

template <int D>
BoundParts<D> boundParts(const BoundedSolution& solution, const BoundaryParts& parts, const BoundKind& kind) {
  return Collector<D>(solution, parts, kind).collect();
}

template <int D>
std::array<int, SimplexNodes<D>::most> nodesOfSimplex(const BoundParts<D>& parts, const SubdomainMesh& mesh, const PlaceOfSide& place) {
  const CellParts<D> cut = cellParts<D>(mesh, place.element);
  std::array<int, SimplexNodes<D>::most> nodes = cut.parts[place.simplex - parts.ofMesh[place.mesh][place.element]].nodes;
  const Span<const int> all = mesh.nodesOf(place.element);
  for (int& node : nodes) node = node >= 0 && node < int(all.size()) ? all[node] : -1;
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
  template BoundParts<D> boundParts(const BoundedSolution&, const BoundaryParts&, const BoundKind&);                              \
  template std::array<int, SimplexNodes<D>::most> nodesOfSimplex(const BoundParts<D>&, const SubdomainMesh&, const PlaceOfSide&); \
  template typename SimplexField<D>::Nodal forcesOfStresses(const BoundElement<D>&, const BoundKind&);                            \
  template void addForcesOf(const SubdomainMesh&, int, int, const Matrix&, BoundParts<D>&);
SUTURE_BOUND_PARTS(2)
SUTURE_BOUND_PARTS(3)
#undef SUTURE_BOUND_PARTS

}  // namespace suture
