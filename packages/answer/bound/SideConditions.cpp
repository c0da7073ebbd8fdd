#include <suture/answer/bound/SideConditions.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/SideGeometry.hpp>
#include <suture/mesh/SideInterpolation.hpp>
#include <suture/pairs/PairFrame.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// Displacement along the normal of a roller, relative to the largest displacement, that is round-off.
constexpr double kOnRoller = 1e-9;

template <int D>
constexpr unsigned allComponents = (1u << D) - 1;

/// Coordinate axis along a normal; -1: none.
int axisAlong(const Point& normal) {
  for (int k = 0; k < 3; ++k)
    if (normal[(k + 1) % 3] == 0.0 && normal[(k + 2) % 3] == 0.0) return k;
  return -1;
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

template <int D>
SideCondition<D> SideConditions<D>::of(int element, int side, const std::vector<int>& nodes) const {
  const OnSide& on = at(element, side);
  std::vector<Point> points;
  for (const int node : mesh_.nodesOf(Side{element, side})) points.push_back(mesh_.point(node));
  const Point normal = unit(nodeNormals(points, D)[0].density);
  SideCondition<D> own;
  hold(own, on, normal, nodes);
  for (const Load* load : on.loads)
    if (load->kind == Load::Kind::Pressure || load->kind == Load::Kind::Traction) {
      addTraction(*load, normal, nodes, own);
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
  for (std::size_t j = 0; j < nodes.size(); ++j)
    for (int k = 0; k < D; ++k) own.moved(k, int(j)) = mesh_.total(displacement_, D * Eigen::Index(nodes[j]) + k);
}

template <int D>
void SideConditions<D>::addTraction(const Load& load, const Point& normal, const std::vector<int>& nodes, SideCondition<D>& own) const {
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    const Point given = load.at(mesh_.point(nodes[j]));
    const Point value = load.kind == Load::Kind::Pressure ? scaled(-load.factor * given[0], normal) : scaled(load.factor, given);
    for (int k = 0; k < D; ++k) own.traction(k, int(j)) += value[k];
  }
}

template class SideConditions<2>;
template class SideConditions<3>;

}  // namespace suture
