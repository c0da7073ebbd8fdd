#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Point.hpp>
#include <suture/base/RigidFrame.hpp>
#include <suture/base/RigidValues.hpp>
#include <suture/constraints/BuildRigidGroups.hpp>
#include <suture/mesh/CellGeometry.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace suture {

namespace {

constexpr double kAgrees = 1e-9;       // relative difference of prescribed values that count as equal, as in NodalRules
constexpr double kIndependent = 1e-8;  // least ratio of pivots of motions that the nodes determine: nodes on a line do not turn about it

Point axis(int k) {
  Point direction{0, 0, 0};
  direction[static_cast<std::size_t>(k)] = 1.0;
  return direction;
}

constexpr double kAsFar = 1e-6;  // relative difference of distances between nodes, above the round-off of turned bodies, that counts

/// Indices of points that are far apart: the farthest from their mean, the farthest from this one, in 3D the farthest from the line through
/// both. The same for any position of a rigid body. Fewer if these determine the position.
std::vector<std::size_t> spanning(const std::vector<Point>& points, int dimension) {
  std::vector<std::size_t> chosen;
  Point mean{0, 0, 0};
  for (const Point& point : points) mean = plus(mean, scaled(1.0 / static_cast<double>(points.size()), point));
  const auto distance = [&](const Point& point) {
    if (chosen.empty()) return norm(minus(point, mean));
    const Point from = minus(point, points[chosen.front()]);
    if (chosen.size() == 1) return norm(from);
    const Point line = minus(points[chosen.back()], points[chosen.front()]);
    return norm(cross(line, from)) / norm(line);
  };
  double extent = 0.0;
  for (int k = 0; k < dimension; ++k) {
    double most = 0.0;
    for (const Point& point : points) most = std::max(most, distance(point));
    if (!chosen.empty() && most <= kAsFar * extent) break;
    extent = std::max(extent, most);
    chosen.push_back(static_cast<std::size_t>(
        std::find_if(points.begin(), points.end(), [&](const Point& point) { return distance(point) >= (1.0 - kAsFar) * most; }) -
        points.begin()));
  }
  return chosen;
}

/// One group while it is built. Its motion is given by amplitudes about the centre of its nodes, all of them lengths (RigidFrame).
class Builder {
 public:
  Builder(const Mesh& mesh, const std::vector<Condition>& conditions, int number, std::vector<int> nodes)
      : mesh_(mesh), condition_(conditions[static_cast<std::size_t>(number)]), dimension_(mesh.dimension) {
    group_.condition = number;
    group_.point = *condition_.point;
    group_.motions = condition_.motions;
    group_.factor = condition_.factor;
    group_.nodes = std::move(nodes);
    std::vector<Point> points;
    for (const int node : group_.nodes) points.push_back(mesh.point(node));
    frame_ = RigidFrame::around(points);
    if (!condition_.movesFar) return;
    for (const std::size_t i : spanning(points, dimension_)) {
      positions_.push_back(static_cast<int>(i));
      group_.positionNodes.push_back(group_.nodes[i]);
    }
  }

  /// The group, with the rules and prescribed values of its nodes. \param factors  number of factors; 0: none
  RigidGroup build(int factors, Constraints& constraints, Problems& problems) {
    const Eigen::Index columns = std::max(factors, 1);
    collect(constraints, columns);
    Matrix given(columns, Eigen::Index(rows_.size())), held(Eigen::Index(rows_.size()), rigidMotions(dimension_));
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      held.row(Eigen::Index(r)) = rows_[r].motion.transpose();
      given.col(Eigen::Index(r)) = rows_[r].values;
    }
    Matrix motion(held.cols(), columns);  // that meets all rows, by factor
    for (Eigen::Index f = 0; f < columns; ++f)
      motion.col(f) = held.rows() > 0 ? leastSquares(held, given.row(f).transpose()) : Vector::Zero(held.cols());
    compare(held, given, motion, problems);
    chooseMasters(nullSpace(held));
    setRules(motion, factors, constraints);
    return std::move(group_);
  }

 private:
  struct Row {
    Vector motion, values;  // by amplitude; by factor
    int node;               // -1: of the condition itself, or of the axis of symmetry
  };

  Vector rowOf(const Point& place, const Point& direction) const {
    return frame_.at(place, dimension_).transpose() * Eigen::Map<const Vector>(direction.data(), dimension_);
  }

  /// Everything that restricts the motion.
  void collect(const Constraints& constraints, Eigen::Index columns) {
    const auto add = [&](const Vector& motion, double value, int factor, int node) {
      rows_.push_back({motion, Vector::Zero(columns), node});
      rows_.back().values[columns > 1 ? factor : 0] = value;
    };
    const int amplitudes = rigidMotions(dimension_);
    if (mesh_.axisymmetric)
      for (const int k : {0, 2}) add(Vector::Unit(amplitudes, k), 0.0, 0, -1);
    for (int k = 0; k < 6; ++k) {
      const std::optional<double>& value = condition_.motions[static_cast<std::size_t>(k)];
      if (!value) continue;
      if (k < 3)
        add(rowOf(*condition_.point, axis(k)), *value, condition_.factor, -1);
      else
        add(Vector::Unit(amplitudes, dimension_ == 2 ? 2 : k), *value * frame_.radius, condition_.factor, -1);
    }
    for (const NodeRule& rule : constraints.rules) {
      if (!std::binary_search(group_.nodes.begin(), group_.nodes.end(), rule.node)) continue;
      for (int k = 0; k < dimension_; ++k) {
        if (!rule.fixed[k]) continue;
        add(rowOf(mesh_.point(rule.node), rule.axes[k]), rule.value[k], 0, rule.node);
        if (columns == 1) continue;
        rows_.back().values.setZero();
        for (Eigen::Index f = 0; f < columns; ++f)
          for (const RuleValue& part : constraints.prescribed[static_cast<std::size_t>(f)])
            if (part.node == rule.node) rows_.back().values[f] = part.value[k];
      }
    }
  }

  void compare(const Matrix& held, const Matrix& given, const Matrix& motion, Problems& problems) const {
    if (held.rows() == 0) return;
    const double scale = given.cwiseAbs().maxCoeff();
    const Matrix apart = (held * motion - given.transpose()).cwiseAbs();
    Eigen::Index row = 0, factor = 0;
    if (apart.maxCoeff(&row, &factor) <= kAgrees * scale) return;
    std::ostringstream text;
    const int node = rows_[static_cast<std::size_t>(row)].node;
    text << "other conditions on its nodes would deform it";
    if (node >= 0) text << ", for instance at " << placeText(mesh_.point(node), dimension_);
    text << "; a rigid group can only move as a whole. Prescribe its motions here, or choose a group without these nodes";
    problems.add(condition_.path, text.str());
  }

  /// Components that determine free motions best. \param moved  components of the nodes x motions
  std::vector<int> masterRows(const Matrix& moved) const {
    if (positions_.empty()) return pivotRows(moved);
    Matrix own(Eigen::Index(positions_.size()) * dimension_, moved.cols());
    for (std::size_t i = 0; i < positions_.size(); ++i)
      own.middleRows(Eigen::Index(i) * dimension_, dimension_) = moved.middleRows(Eigen::Index(positions_[i]) * dimension_, dimension_);
    std::vector<int> rows = pivotRows(own);
    for (int& row : rows) row = positions_[static_cast<std::size_t>(row / dimension_)] * dimension_ + row % dimension_;
    return rows;
  }

  /// \param free  amplitudes x free motions
  void chooseMasters(const Matrix& free) {
    const auto count = static_cast<Eigen::Index>(group_.nodes.size()) * dimension_;
    nodal_ = Matrix(count, rigidMotions(dimension_));
    for (std::size_t i = 0; i < group_.nodes.size(); ++i)
      nodal_.middleRows(Eigen::Index(i) * dimension_, dimension_) = frame_.at(mesh_.point(group_.nodes[i]), dimension_);
    Matrix moved = nodal_ * free;
    if (moved.cols() > 0) moved = orthonormalBasis(moved, kIndependent);  // without motions that move no node
    follow_ = Matrix(count, 0);
    if (moved.cols() == 0) return;
    const std::vector<int> pivots = masterRows(moved);
    Matrix own(moved.cols(), moved.cols());
    for (Eigen::Index m = 0; m < own.rows(); ++m) {
      masters_.push_back(pivots[static_cast<std::size_t>(m)]);
      own.row(m) = moved.row(masters_.back());
      group_.masterNodes.push_back(group_.nodes[static_cast<std::size_t>(masters_.back() / dimension_)]);
      group_.masterComponents.push_back(masters_.back() % dimension_);
    }
    double condition = 0.0;
    follow_ = moved * generalInverse(own, condition);
    for (Eigen::Index i = 0; i < count; ++i)
      for (Eigen::Index m = 0; m < follow_.cols(); ++m)
        if (std::abs(follow_(i, m)) < 1e-14) follow_(i, m) = 0.0;  // round-off of components that do not move
    for (std::size_t m = 0; m < masters_.size(); ++m) follow_.row(masters_[m]) = Vector::Unit(follow_.cols(), Eigen::Index(m)).transpose();
    for (Eigen::Index i = 0; i < count; ++i)
      for (Eigen::Index m = 0; m < follow_.cols(); ++m) group_.coefficients.push_back(follow_(i, m));
  }

  void setRules(const Matrix& motion, int factors, Constraints& constraints) const {
    const Matrix whole = nodal_ * motion;
    Matrix value = whole;
    for (std::size_t m = 0; m < masters_.size(); ++m) value -= follow_.col(Eigen::Index(m)) * whole.row(masters_[m]);
    const auto isMember = [&](const auto& one) { return std::binary_search(group_.nodes.begin(), group_.nodes.end(), one.node); };
    const auto remove = [&](auto& list) { list.erase(std::remove_if(list.begin(), list.end(), isMember), list.end()); };
    const auto sort = [](auto& list) {
      std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.node < b.node; });
    };
    remove(constraints.rules), remove(constraints.supports);
    for (std::vector<RuleValue>& values : constraints.prescribed) remove(values);
    for (std::size_t i = 0; i < group_.nodes.size(); ++i) {
      NodeRule rule;
      rule.node = group_.nodes[i];
      for (int k = 0; k < dimension_; ++k) {
        const auto row = static_cast<int>(i) * dimension_ + k;
        const bool isMaster = std::find(masters_.begin(), masters_.end(), row) != masters_.end();
        rule.fixed[k] = !isMaster;
        if (!isMaster) rule.value[k] = value.row(row).sum() + 0.0;
        constraints.supports.push_back({rule.node, group_.condition, axis(k), axis(k), false});
      }
      constraints.rules.push_back(rule);
      for (int f = 0; f < factors; ++f) {
        RuleValue part{rule.node, {0, 0, 0}};
        for (int k = 0; k < dimension_; ++k)
          if (rule.fixed[k]) part.value[k] = value(Eigen::Index(i) * dimension_ + k, f) + 0.0;
        if (part.value != Point{0, 0, 0}) constraints.prescribed[static_cast<std::size_t>(f)].push_back(part);
      }
    }
    sort(constraints.rules), sort(constraints.supports);
    for (std::vector<RuleValue>& values : constraints.prescribed) sort(values);
  }

  const Mesh& mesh_;
  const Condition& condition_;
  int dimension_;
  RigidGroup group_;
  RigidFrame frame_;
  std::vector<Row> rows_;
  std::vector<int> positions_;  // indices of positionNodes; empty: any node may have masters
  std::vector<int> masters_;    // rows of nodal_
  Matrix nodal_, follow_;       // components of the nodes x amplitudes, x masters
};

std::vector<int> nodesOf(const Mesh& mesh, const Condition& condition) {
  std::set<int> nodes;
  for (const Side& side : sidesOf(mesh.sideGroups, condition.groups))
    for (const int node : mesh.nodesOf(side)) nodes.insert(node);
  return {nodes.begin(), nodes.end()};
}

/// Adds the factors of rigid groups to the parts of the prescribed values. \return number of all factors; 0: no factor multiplies them
int addFactors(const std::vector<Condition>& conditions, Constraints& constraints) {
  const auto before = static_cast<int>(constraints.prescribed.size());
  int factors = before;
  for (const Condition& condition : conditions)
    if (condition.type == Condition::Type::RigidGroup && condition.factor > 0) factors = std::max(factors, condition.factor + 1);
  constraints.prescribed.resize(static_cast<std::size_t>(factors));
  if (before > 0 || factors == 0) return factors;
  for (const NodeRule& rule : constraints.rules)  // all values so far are constant
    if (rule.value != Point{0, 0, 0}) constraints.prescribed.front().push_back({rule.node, rule.value});
  return factors;
}

/// True if the nodes are of one body and in no other rigid group. \param taken  nodes of the other groups, receives these
bool areOwn(const Mesh& mesh, const Condition& condition, const std::vector<int>& nodes, std::set<int>& taken, Problems& problems) {
  const auto bodyOf = [&](int node) { return static_cast<std::size_t>(mesh.bodyOfNode[static_cast<std::size_t>(node)]); };
  const std::size_t body = bodyOf(nodes.front());
  for (const int node : nodes) {
    if (bodyOf(node) != body) {
      problems.add(condition.path + "/Group", "has nodes of the bodies '" + mesh.bodies[body] + "' and '" + mesh.bodies[bodyOf(node)] +
                                                  "'; a rigid group belongs to one body. Give each body its own, or tie the bodies by a "
                                                  "contact");
      return false;
    }
    if (!taken.insert(node).second) {
      problems.add(condition.path + "/Group",
                   "shares a node at " + placeText(mesh.point(node), mesh.dimension) + " with another Rigid Group; make one group of both");
      return false;
    }
  }
  return true;
}

}  // namespace

void buildRigidGroups(const Mesh& mesh, const std::vector<Condition>& conditions, Constraints& constraints, Problems& problems) {
  const int factors = addFactors(conditions, constraints);
  std::set<int> taken;
  for (std::size_t number = 0; number < conditions.size(); ++number) {
    const Condition& condition = conditions[number];
    if (condition.type != Condition::Type::RigidGroup) continue;
    const std::vector<int> nodes = nodesOf(mesh, condition);
    if (nodes.empty() || !areOwn(mesh, condition, nodes, taken, problems)) continue;
    constraints.rigidGroups.push_back(Builder(mesh, conditions, static_cast<int>(number), nodes).build(factors, constraints, problems));
  }
}

}  // namespace suture
