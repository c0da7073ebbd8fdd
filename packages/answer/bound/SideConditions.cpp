#include <suture/answer/bound/PressedSides.hpp>
#include <suture/answer/bound/SideConditions.hpp>
#include <suture/base/Point.hpp>
#include <suture/elasticity/SideMap.hpp>
#include <suture/mesh/SideGeometry.hpp>
#include <suture/mesh/SideInterpolation.hpp>
#include <suture/pairs/PairFrame.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// Displacement along the normal of a roller, relative to the largest displacement, that is round-off.
constexpr double kOnRoller = 1e-9;
// Differences of the areas of a side's triangles, relative to its size, that are round-off.
constexpr double kParallelogram = 1e-9;

template <int D>
constexpr unsigned allComponents = (1u << D) - 1;

/// Coordinate axis along a normal; -1: none.
int axisAlong(const Point& normal) {
  for (int k = 0; k < 3; ++k)
    if (normal[(k + 1) % 3] == 0.0 && normal[(k + 2) % 3] == 0.0) return k;
  return -1;
}

/// Largest second difference of nodal values on a side with four vertices that functions of its two triangles do not have: of order 1
/// deviations from an affine function, of order 2 from a polynomial of degree 2 (on parallelograms), or an affine function. Zero if the
/// side is warped, which is noted elsewhere. \param points  nodes in the order of SideGeometry.hpp
double deviationFromTriangles(const std::vector<Point>& points, const std::vector<double>& values) {
  const auto area = [&](int a, int b, int c) {
    return norm(cross(minus(points[std::size_t(b)], points[std::size_t(a)]), minus(points[std::size_t(c)], points[std::size_t(a)])));
  };
  const double weights[4] = {area(1, 2, 3), area(0, 2, 3), area(0, 1, 3), area(0, 1, 2)};
  const double sum = weights[0] + weights[1] + weights[2] + weights[3];
  const double twist = std::abs(weights[0] * values[0] - weights[1] * values[1] + weights[2] * values[2] - weights[3] * values[3]) / sum;
  if (points.size() == 4) return twist;
  const double skew = std::max({std::abs(weights[0] - weights[1]), std::abs(weights[1] - weights[2]), std::abs(weights[2] - weights[3])});
  double bend = 0.0, cubic = 0.0;
  const auto second = [&](std::size_t i) { return values[i] + values[(i + 1) % 4] - 2 * values[i + 4]; };
  for (std::size_t i = 0; i < 4; ++i) bend = std::max(bend, std::abs(second(i)));
  for (std::size_t i = 0; i < 2; ++i) cubic = std::max(cubic, std::abs(second(i) - second(i + 2)));
  if (points.size() == 9) {
    for (std::size_t i = 0; i < 2; ++i) {
      const double across = values[4 + i] + values[6 + i] - 2 * values[8];
      cubic = std::max(cubic, std::abs(second(1 - i) - across));
    }
  }
  return skew <= kParallelogram * sum ? cubic : std::max({cubic, bend, twist});
}

}  // namespace

template <int D>
SideConditions<D>::SideConditions(const SubdomainMesh& mesh, const ElasticModel& model, const BoundaryParts& parts,
                                  const Vector& displacement, std::set<std::string>& reasons)
    : mesh_(mesh), model_(model), parts_(parts), displacement_(displacement), reasons_(reasons) {
  collect();
  findInner();
  for (Eigen::Index i = 0; i < displacement.size(); ++i) largest_ = std::max(largest_, std::abs(mesh.total(displacement, i)));
}

template <int D>
void SideConditions<D>::collect() {
  const auto each = [&](const std::vector<std::string>& groups, const auto& take) {
    for (const Side& side : sidesOf(mesh_.sideGroups, groups)) take(sides_[{side.element, side.side}]);
  };
  for (const Load& load : model_.loads)
    if (!load.onBody() && !load.groups.empty()) each(load.groups, [&](OnSide& on) { on.loads.push_back(&load); });
  for (std::size_t i = 0; i < parts_.held.size(); ++i) each(parts_.held[i].groups, [&](OnSide& on) { on.held.push_back(int(i)); });
  for (std::size_t i = 0; i < parts_.touching.size(); ++i) {
    each(parts_.touching[i].groupsA, [&](OnSide& on) { on.onA.push_back(int(i)); });
    each(parts_.touching[i].groupsB, [&](OnSide& on) { on.onB.push_back(int(i)); });
  }
  for (const ElasticSupport& support : model_.supports)
    each(support.groups, [&](OnSide& on) { on.normalStiffness += support.normal, on.tangentialStiffness += support.tangential; });
  each(parts_.rigid, [](OnSide& on) { on.isRigid = true; });
  each(parts_.onMean, [](OnSide& on) { on.onMean = true; });
}

template <int D>
void SideConditions<D>::findInner() {
  inner_.assign(std::size_t(mesh_.elements()) * kMostSides, 0);
  std::vector<std::vector<std::pair<SideKey, std::size_t>>> open(mesh_.nodes());
  for (int e = 0; e < mesh_.elements(); ++e)
    forEachSide(mesh_, e, [&](const SideKey& key, const Side& side) {
      const std::size_t own = std::size_t(e) * kMostSides + side.side;
      for (const auto& [other, number] : open[key.low])
        if (other == key) {
          inner_[own] = inner_[number] = 1;
          return;
        }
      open[key.low].push_back({key, own});
    });
  for (const SubdomainMesh::SeamSide& side : mesh_.seamSides) inner_[std::size_t(side.element) * kMostSides + side.side] = 1;
}

template <int D>
const typename SideConditions<D>::OnSide& SideConditions<D>::at(int element, int side) const {
  static const OnSide nothing;
  const auto found = sides_.find({element, side});
  return found == sides_.end() ? nothing : found->second;
}

/// Places of the nodes of a side; the middle of an edge between its ends.
template <int D>
std::vector<Point> SideConditions<D>::placesOf(const std::vector<int>& nodes) const {
  std::vector<Point> places;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i] >= 0) {
      places.push_back(mesh_.point(nodes[i]));
      continue;
    }
    const auto [a, b] = edgeVertices(int(i) - D);
    places.push_back(scaled(0.5, plus(places[std::size_t(a)], places[std::size_t(b)])));
  }
  return places;
}

template <int D>
SideCondition<D> SideConditions<D>::of(int element, int side, const std::vector<int>& nodes) const {
  const OnSide& on = at(element, side);
  std::vector<Point> points;
  for (const int node : mesh_.nodesOf(Side{element, side})) points.push_back(mesh_.point(node));
  Point normal = unit(nodeNormals(points, D)[0].density);
  const std::vector<Point> places = placesOf(nodes);
  const bool isTriangle = D == 3 && sideVertices(int(points.size()), D) == 4;
  if (isTriangle) {
    const Point own = unit(cross(minus(places[1], places[0]), minus(places[2], places[0])));
    const bool isAxis = axisAlong(normal) >= 0;  // without round-off
    if (!isAxis) normal = dot(own, normal) > 0 ? own : scaled(-1.0, own);
    points = places;
  }
  SideCondition<D> own;
  hold(own, on, normal, nodes);
  if (isTriangle) checkHeld({element, side}, own);
  for (const Load* load : on.loads)
    if (load->kind == Load::Kind::Pressure || load->kind == Load::Kind::Traction) {
      addTraction(*load, normal, places, own);
      for (int k = 0; k < D; ++k)
        if (!load->expressions.empty() && !isInterpolated(points, D, [&](const Point& p) {
              return load->at(p)[load->kind == Load::Kind::Pressure ? 0 : std::size_t(k)];
            }))
          remark("tractions are not polynomials of the order of the elements");
    }
  if (on.normalStiffness > 0.0 || on.tangentialStiffness > 0.0) support(own, on, normal, nodes);
  if (on.onMean) remark("mean displacements are prescribed");
  if (on.isRigid) {
    if (own.isSupported()) remark("a rigid group rests on an elastic support");
    own.known = 0, own.kept = allComponents<D>;
  }
  return own;
}

/// On a side with four vertices the prescribed displacements must be those of its triangles too.
template <int D>
void SideConditions<D>::checkHeld(const Side& side, const SideCondition<D>& own) const {
  if (own.known == allComponents<D>) return;
  const std::vector<int> nodes = mesh_.nodesOf(side);
  std::vector<Point> points;
  for (const int node : nodes) points.push_back(mesh_.point(node));
  for (int k = 0; k < D; ++k) {
    if (own.known >> k & 1u) continue;
    std::vector<double> values;
    for (const int node : nodes) {
      double along = 0.0;
      for (int c = 0; c < D; ++c) along += own.axes(k, c) * displacement_[D * Eigen::Index(node) + c];
      values.push_back(along);
    }
    if (deviationFromTriangles(points, values) > kOnRoller * largest_)
      remark("prescribed displacements are not polynomials of the order of the elements");
  }
}

template <int D>
Eigen::Matrix<double, D, Eigen::Dynamic> SideConditions<D>::loadsOn(int element, int side) const {
  std::vector<Point> points;
  for (const int node : mesh_.nodesOf(Side{element, side})) points.push_back(mesh_.point(node));
  Eigen::Matrix<double, D, Eigen::Dynamic> forces = Eigen::Matrix<double, D, Eigen::Dynamic>::Zero(D, int(points.size()));
  for (const Load* load : at(element, side).loads) {
    const bool pushes = load->kind == Load::Kind::Pressure;
    if (!pushes && load->kind != Load::Kind::Traction) continue;
    SideMap map(points, D, load->rule(), mesh_.axisymmetric);
    for (int q = 0; q < map.reference().points; ++q) {
      map.at(q);
      const Point value = scaled(load->factor, load->at(map.place()));
      const Point force = pushes ? scaled(-value[0], map.normal()) : scaled(map.measure(), value);
      for (int i = 0; i < int(points.size()); ++i)
        for (int k = 0; k < D; ++k) forces(k, i) += force[k] * map.reference().valuesAt(q)[i];
    }
  }
  return forces;
}

template <int D>
double SideConditions<D>::supportEnergyOn(int element, int side, const SideCondition<D>& condition) const {
  const std::vector<int> nodes = mesh_.nodesOf(Side{element, side});
  std::vector<Point> points;
  Eigen::Matrix<double, D, Eigen::Dynamic> moved(D, int(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    points.push_back(mesh_.point(nodes[i]));
    for (int k = 0; k < D; ++k) moved(k, int(i)) = mesh_.total(displacement_, D * Eigen::Index(nodes[i]) + k);
  }
  double energy = 0.0;
  SideMap map(points, D, Rule::Load, mesh_.axisymmetric);
  for (int q = 0; q < map.reference().points; ++q) {
    map.at(q);
    const Eigen::Map<const Vector> values(map.reference().valuesAt(q), moved.cols());
    const Eigen::Matrix<double, D, 1> along = condition.axes * (moved * values);
    for (int k = 0; k < D; ++k)
      if (condition.compliance[k] > 0.0) energy += map.measure() * along[k] * along[k] / condition.compliance[k];
  }
  return energy;
}

template <int D>
void SideConditions<D>::hold(SideCondition<D>& own, const OnSide& on, const Point& normal, const std::vector<int>& nodes) const {
  unsigned held = 0;
  bool isAlongNormal = false;
  for (const int i : on.held) {
    const HeldSides& part = parts_.held[i];
    if (!part.isPolynomial) remark("prescribed displacements are not polynomials of the order of the elements");
    if (part.alongOther) {
      remark("a displacement is prescribed along a direction");
      own.known = 0;
    }
    isAlongNormal = isAlongNormal || part.alongNormal;
    for (int k = 0; k < D; ++k)
      if (part.components[k]) held |= 1u << k;
  }
  if (isAlongNormal)
    holdAlongNormal(own, held, normal, nodes);
  else
    own.known &= ~held;
}

/// Component along the normal of the displacements that are prescribed at a node, the motion that was taken out included.
template <int D>
double SideConditions<D>::prescribedAlong(int node, const Point& normal) const {
  const auto rule =
      std::lower_bound(mesh_.rules.begin(), mesh_.rules.end(), node, [](const NodeRule& one, int sought) { return one.node < sought; });
  if (rule == mesh_.rules.end() || rule->node != node) return 0.0;
  double along = 0.0;
  for (std::size_t k = 0; k < D; ++k) {
    if (!rule->fixed[k]) continue;
    double value = rule->value[k];
    for (int c = 0; c < D && mesh_.lift.motion.size() > 0; ++c)
      value += rule->axes[k][std::size_t(c)] * mesh_.lift.motion[D * Eigen::Index(node) + c];
    along += value * dot(rule->axes[k], normal);
  }
  return along;
}

/// Nodes of a roller move along its mean normal there: where its sides are not parallel, they leave the polygon.
template <int D>
void SideConditions<D>::holdAlongNormal(SideCondition<D>& own, unsigned held, const Point& normal, const std::vector<int>& nodes) const {
  for (const int node : nodes) {
    if (node < 0) continue;
    double along = 0.0;
    for (int k = 0; k < D; ++k) along += normal[k] * mesh_.total(displacement_, D * Eigen::Index(node) + k);
    if (std::abs(along - prescribedAlong(node, normal)) > kOnRoller * largest_) remark("rollers support curved sides");
  }
  if (own.known == 0) return;
  const int axis = axisAlong(normal);
  if (axis >= 0) {
    own.known &= ~(held | 1u << axis);
  } else if (held == 0) {
    const std::vector<Point> axes = pairFrame(normal, D);
    for (int i = 0; i < D; ++i)
      for (int k = 0; k < D; ++k) own.axes(i, k) = axes[i][k];
    own.known &= ~1u;
  } else {
    remark("a side is held along its normal and along another direction");
    own.known = 0;
  }
}

/// Along held components the traction is unknown and without energy.
template <int D>
void SideConditions<D>::support(SideCondition<D>& own, const OnSide& on, const Point& normal, const std::vector<int>& nodes) const {
  int along = axisAlong(normal);  // axis of the normal
  if (!own.axes.isIdentity(0.0)) {
    along = 0;
  } else if (along < 0 && own.known == allComponents<D>) {
    const std::vector<Point> axes = pairFrame(normal, D);
    for (int i = 0; i < D; ++i)
      for (int k = 0; k < D; ++k) own.axes(i, k) = axes[i][k];
    along = 0;
  } else if (along < 0 && on.normalStiffness != on.tangentialStiffness) {
    remark("a side on an elastic support is held along a direction oblique to its normal");
    own.known = 0;
    return;
  }
  for (int k = 0; k < D; ++k) {
    const double stiffness = k == along ? on.normalStiffness : on.tangentialStiffness;
    if (!(own.known >> k & 1u) || !(stiffness > 0.0)) continue;
    own.known &= ~(1u << k);
    own.compliance[k] = 1 / stiffness;
  }
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    if (nodes[j] < 0) {
      const auto [a, b] = edgeVertices(int(j) - D);
      own.moved.col(int(j)) = 0.5 * (own.moved.col(a) + own.moved.col(b));
      continue;
    }
    for (int k = 0; k < D; ++k) own.moved(k, int(j)) = mesh_.total(displacement_, D * Eigen::Index(nodes[j]) + k);
  }
}

template <int D>
void SideConditions<D>::addTraction(const Load& load, const Point& normal, const std::vector<Point>& places, SideCondition<D>& own) {
  for (std::size_t j = 0; j < places.size(); ++j) {
    const Point given = load.at(places[j]);
    const Point value = load.kind == Load::Kind::Pressure ? scaled(-load.factor * given[0], normal) : scaled(load.factor, given);
    for (int k = 0; k < D; ++k) own.traction(k, int(j)) += value[k];
  }
}

template class SideConditions<2>;
template class SideConditions<3>;

}  // namespace suture
