#include <Eigen/Geometry>
#include <Eigen/LU>
#include <suture/answer/bound/BoundParts.hpp>
#include <suture/answer/bound/SideConditions.hpp>
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
constexpr double kStraight = 1e-9;
constexpr double kPolynomial = 1e-9;

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
  HookesLaw<D> full;
  Eigen::Matrix<double, n, n> stiffness, compliance;

  Law(Material material, PlaneModel plane) {
    material.element = ElementForm::Displacement;
    material.enhanced = false;
    full = HookesLaw<D>(material, plane);
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

template <int D>
double volume(const BoundElement<D>& element) {
  Eigen::Matrix<double, D, D> map;
  for (int i = 0; i < D; ++i) map.col(i) = element.places.col(i + 1) - element.places.col(0);
  return std::abs(map.determinant()) / (D == 2 ? 2 : 6);
}

/// Integral of s.C s for a stress that is linear in an element.
template <int D>
double energyOf(const BoundElement<D>& element, const Eigen::Matrix<double, BoundElement<D>::stress, D + 1>& stresses) {
  const Eigen::Matrix<double, BoundElement<D>::stress, 1> sum = stresses.rowwise().sum();
  double squares = sum.dot(element.compliance * sum);
  for (int q = 0; q <= D; ++q) squares += stresses.col(q).dot(element.compliance * stresses.col(q));
  return volume(element) / ((D + 1) * (D + 2)) * squares;
}

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

/// Elastic supports of an element whose nodes are lifted.
template <int D>
void liftSupports(BoundParts<D>& parts, const BoundElement<D>& element, const Eigen::Matrix<double, D, (D == 2 ? 6 : 10)>& nodal) {
  for (int a = 0; a <= D; ++a) {
    if (element.boundary[a] < 0 || !parts.boundary[element.boundary[a]].isSupported()) continue;
    SideCondition<D>& side = parts.boundary[element.boundary[a]];
    Eigen::Matrix<double, D, 6> change = Eigen::Matrix<double, D, 6>::Zero();
    for (int j = 0; j < SimplexNodes<D>::sideNodes(parts.degree); ++j) change.col(j) = nodal.col(SimplexNodes<D>::ofSide(a, j));
    side.moved += change;
    parts.liftNorm += supportEnergy(side, parts.degree, sideSize(element, a), change);
  }
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
    for (std::size_t m = 0; m < solution_.meshes.size(); ++m) addMesh(static_cast<int>(m));
    return std::move(result_);
  }

 private:
  using Nodes = SimplexNodes<D>;
  using Place = Eigen::Matrix<double, D, 1>;
  static constexpr int n = BoundElement<D>::stress;

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
    for (int e = 0; e < mesh.elements(); ++e) {
      BoundElement<D> element;
      const std::vector<int> nodes = orderedNodes(mesh, e, element);
      const Law<D>& law = lawOf(mesh, e);
      element.compliance = law.compliance;
      addForces(mesh, e, nodes, balanced, initial, element);
      addLoads(mesh, e, nodes, loads, scratch, element);
      addStresses(e, nodes, displacement, initial, law, element);
      element.boundary.fill(-1);
      for (int a = 0; a <= D; ++a) {
        const int side = sideOpposite(mesh, e, nodes[a]);
        if (!conditions.isInner(e, side)) element.boundary[a] = addBoundary(conditions, {m, e, a}, side, nodes, element);
      }
      result_.ofMesh.back().push_back(static_cast<int>(result_.elements.size()));
      result_.elements.push_back(element);
    }
  }

  /// \param nodes  of the simplex
  int addBoundary(const SideConditions<D>& conditions, const PlaceOfSide& place, int side, const std::vector<int>& nodes,
                  const BoundElement<D>& element) {
    std::vector<int> onSide;
    for (int j = 0; j < Nodes::sideNodes(result_.degree); ++j) onSide.push_back(nodes[Nodes::ofSide(place.opposite, j)]);
    const int number = static_cast<int>(result_.boundary.size());
    for (const int i : conditions.contactsOnA(place.element, side)) result_.onA[i].push_back(number);
    for (const int i : conditions.contactsOnB(place.element, side)) result_.onB[i].push_back(number);
    result_.boundary.push_back(conditions.of(place.element, side, onSide));
    const SideCondition<D>& own = result_.boundary.back();
    if (own.isSupported()) result_.solutionNorm += supportEnergy(own, result_.degree, sideSize(element, place.opposite), own.moved);
    result_.places.push_back(place);
    return number;
  }

  static int sideOpposite(const SubdomainMesh& mesh, int e, int node) {
    const Span<const int> nodes = mesh.nodesOf(e);
    const auto& sides = cellInfo(mesh.cells[e]).sideNodes;
    for (std::size_t s = 0; s < sides.size(); ++s)
      if (std::none_of(sides[s].begin(), sides[s].end(), [&](int local) { return nodes[local] == node; })) return int(s);
    throw InternalError("a simplex without a side opposite to a vertex");
  }

  void noteKinds(const SubdomainMesh& mesh) {
    if (mesh.axisymmetric) result_.reasons.insert("the scene is axisymmetric");
  }

  /// Local nodes of an element in the order of SimplexNodes.
  std::vector<int> orderedNodes(const SubdomainMesh& mesh, int e, BoundElement<D>& element) {
    const Span<const int> all = mesh.nodesOf(e);
    const CellInfo& cell = cellInfo(mesh.cells[e]);
    std::vector<int> nodes(all.begin(), all.begin() + D + 1);
    std::sort(nodes.begin(), nodes.end());  // ascending also in the numbers of the mesh
    for (int i = 0; i <= D; ++i) {
      element.vertices[i] = mesh.globalNodes[nodes[i]];
      const Point p = mesh.point(nodes[i]);
      for (int k = 0; k < D; ++k) element.places(k, i) = p[k];
    }
    if (cell.order == 1) return nodes;
    for (int edge = 0; edge < Nodes::edges; ++edge) {
      const int a = nodes[Nodes::ends[edge][0]], b = nodes[Nodes::ends[edge][1]];
      for (std::size_t i = 0; i < cell.edges.size(); ++i) {
        const int c = all[cell.edges[i][0]], d = all[cell.edges[i][1]];
        if ((a == c && b == d) || (a == d && b == c)) nodes.push_back(all[cell.vertices + i]);
      }
      const Point middle = scaled(0.5, plus(mesh.point(a), mesh.point(b)));
      if (norm(minus(mesh.point(nodes.back()), middle)) > kStraight * norm(minus(mesh.point(a), mesh.point(b))))
        result_.reasons.insert("elements have curved sides");
    }
    return nodes;
  }

  const Law<D>& lawOf(const SubdomainMesh& mesh, int e) {
    const Material& material = solution_.model.materialOf(mesh, e, mesh.body);
    auto& law = laws_[&material];
    if (material.element == ElementForm::Mixed)
      result_.reasons.insert("elements have a separate pressure (Mixed), which differs from that of their displacements");
    if (!law) law = std::make_unique<Law<D>>(material, solution_.model.plane);
    return *law;
  }

  void addForces(const SubdomainMesh& mesh, int e, const std::vector<int>& nodes, const Vector& u, const InitialState& initial,
                 BoundElement<D>& element) {
    element.forces.setZero();
    const Material& material = solution_.model.materialOf(mesh, e, mesh.body);
    const HookesLaw<D> law(material, solution_.model.plane);
    const ReferenceElement& reference = stiffnessElement(mesh, e);
    ElementStress<D> stress(mesh, e, reference, law, u, initial);
    const Span<const int> all = mesh.nodesOf(e);
    for (int q = 0; q < reference.points; ++q) {
      stress.at(q);
      const StressVector<D> s = stress.map().measure() * stress.stress();
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const int a = int(std::find(all.begin(), all.end(), nodes[i]) - all.begin());
        element.forces.col(int(i)) += forceOfStress<D>(stress.map().gradient(a), s);
      }
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

  void addLoads(const SubdomainMesh& mesh, int e, const std::vector<int>& nodes, const std::vector<const Load*>& loads, Vector& scratch,
                BoundElement<D>& element) {
    element.sources.setZero();
    if (loads.empty()) return;
    const auto density = [&](int i) { return solution_.model.materialOf(mesh, i, mesh.body).density.value_or(0.0); };
    for (const Load* load : loads) addBodyForce(mesh, {e}, *load, scratch, density);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      element.forces.col(int(i)) -= scratch.template segment<D>(D * Eigen::Index(nodes[i]));
      scratch.template segment<D>(D * Eigen::Index(nodes[i])).setZero();
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
    result_.oscillation += volume(element) * deviation * deviation * h * h / (9.87 * soft);
  }

  void addStresses(int e, const std::vector<int>& nodes, const Vector& u, const InitialState& initial, const Law<D>& law,
                   BoundElement<D>& element) {
    Eigen::Matrix<double, D, (D == 2 ? 6 : 10)> nodal;
    nodal.setZero();
    for (std::size_t i = 0; i < nodes.size(); ++i)
      nodal.col(int(i)) = (u.template segment<D>(D * Eigen::Index(nodes[i])) - u.template segment<D>(D * Eigen::Index(nodes[0]))).eval();
    element.stresses = law.stiffness * strains(element, nodal, result_.degree);
    result_.solutionNorm += energyOf<D>(element, element.stresses);
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

 public:
  /// Strains at the vertices of a simplex, with engineering shear.
  static Eigen::Matrix<double, n, D + 1> strains(const BoundElement<D>& element, const Eigen::Matrix<double, D, (D == 2 ? 6 : 10)>& nodal,
                                                 int degree) {
    Eigen::Matrix<double, D, D> map;
    for (int i = 0; i < D; ++i) map.col(i) = element.places.col(i + 1) - element.places.col(0);
    Eigen::Matrix<double, D + 1, D> gradients;
    gradients.template bottomRows<D>() = map.inverse();
    gradients.row(0) = -gradients.template bottomRows<D>().colwise().sum();
    Eigen::Matrix<double, n, D + 1> all;
    for (int q = 0; q <= D; ++q) {
      Eigen::Matrix<double, D, D> slope = Eigen::Matrix<double, D, D>::Zero();  // du_i / dx_j
      for (int i = 0; i <= D; ++i) slope += (degree == 1 ? 1.0 : (i == q ? 3.0 : -1.0)) * nodal.col(i) * gradients.row(i);
      if (degree == 2)
        for (int edge = 0; edge < Nodes::edges; ++edge)
          for (int side = 0; side < 2; ++side)
            if (Nodes::ends[edge][side] == q) slope += 4.0 * nodal.col(D + 1 + edge) * gradients.row(Nodes::ends[edge][1 - side]);
      if constexpr (D == 2)
        all.col(q) << slope(0, 0), slope(1, 1), slope(0, 1) + slope(1, 0);
      else
        all.col(q) << slope(0, 0), slope(1, 1), slope(2, 2), slope(0, 1) + slope(1, 0), slope(1, 2) + slope(2, 1),
            slope(0, 2) + slope(2, 0);
    }
    return all;
  }

 private:
  const BoundedSolution& solution_;
  const BoundaryParts& parts_;
  BoundParts<D> result_;
  std::map<const Material*, std::unique_ptr<Law<D>>> laws_;
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
void lift(BoundParts<D>& parts, const BoundedSolution& solution, const std::map<GlobalId, Point>& lifts) {
  using Nodes = SimplexNodes<D>;
  if (lifts.empty()) return;
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
      BoundElement<D>& element = parts.elements[parts.ofMesh[m][e]];
      Eigen::Matrix<double, D, (D == 2 ? 6 : 10)> nodal;
      nodal.setZero();
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
      const Eigen::Matrix<double, BoundElement<D>::stress, D + 1> change =
          law.stiffness * Collector<D>::strains(element, nodal, parts.degree);
      element.stresses += change;
      parts.liftNorm += energyOf<D>(element, change);
      liftSupports(parts, element, nodal);
    }
  }
}

template struct BoundParts<2>;
template struct BoundParts<3>;
template BoundParts<2> boundParts(const BoundedSolution&, const BoundaryParts&, int);
template BoundParts<3> boundParts(const BoundedSolution&, const BoundaryParts&, int);
template void lift(BoundParts<2>&, const BoundedSolution&, const std::map<GlobalId, Point>&);
template void lift(BoundParts<3>&, const BoundedSolution&, const std::map<GlobalId, Point>&);

}  // namespace suture
