#include <Eigen/LU>
#include <suture/answer/bound/BoundParts.hpp>
#include <suture/base/Point.hpp>
#include <suture/elasticity/ElementStress.hpp>
#include <suture/mesh/SideGeometry.hpp>
#include <suture/pairs/PairFrame.hpp>

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

template <int D>
class Collector {
 public:
  Collector(const BoundedSolution& solution, const BoundaryParts& parts) : solution_(solution), parts_(parts) {}

  BoundParts<D> collect() {
    areSimplices(solution_.meshes, result_.degree);
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
    const std::map<std::pair<int, int>, Conditions> conditions = conditionsOf(mesh);
    const std::vector<char> inner = innerSides(mesh);
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
        if (inner[static_cast<std::size_t>(e) * (D + 1) + side]) continue;
        const auto found = conditions.find({e, side});
        element.boundary[a] = addBoundary(mesh, m, e, side, a, nodes, found == conditions.end() ? Conditions() : found->second);
      }
      result_.ofMesh.back().push_back(static_cast<int>(result_.elements.size()));
      result_.elements.push_back(element);
    }
  }

  void noteKinds(const SubdomainMesh& mesh) {
    if (mesh.axisymmetric) result_.reasons.insert("the scene is axisymmetric");
    if (!mesh.coatings.empty()) result_.reasons.insert("contacts are softened");
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
      if (acts && load.isInitial() && !load.expressions.empty())
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
    if (result_.degree == 1) element.sources.col(0) = middle;
    Eigen::Matrix<double, D, D + 1> corners;
    for (int i = 0; i <= D; ++i) corners.col(i) = bodyForce(mesh, e, loads, element.places.col(i));
    if (result_.degree == 2) element.sources = corners;
    Eigen::Matrix<double, D, D + 1> deviation = corners;
    if (result_.degree == 1)
      deviation.colwise() -= middle;
    else
      deviation.colwise() = Place(middle - corners.rowwise().mean());
    const double size = corners.cwiseAbs().maxCoeff();
    if (deviation.cwiseAbs().maxCoeff() <= kPolynomial * size) return;
    result_.reasons.insert("body forces are not polynomials of degree " + std::to_string(result_.degree - 1));
    // |f - f_h| h / pi, the Poincare inequality on a convex element, over the smallest stiffness.
    const double h = (element.places.rowwise().maxCoeff() - element.places.rowwise().minCoeff()).norm();
    const double soft = 1.0 / element.compliance.diagonal().maxCoeff();
    result_.oscillation += volume(element) * deviation.squaredNorm() / (D + 1) * h * h / (9.87 * soft);
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
  /// Loads and conditions on a side.
  struct Conditions {
    std::vector<const Load*> loads;
    std::vector<int> held, onA, onB;  // numbers in BoundaryParts
    bool onSprings = false, isRigid = false, onMean = false;
  };

  std::map<std::pair<int, int>, Conditions> conditionsOf(const SubdomainMesh& mesh) {
    std::map<std::pair<int, int>, Conditions> all;
    const auto each = [&](const std::vector<std::string>& groups, const auto& take) {
      for (const Side& side : sidesOf(mesh.sideGroups, groups)) take(all[{side.element, side.side}]);
    };
    for (const Load& load : solution_.model.loads)
      if (!load.onBody() && !load.groups.empty()) each(load.groups, [&](Conditions& on) { on.loads.push_back(&load); });
    for (std::size_t i = 0; i < parts_.held.size(); ++i) each(parts_.held[i].groups, [&](Conditions& on) { on.held.push_back(int(i)); });
    for (std::size_t i = 0; i < parts_.touching.size(); ++i) {
      each(parts_.touching[i].groupsA, [&](Conditions& on) { on.onA.push_back(int(i)); });
      each(parts_.touching[i].groupsB, [&](Conditions& on) { on.onB.push_back(int(i)); });
    }
    each(parts_.onSprings, [](Conditions& on) { on.onSprings = true; });
    each(parts_.rigid, [](Conditions& on) { on.isRigid = true; });
    each(parts_.onMean, [](Conditions& on) { on.onMean = true; });
    return all;
  }

  /// True for the sides (element x (D + 1) + side) that two elements share.
  static std::vector<char> innerSides(const SubdomainMesh& mesh) {
    std::vector<char> inner(std::size_t(mesh.elements()) * (D + 1), 0);
    std::vector<std::vector<std::pair<SideKey, int>>> open(mesh.nodes());
    for (int e = 0; e < mesh.elements(); ++e)
      forEachSide(mesh, e, [&](const SideKey& key, const Side& side) {
        const int own = e * (D + 1) + side.side;
        for (const auto& [other, number] : open[key.low])
          if (other == key) {
            inner[own] = inner[number] = 1;
            return;
          }
        open[key.low].push_back({key, own});
      });
    for (const SubdomainMesh::SeamSide& side : mesh.seamSides) inner[std::size_t(side.element) * (D + 1) + side.side] = 1;
    return inner;
  }

  static int sideOpposite(const SubdomainMesh& mesh, int e, int node) {
    const Span<const int> nodes = mesh.nodesOf(e);
    const auto& sides = cellInfo(mesh.cells[e]).sideNodes;
    for (std::size_t s = 0; s < sides.size(); ++s)
      if (std::none_of(sides[s].begin(), sides[s].end(), [&](int local) { return nodes[local] == node; })) return int(s);
    throw InternalError("a simplex without a side opposite to a vertex");
  }

  int addBoundary(const SubdomainMesh& mesh, int m, int e, int side, int a, const std::vector<int>& nodes, const Conditions& on) {
    BoundarySide<D> own;
    const std::vector<int> onSide = mesh.nodesOf(Side{e, side});
    std::vector<Point> points;
    for (const int node : onSide) points.push_back(mesh.point(node));
    const Point normal = unit(nodeNormals(points, D)[0].density);
    hold(own, on, normal);
    std::vector<Point> at;  // nodes of the side in the order of the bound
    for (int j = 0; j < Nodes::sideNodes(result_.degree); ++j) at.push_back(mesh.point(nodes[Nodes::ofSide(a, j)]));
    for (const Load* load : on.loads) addTraction(*load, normal, at, own);
    if (on.onSprings) result_.reasons.insert("sides rest on elastic supports");
    if (on.onMean) result_.reasons.insert("mean displacements are prescribed");
    if (on.onSprings) unknownAll(own);
    if (on.isRigid) own.kept = unknownAll(own);
    const int number = static_cast<int>(result_.boundary.size());
    for (const int i : on.onA) result_.onA[i].push_back(number);
    for (const int i : on.onB) result_.onB[i].push_back(number);
    result_.boundary.push_back(own);
    result_.places.push_back({m, e, a});
    return number;
  }

  /// Makes all components unknown. Returns their bits.
  static unsigned unknownAll(BoundarySide<D>& own) {
    own.known = 0;
    return (1u << D) - 1;
  }

  void hold(BoundarySide<D>& own, const Conditions& on, const Point& normal) {
    unsigned held = 0;
    bool alongNormal = false;
    for (const int i : on.held) {
      const HeldSides& part = parts_.held[i];
      if (!part.isPolynomial) result_.reasons.insert("prescribed displacements are not polynomials of the order of the elements");
      if (part.alongOther) result_.reasons.insert("a displacement is prescribed along a direction"), unknownAll(own);
      alongNormal = alongNormal || part.alongNormal;
      for (int k = 0; k < D; ++k)
        if (part.components[k]) held |= 1u << k;
    }
    if (own.known == 0) return;
    if (!alongNormal) {
      own.known &= ~held;
      return;
    }
    for (int k = 0; k < D; ++k)
      if (std::abs(normal[k]) > 1 - kStraight) {
        own.known &= ~(held | 1u << k);
        return;
      }
    if (held == 0) {
      const std::vector<Point> axes = pairFrame(normal, D);
      for (int i = 0; i < D; ++i)
        for (int k = 0; k < D; ++k) own.axes(i, k) = axes[i][k];
      own.known &= ~1u;
    } else {
      result_.reasons.insert("a side is held along its normal and along another direction");
      unknownAll(own);
    }
  }

  void addTraction(const Load& load, const Point& normal, const std::vector<Point>& at, BoundarySide<D>& own) {
    const auto valueAt = [&](const Point& point) {
      const Point value = scaled(load.factor, load.at(point));
      return load.kind == Load::Kind::Pressure ? scaled(-value[0], normal) : value;
    };
    if (load.kind != Load::Kind::Pressure && load.kind != Load::Kind::Traction) return;
    double size = 0.0;
    for (std::size_t j = 0; j < at.size(); ++j) {
      const Point value = valueAt(at[j]);
      size = std::max(size, norm(value));
      for (int k = 0; k < D; ++k) own.traction(k, int(j)) += value[k];
    }
    if (load.expressions.empty()) return;
    // Compared at a third of the first edge.
    const double r = 1.0 / 3;
    const Point point = plus(scaled(1 - r, at[0]), scaled(r, at[1])), value = valueAt(point);
    const Point first = valueAt(at[0]), second = valueAt(at[1]);
    Point expected = plus(scaled(1 - r, first), scaled(r, second));
    if (result_.degree == 2) {
      const Point middle = valueAt(D == 2 ? at[2] : at[3]);
      expected = plus(plus(scaled((1 - r) * (1 - 2 * r), first), scaled(r * (2 * r - 1), second)), scaled(4 * r * (1 - r), middle));
    }
    if (norm(minus(value, expected)) > kPolynomial * size)
      result_.reasons.insert("tractions are not polynomials of the order of the elements");
  }

  const BoundedSolution& solution_;
  const BoundaryParts& parts_;
  BoundParts<D> result_;
  std::map<const Material*, std::unique_ptr<Law<D>>> laws_;
};

}  // namespace

bool areSimplices(const std::vector<SubdomainMesh>& meshes, int& degree) {
  bool all = true;
  for (const SubdomainMesh& mesh : meshes)
    for (const Cell cell : mesh.cells) {
      all = all && isSimplex(cell);
      degree = std::max(degree, cellInfo(cell).order);
    }
  return all;
}

template <int D>
BoundParts<D> boundParts(const BoundedSolution& solution, const BoundaryParts& parts) {
  return Collector<D>(solution, parts).collect();
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
    }
  }
}

template struct BoundParts<2>;
template struct BoundParts<3>;
template BoundParts<2> boundParts(const BoundedSolution&, const BoundaryParts&);
template BoundParts<3> boundParts(const BoundedSolution&, const BoundaryParts&);
template void lift(BoundParts<2>&, const BoundedSolution&, const std::map<GlobalId, Point>&);
template void lift(BoundParts<3>&, const BoundedSolution&, const std::map<GlobalId, Point>&);

}  // namespace suture
