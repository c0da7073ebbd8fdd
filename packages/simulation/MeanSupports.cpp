#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/answer/solvability/Solvability.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Point.hpp>
#include <suture/elasticity/loads/NodalLoads.hpp>
#include <suture/simulation/MeanSupports.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

namespace suture {

namespace {

constexpr double kOutside = 1e-2;    // penalty of a node outside the group of its mean, in lengths of the body
constexpr double kDistance = 1e-4;   // penalty per distance from the centre of the group, likewise
constexpr double kParallel = 1e-12;  // sine of the angle between parallel axes
constexpr double kRank = 1e-6;       // singular value of the supports' motions, relative to the largest, that counts as zero

/// Component of a rule along a Cartesian axis, and its sense; none if the rule's axes are oblique to it.
std::optional<std::pair<int, double>> alongAxis(const NodeRule& rule, int component) {
  for (int k = 0; k < 3; ++k) {
    const double along = rule.axes[std::size_t(k)][std::size_t(component)];
    if (std::abs(along) > 1.0 - kParallel) return std::make_pair(k, along > 0.0 ? 1.0 : -1.0);
  }
  return std::nullopt;
}

bool isFree(const NodeRule& rule) {
  return std::none_of(rule.fixed.begin(), rule.fixed.end(), [](bool fixed) { return fixed; });
}

/// Nodes that can be held along an axis: outside of contacts, with neither a prescribed component along the axis nor an oblique one.
class Candidates {
 public:
  Candidates(const Mesh& mesh, const Constraints& constraints)
      : constraints_(constraints), rigid_(constraints.rigidGroups, mesh.dimension), ruleOf_(std::size_t(mesh.nodes()), -1) {
    for (std::size_t r = 0; r < constraints.rules.size(); ++r) ruleOf_[std::size_t(constraints.rules[r].node)] = int(r);
    for (const ContactPair& pair : constraints.pairs)
      for (const PairEnd& end : pair.ends) taken_.insert({end.node, -1});
  }
  bool allows(int node, int component) const {
    if (taken_.count({node, -1}) + taken_.count({node, component}) > 0) return false;
    if (ruleOf_[std::size_t(node)] < 0) return true;
    if (rigid_.contains(node)) return false;  // other nodes follow it
    const NodeRule& rule = constraints_.rules[std::size_t(ruleOf_[std::size_t(node)])];
    const auto axis = alongAxis(rule, component);
    return isFree(rule) || (axis && !rule.fixed[std::size_t(axis->first)]);
  }
  void take(int node, int component) { taken_.insert({node, component}); }

 private:
  const Constraints& constraints_;
  RigidGroupNodes rigid_;
  std::vector<int> ruleOf_;
  std::set<std::pair<int, int>> taken_;  // node and component; -1: all components
};

/// Change of a mean in each free motion of the parts of its group. Only parts with free motions have a row.
std::map<int, Vector> motionsOf(const Mesh& mesh, const RigidParts& rigid, const PrescribedMean& mean) {
  std::map<int, Vector> rows;
  for (const auto& [node, weight] : mean.nodes) {
    const int part = rigid.partOfNode[std::size_t(node)];
    const RigidPart& r = rigid.parts[std::size_t(part)];
    if (r.free.cols() == 0) continue;
    Vector& row = rows.try_emplace(part, Vector::Zero(r.free.cols())).first->second;
    row += weight * (r.at(mesh.point(node), mesh.dimension).row(mean.component) * r.free).transpose();
  }
  return rows;
}

/// The node of a part whose displacement is closest to a mean in rigid motions; -1: none can be held.
int nearestNode(const Mesh& mesh, const RigidParts& rigid, int part, const PrescribedMean& mean, const Candidates& candidates) {
  const RigidPart& r = rigid.parts[std::size_t(part)];
  Point centre{0, 0, 0};
  double weights = 0.0;
  Vector wanted = Vector::Zero(r.free.cols());
  std::set<int> inGroup;
  for (const auto& [node, weight] : mean.nodes) {
    if (rigid.partOfNode[std::size_t(node)] != part) continue;
    inGroup.insert(node);
    weights += weight;
    centre = plus(centre, scaled(weight, mesh.point(node)));
    wanted += weight * (r.at(mesh.point(node), mesh.dimension).row(mean.component) * r.free).transpose();
  }
  wanted /= weights;
  centre = scaled(1.0 / weights, centre);
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int node = 0; node < mesh.nodes(); ++node) {
    if (rigid.partOfNode[std::size_t(node)] != part || !candidates.allows(node, mean.component)) continue;
    const Vector own = (r.at(mesh.point(node), mesh.dimension).row(mean.component) * r.free).transpose();
    const double score =
        (own - wanted).norm() + (inGroup.count(node) > 0 ? 0.0 : kOutside) + kDistance * norm(minus(mesh.point(node), centre)) / r.radius;
    if (score < least) least = score, best = node;
  }
  return best;
}

/// Pseudoinverse of a matrix.
Matrix pseudoinverse(const Matrix& matrix) {
  const SingularValues svd = singularValues(matrix);
  Matrix result = Matrix::Zero(matrix.cols(), matrix.rows());
  for (Eigen::Index i = 0; i < svd.values.size() && svd.values[i] > kRank * svd.values[0]; ++i)
    result += svd.v.col(i) * svd.u.col(i).transpose() / svd.values[i];
  return result;
}

/// True if the scene has a solution without its means.
bool holdsWithoutMeans(const Mesh& mesh, const Constraints& constraints, const Vector& forces, const RigidParts& rigid) {
  try {
    checkSolvability(mesh, constraints, forces, rigid);
  } catch (const InputError&) {
    return false;
  }
  return true;
}

}  // namespace

void MeanSupports::findOnRoot(const Mesh& mesh, const Constraints& constraints, const ElasticModel& model, bool bodiesAreConnected,
                              Where where) {
  const std::vector<PrescribedMean> means = prescribedMeans(mesh, model);
  if (means.empty()) {
    checkSolvability(mesh, constraints, model, bodiesAreConnected);
    return;
  }
  Problems problems;
  checkMeans(mesh, constraints, model, means, problems);
  problems.throwIfAny();
  const RigidParts rigid = freeRigidMotions(mesh, constraints, bodiesAreConnected);
  const Vector forces = nodalLoads(mesh, model);
  if (where == Where::Needed && holdsWithoutMeans(mesh, constraints, forces, rigid)) return;
  checkSolvability(mesh, constraints, forces, rigid, means);

  firstCondition_ = int(constraints.conditions.size());
  std::vector<int> first;  // column of each part's first motion
  int motions = 0;
  for (const RigidPart& part : rigid.parts) first.push_back(motions), motions += int(part.free.cols());
  Candidates candidates(mesh, constraints);
  std::vector<Vector> ofMeans, ofNodes;
  for (const PrescribedMean& mean : means) {
    const std::map<int, Vector> rows = motionsOf(mesh, rigid, mean);
    if (rows.empty()) continue;
    const auto larger = [](const auto& a, const auto& b) { return a.second.norm() < b.second.norm(); };
    const int part = std::max_element(rows.begin(), rows.end(), larger)->first;
    const int node = nearestNode(mesh, rigid, part, mean, candidates);
    const Load& load = model.loads[std::size_t(mean.load)];
    if (node < 0)
      throw InputError(load.path, "all nodes of body '" + mesh.bodies[std::size_t(rigid.parts[std::size_t(part)].body)] +
                                      "' are in contact or prescribed along this axis, so that a Mean Displacement cannot hold it. "
                                      "Refine its mesh");
    candidates.take(node, mean.component);
    all_.push_back({mean.load, mean.component, rigid.parts[std::size_t(part)].body, node});
    ofMeans.push_back(Vector::Zero(motions));
    for (const auto& [p, row] : rows) ofMeans.back().segment(first[std::size_t(p)], row.size()) = row;
    const RigidPart& r = rigid.parts[std::size_t(part)];
    ofNodes.push_back(Vector::Zero(motions));
    ofNodes.back().segment(first[std::size_t(part)], r.free.cols()) =
        (r.at(mesh.point(node), mesh.dimension).row(mean.component) * r.free).transpose();
  }
  const auto count = Eigen::Index(all_.size());
  Matrix means_(count, motions), nodes(count, motions);
  for (Eigen::Index i = 0; i < count; ++i)
    means_.row(i) = ofMeans[std::size_t(i)].transpose(), nodes.row(i) = ofNodes[std::size_t(i)].transpose();
  transfer_ = Matrix::Identity(count, count) + (means_ - nodes) * pseudoinverse(nodes);
}

MeanSupports MeanSupports::find(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const ElasticModel& model,
                                bool bodiesAreConnected, Where where) {
  MeanSupports found;
  collectivelyOnRoot(comm, "checking that the scene has a solution",
                     [&] { found.findOnRoot(mesh, constraints, model, bodiesAreConnected, where); });
  broadcast(comm, found.all_);
  broadcastBytes(comm, &found.firstCondition_, sizeof found.firstCondition_);
  std::vector<double> values(found.transfer_.data(), found.transfer_.data() + found.transfer_.size());
  broadcast(comm, values);
  const auto count = Eigen::Index(found.all_.size());
  found.transfer_ = Eigen::Map<const Matrix>(values.data(), count, count);
  return found;
}

/// Adds one support at a node, numbered as in the rules.
void MeanSupports::add(std::size_t i, int node, double value, std::vector<NodeRule>& rules, std::vector<Support>& supports) const {
  const auto before = [](const auto& a, const auto& b) { return a.node < b.node; };
  const auto component = std::size_t(all_[i].component);
  NodeRule fresh;
  fresh.node = node;
  auto rule = std::lower_bound(rules.begin(), rules.end(), fresh, before);
  if (rule == rules.end() || rule->node != node) rule = rules.insert(rule, fresh);
  if (isFree(*rule)) *rule = fresh;
  const auto axis = alongAxis(*rule, all_[i].component);
  if (!axis) throw InternalError("an auxiliary support at a node with oblique axes");
  rule->fixed[std::size_t(axis->first)] = true;
  rule->value[std::size_t(axis->first)] = axis->second * value;
  Support support;
  support.node = node;
  support.condition = firstCondition_ + static_cast<int>(i);
  support.direction[component] = support.along[component] = 1.0;
  supports.insert(std::upper_bound(supports.begin(), supports.end(), support, before), support);
}

void MeanSupports::addTo(Constraints& constraints, const Vector& values) const {
  for (std::size_t i = 0; i < all_.size(); ++i)
    add(i, static_cast<int>(all_[i].node), values[Eigen::Index(i)], constraints.rules, constraints.supports);
}

void MeanSupports::addTo(std::vector<SubdomainMesh>& meshes, const Vector& values) const {
  for (SubdomainMesh& mesh : meshes)
    for (std::size_t i = 0; i < all_.size(); ++i) {
      const auto node = std::lower_bound(mesh.globalNodes.begin(), mesh.globalNodes.end(), all_[i].node);
      if (node != mesh.globalNodes.end() && *node == all_[i].node)
        add(i, static_cast<int>(node - mesh.globalNodes.begin()), values[Eigen::Index(i)], mesh.rules, mesh.supports);
    }
}

void MeanSupports::removeFrom(std::vector<SubdomainMesh>& meshes) const {
  if (empty()) return;
  for (SubdomainMesh& mesh : meshes) {
    for (NodeRule& rule : mesh.rules)
      for (const Held& held : all_)
        if (held.node == mesh.globalNodes[std::size_t(rule.node)])
          if (const auto axis = alongAxis(rule, held.component)) rule.fixed[std::size_t(axis->first)] = false;
    const auto isOwn = [&](const Support& support) { return support.condition >= firstCondition_; };
    mesh.supports.erase(std::remove_if(mesh.supports.begin(), mesh.supports.end(), isOwn), mesh.supports.end());
  }
}

}  // namespace suture
