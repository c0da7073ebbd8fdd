#include <Eigen/Geometry>
#include <suture/answer/bound/BoundParts.hpp>
#include <suture/answer/bound/SideConditions.hpp>
#include <suture/answer/bound/SimplexField.hpp>
#include <suture/answer/bound/SupportedSides.hpp>
#include <suture/base/Point.hpp>
#include <suture/elasticity/ElementStress.hpp>

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

template <int D>
constexpr std::array<int, BoundElement<D>::stress> componentsOf() {
  if constexpr (D == 2)
    return {0, 1, 3};
  else
    return {0, 1, 2, 3, 4, 5};
}

/// Material data of the elements: the full law of displacements, whatever the form of the elements.
template <int D>
struct Law {
  static constexpr int n = BoundElement<D>::stress;
  HookesLaw<D> ofElements, full;
  Eigen::Matrix<double, n, n> stiffness, compliance;
  bool isFull = false;  ///< true: the elements have the full law themselves

  Law(Material material, PlaneModel plane) : ofElements(material, plane) {
    material.element = ElementForm::Displacement;
    material.enhanced = false;
    full = HookesLaw<D>(material, plane);
    isFull = ofElements.projected == 0.0 && ofElements.pointwise == full.pointwise;
    const auto c = componentsOf<D>();
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) stiffness(i, j) = full.pointwise(c[i], c[j]);
    if constexpr (D == 3) {
      compliance = full.compliance;
    } else {
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          compliance(i, j) = full.compliance(c[i], c[j]);
          // In plane strain the out-of-plane stress follows from the others.
          if (!full.isSheet()) compliance(i, j) -= full.compliance(c[i], 2) * full.compliance(2, c[j]) / full.compliance(2, 2);
        }
    }
  }
};

/// Length or area of the side opposite to a vertex.
template <int D>
double sideSize(const BoundElement<D>& element, int opposite) {
  Eigen::Matrix<double, D, D> corners;
  for (int i = 0, j = 0; i <= D; ++i)
    if (i != opposite) corners.col(j++) = element.places.col(i);
  if constexpr (D == 2)
    return (corners.col(1) - corners.col(0)).norm();
  else
    return (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).norm() / 2;
}

/// Energy of the elastic supports of an element whose nodes are displaced.
template <int D>
double energyOfSupports(const BoundParts<D>& parts, const BoundElement<D>& element, const typename SimplexField<D>::Nodal& nodal) {
  double energy = 0.0;
  for (int a = 0; a <= D; ++a) {
    if (element.boundary[a] < 0 || !parts.boundary[element.boundary[a]].isSupported()) continue;
    Eigen::Matrix<double, D, 6> moved = Eigen::Matrix<double, D, 6>::Zero();
    for (int j = 0; j < SimplexNodes<D>::sideNodes(parts.degree); ++j) moved.col(j) = nodal.col(SimplexNodes<D>::ofSide(a, j));
    energy += supportEnergy(parts.boundary[element.boundary[a]], parts.degree, sideSize(element, a), moved);
  }
  return energy;
}

template <int D>
class Collector {
 public:
  Collector(const BoundedSolution& solution, const BoundaryParts& parts, int degree) : solution_(solution), parts_(parts) {
    result_.degree = degree;
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
    result_.ofMesh.back().reserve(std::size_t(mesh.elements()));
    for (int e = 0; e < mesh.elements(); ++e) {
      result_.ofMesh.back().push_back(static_cast<int>(result_.elements.size()));
      BoundElement<D>& element = result_.elements.emplace_back();
      const Ordered nodes = orderedNodes(mesh, e, element);
      const SimplexField<D> field(element.places);
      const Law<D>& law = lawOf(mesh, e);
      element.compliance = law.compliance;
      addStresses(e, nodes, displacement, initial, law, field, element);
      if (!law.isFull || !nodes.isStraight || mesh.axisymmetric || initial.isIn(e))
        addForces(mesh, e, nodes, balanced, initial, law, element);
      else if (corrected)
        element.forces = field.forces(law.stiffness * field.strains(nodal(balanced, nodes), result_.degree), result_.degree);
      else
        element.forces = field.forces(element.stresses, result_.degree);
      addLoads(mesh, e, nodes, loads, scratch, field.volume(), element);
      element.boundary.fill(-1);
      for (int a = 0; a <= D; ++a) {
        const int side = sideOpposite(mesh.cells[e], nodes.local[a]);
        if (!conditions.isInner(e, side)) element.boundary[a] = addBoundary(conditions, {m, e, a}, side, nodes, element);
      }
    }
  }

  /// \param nodes  of the simplex
  int addBoundary(const SideConditions<D>& conditions, const PlaceOfSide& place, int side, const Ordered& nodes,
                  const BoundElement<D>& element) {
    std::vector<int> onSide;
    for (int j = 0; j < Nodes::sideNodes(result_.degree); ++j) onSide.push_back(nodes.node[Nodes::ofSide(place.opposite, j)]);
    const int number = static_cast<int>(result_.boundary.size());
    for (const int i : conditions.contactsOnA(place.element, side)) result_.onA[i].push_back(number);
    for (const int i : conditions.contactsOnB(place.element, side)) result_.onB[i].push_back(number);
    result_.boundary.push_back(conditions.of(place.element, side, onSide));
    const SideCondition<D>& own = result_.boundary.back();
    if (own.isSupported()) result_.solutionNorm += supportEnergy(own, result_.degree, sideSize(element, place.opposite), own.moved);
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
    if (result_.degree == 2) addMiddles(mesh, e, nodes);
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
      if (off > kStraightSide * length) result_.reasons.insert("elements have curved sides");
      nodes.isStraight = nodes.isStraight && off <= kExactlyStraight * length;
    }
  }

  const Law<D>& lawOf(const SubdomainMesh& mesh, int e) {
    const Material& material = solution_.model.materialOf(mesh, e, mesh.body);
    if (&material == lastMaterial_) return *lastLaw_;
    auto& law = laws_[&material];
    if (material.element == ElementForm::Mixed)
      result_.reasons.insert("elements have a separate pressure (Mixed), which differs from that of their displacements");
    if (!law) law = std::make_unique<Law<D>>(material, solution_.model.plane);
    lastMaterial_ = &material;
    lastLaw_ = law.get();
    return *law;
  }

  /// Forces by the quadrature of the stiffness, for every form and geometry of the elements.
  void addForces(const SubdomainMesh& mesh, int e, const Ordered& nodes, const Vector& u, const InitialState& initial, const Law<D>& law,
                 BoundElement<D>& element) {
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
    element.sources.setZero();
    if (loads.empty()) return;
    const auto density = [&](int i) { return solution_.model.materialOf(mesh, i, mesh.body).density.value_or(0.0); };
    for (const Load* load : loads) addBodyForce(mesh, {e}, *load, scratch, density);
    for (int i = 0; i < nodes.count; ++i) {
      element.forces.col(i) -= scratch.template segment<D>(D * Eigen::Index(nodes.node[i]));
      scratch.template segment<D>(D * Eigen::Index(nodes.node[i])).setZero();
    }
    const Place centre = element.places.rowwise().mean();
    const Place middle = bodyForce(mesh, e, loads, centre);
    Eigen::Matrix<double, D, D + 1> corners;
    for (int i = 0; i <= D; ++i) corners.col(i) = bodyForce(mesh, e, loads, element.places.col(i));
    if (result_.degree == 1)
      element.sources.col(0) = middle;
    else
      element.sources = corners;
    // Deviation from the polynomial at the centre and in the middle of the edges.
    double deviation = result_.degree == 1 ? 0.0 : (middle - corners.rowwise().mean()).norm();
    for (int edge = 0; edge < Nodes::edges; ++edge) {
      const int i = Nodes::ends[edge][0], j = Nodes::ends[edge][1];
      const Place value = bodyForce(mesh, e, loads, 0.5 * (element.places.col(i) + element.places.col(j)));
      const Place expected = result_.degree == 1 ? middle : Place(0.5 * (corners.col(i) + corners.col(j)));
      deviation = std::max(deviation, (value - expected).norm());
    }
    for (int i = 0; i <= D && result_.degree == 1; ++i) deviation = std::max(deviation, (corners.col(i) - middle).norm());
    if (deviation <= kPolynomial * corners.cwiseAbs().maxCoeff()) return;
    result_.reasons.insert("body forces are not polynomials of degree " + std::to_string(result_.degree - 1));
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

  void addStresses(int e, const Ordered& nodes, const Vector& u, const InitialState& initial, const Law<D>& law,
                   const SimplexField<D>& field, BoundElement<D>& element) {
    element.stresses = law.stiffness * field.strains(nodal(u, nodes), result_.degree);
    result_.solutionNorm += field.energy(element.stresses, element.compliance);
    if (!initial.isIn(e)) return;
    const auto c = componentsOf<D>();
    for (int q = 0; q <= D; ++q) {
      Point at{0, 0, 0};
      const Place place = result_.degree == 1 ? Place(element.places.rowwise().mean()) : Place(element.places.col(q));
      for (int k = 0; k < D; ++k) at[k] = place[k];
      const auto values = initial.template at<D>(e, at, law.full);
      const StressVector<D> stress = values.stress - law.full.pointwise * values.strain;
      for (int i = 0; i < n; ++i) element.stresses(i, q) += stress[c[i]];
    }
  }

  const BoundedSolution& solution_;
  const BoundaryParts& parts_;
  BoundParts<D> result_;
  std::map<const Material*, std::unique_ptr<Law<D>>> laws_;
  const Material* lastMaterial_ = nullptr;
  const Law<D>* lastLaw_ = nullptr;
};

}  // namespace

bool areSimplices(const std::vector<SubdomainMesh>& meshes, std::array<int, 2>& degrees) {
  bool all = true;
  for (const SubdomainMesh& mesh : meshes)
    for (const Cell cell : mesh.cells) {
      const int order = cellInfo(cell).order;
      all = all && isSimplex(cell);
      degrees = {std::min(degrees[0], order), std::max(degrees[1], order)};
    }
  return all;
}

template <int D>
BoundParts<D> boundParts(const BoundedSolution& solution, const BoundaryParts& parts, int degree) {
  return Collector<D>(solution, parts, degree).collect();
}

template <int D>
Vector liftEnergies(const BoundParts<D>& parts, const BoundedSolution& solution, const std::map<GlobalId, Point>& lifts) {
  using Nodes = SimplexNodes<D>;
  Vector energies = Vector::Zero(Eigen::Index(parts.elements.size()));
  if (lifts.empty()) return energies;
  for (std::size_t m = 0; m < solution.meshes.size(); ++m) {
    const SubdomainMesh& mesh = solution.meshes[m];
    std::map<int, Point> here;
    for (const auto& [node, value] : lifts) {
      const auto found = std::lower_bound(mesh.globalNodes.begin(), mesh.globalNodes.end(), node);
      if (found != mesh.globalNodes.end() && *found == node) here[int(found - mesh.globalNodes.begin())] = value;
    }
    if (here.empty()) continue;
    for (int e = 0; e < mesh.elements(); ++e) {
      const Span<const int> all = mesh.nodesOf(e);
      const CellInfo& cell = cellInfo(mesh.cells[e]);
      const BoundElement<D>& element = parts.elements[parts.ofMesh[m][e]];
      typename SimplexField<D>::Nodal nodal = SimplexField<D>::Nodal::Zero();
      const auto place = [&](int node) {
        const GlobalId id = mesh.globalNodes[node];
        return int(std::find(element.vertices.begin(), element.vertices.end(), id) - element.vertices.begin());
      };
      for (std::size_t i = 0; i < all.size(); ++i) {
        const auto found = here.find(all[i]);
        if (found == here.end()) continue;
        int at = 0;
        if (int(i) < cell.vertices) {
          at = place(all[i]);
        } else {
          const auto& ends = cell.edges[i - std::size_t(cell.vertices)];
          const int a = place(all[ends[0]]), b = place(all[ends[1]]);
          at = D + 1 + Nodes::edge(std::min(a, b), std::max(a, b));
        }
        for (int k = 0; k < D; ++k) nodal(k, at) = found->second[k];
      }
      if (nodal.isZero(0.0)) continue;
      const Law<D> law(solution.model.materialOf(mesh, e, mesh.body), solution.model.plane);
      const SimplexField<D> field(element.places);
      const typename SimplexField<D>::AtVertices change = law.stiffness * field.strains(nodal, parts.degree);
      energies[parts.ofMesh[m][e]] = field.energy(change, element.compliance) + energyOfSupports(parts, element, nodal);
    }
  }
  return energies;
}

template struct BoundParts<2>;
template struct BoundParts<3>;
template BoundParts<2> boundParts(const BoundedSolution&, const BoundaryParts&, int);
template BoundParts<3> boundParts(const BoundedSolution&, const BoundaryParts&, int);
template Vector liftEnergies(const BoundParts<2>&, const BoundedSolution&, const std::map<GlobalId, Point>&);
template Vector liftEnergies(const BoundParts<3>&, const BoundedSolution&, const std::map<GlobalId, Point>&);

}  // namespace suture
