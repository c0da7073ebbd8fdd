#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Errors.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/partition/TurnFromDrawn.hpp>
#include <suture/subdomain/ElasticSubdomain.hpp>
#include <suture/subdomain/NodalAssembly.hpp>
#include <suture/subdomain/Subdomain.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <sstream>

namespace suture {

void registerBuiltIns(Registry<Subdomain>& registry) {
  registry.add("Elastic", Schema("linear elasticity with the materials of the body and its regions"),
               [](const SubdomainMesh& mesh, const ElasticModel& model, const Parameters&) {
                 return std::make_unique<ElasticSubdomain>(mesh, model);
               });
}

namespace {

constexpr double kSameAxes = 1e-9;  // difference of axes, and of coefficients of rigid groups, that is round-off of frames

std::vector<double> coefficientsOf(const SubdomainMesh& mesh) {
  std::vector<double> all;
  for (const RigidGroup& group : mesh.rigidGroups) {
    all.insert(all.end(), group.masterNodes.begin(), group.masterNodes.end());
    all.insert(all.end(), group.masterComponents.begin(), group.masterComponents.end());
    all.insert(all.end(), group.coefficients.begin(), group.coefficients.end());
  }
  return all;
}

void setAxes(const Matrix& q, NodeRule& rule) {
  for (Eigen::Index row = 0; row < q.rows(); ++row)
    for (Eigen::Index column = 0; column < q.cols(); ++column)
      rule.axes[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = q(row, column);
}

}  // namespace

Subdomain::Subdomain(const SubdomainMesh& mesh) : mesh_(mesh), numberOf_(mesh.nodes() * mesh.dimension, 0) {
  const int d = components();
  takeAxes();
  for (const NodeRule& rule : mesh.rules)
    for (int k = 0; k < d; ++k)
      if (rule.fixed[k]) numberOf_[rule.node * d + k] = -1;
  takePrescribed();
  if (!mesh.drawn.empty()) {
    rules_ = mesh.rules;
    followers_ = coefficientsOf(mesh);
    for (NodeRule& rule : rules_) setAxes(onDrawn(rule), rule);
  }
  for (std::size_t i = 0; i < numberOf_.size(); ++i) {
    if (numberOf_[i] < 0) {
      fixed_.push_back(static_cast<int>(i));
    } else {
      numberOf_[i] = static_cast<int>(free_.size());
      free_.push_back(static_cast<int>(i));
    }
  }
  if (!mesh.rigidGroups.empty()) expandRigidGroups();
}

void Subdomain::takeAxes() {
  const int d = components();
  turn_ = turnFromDrawn(mesh_);
  axesOfNode_.clear(), axes_.clear();
  if (!turn_.isIdentity(0.0)) {
    axesOfNode_.assign(mesh_.nodes(), 0);
    axes_.push_back(turn_.transpose());
  }
  for (const NodeRule& rule : mesh_.rules) {
    const Matrix q = axesOf(rule, d);
    if (axes_.empty() && q.isIdentity(0.0)) continue;
    axesOfNode_.resize(mesh_.nodes(), -1);
    axesOfNode_[rule.node] = static_cast<int>(axes_.size());
    axes_.push_back(q);
  }
}

/// Axes of a rule, turned back into the drawn body.
Matrix Subdomain::onDrawn(const NodeRule& rule) const { return axesOf(rule, components()) * turn_; }

bool Subdomain::rearrange() {
  takeAxes();
  if (mesh_.rules.size() != rules_.size()) return false;
  for (std::size_t r = 0; r < rules_.size(); ++r) {
    const NodeRule& rule = mesh_.rules[r];
    if (rule.node != rules_[r].node || rule.fixed != rules_[r].fixed) return false;
    if ((onDrawn(rule) - axesOf(rules_[r], components())).cwiseAbs().maxCoeff() > kSameAxes) return false;
  }
  const std::vector<double> followers = coefficientsOf(mesh_);
  if (followers.size() != followers_.size()) return false;
  for (std::size_t i = 0; i < followers.size(); ++i)
    if (std::abs(followers[i] - followers_[i]) > kSameAxes) return false;
  reload();
  findFreeMotions();
  return true;
}

void Subdomain::expandRigidGroups() {
  const int d = components();
  const RigidGroupNodes rigid(mesh_.rigidGroups, d);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < static_cast<int>(numberOf_.size()); ++i)
    if (numberOf_[i] >= 0) entries.emplace_back(i, numberOf_[i], 1.0);
  for (const int i : fixed_)
    rigid.forEachMaster(i / d, i % d, [&](int node, int component, double coefficient) {
      entries.emplace_back(i, numberOf_[node * d + component], coefficient);
    });
  expansion_ = SparseMatrix(static_cast<int>(numberOf_.size()), dofs());
  expansion_.setFromTriplets(entries.begin(), entries.end());
}

Vector Subdomain::expanded(const Vector& freeValues) const {
  Vector all = prescribed_;
  if (expansion_.rows() > 0) return all + expansion_ * freeValues;
  for (int i = 0; i < dofs(); ++i) all(free_[i]) = freeValues(i);
  return all;
}

void Subdomain::takePrescribed() {
  const int d = components();
  prescribed_ = Vector::Zero(mesh_.nodes() * d);
  for (const NodeRule& rule : mesh_.rules)
    for (int k = 0; k < d; ++k)
      if (rule.fixed[k]) prescribed_(rule.node * d + k) = rule.value[k];
}

/// Loads of the free unknowns: those of the conditions minus the contribution of prescribed displacements.
void Subdomain::liftLoad() {
  const Vector given = rowsAt(prescribed_, fixed_);
  const Vector held = held_ * given, lifted = fullLoad_ - held;
  if (expansion_.rows() > 0)
    load_ = expansion_.transpose() * lifted;
  else
    load_ = rowsAt(lifted, free_);
  constantEnergy_ = 0.5 * prescribed_.dot(held) - prescribed_.dot(fullLoad_);
}

void Subdomain::reload() {
  takePrescribed();
  fullLoad_ = doLoad();
  if (fullLoad_.size() != Eigen::Index(numberOf_.size()))
    throw NumericalError("subdomain '" + mesh_.name + "': the load has the wrong size");
  const Vector before = load_;
  liftLoad();
  loadChanges_ += load_ != before;
}

Vector Subdomain::doLoad() {
  SparseMatrix stiffness;
  Vector load = Vector::Zero(Eigen::Index(numberOf_.size()));
  doAssemble(stiffness, load);
  return load;
}

void Subdomain::assemble() {
  const int n = static_cast<int>(numberOf_.size());
  fullLoad_ = Vector::Zero(n);
  SparseMatrix assembled;
  doAssemble(assembled, fullLoad_);
  if (assembled.rows() != n || assembled.cols() != n || fullLoad_.size() != n)
    throw NumericalError("subdomain '" + mesh_.name + "': the assembled matrix or load has the wrong size");
  stiffness_ = SymmetricMatrix(std::move(assembled));
  held_ = SparseMatrix(n, static_cast<int>(fixed_.size()));
  if (!fixed_.empty() || expansion_.rows() > 0) {
    const SparseMatrix full = stiffness_.full();
    std::vector<int> all(n);
    std::iota(all.begin(), all.end(), 0);
    held_ = block(full, all, fixed_);
    if (expansion_.rows() > 0) {
      whole_ = std::move(stiffness_);
      stiffness_ = SymmetricMatrix(SparseMatrix(expansion_.transpose() * full * expansion_));
    } else {
      stiffness_ = SymmetricMatrix(block(full, free_, free_));
    }
  }
  const RigidGroupNodes rigid(mesh_.rigidGroups, components());
  const Vector diagonal = stiffness_.diagonal();
  for (int i = 0; i < dofs(); ++i)
    if (!(diagonal(i) > 0.0) && !rigid.contains(nodeOf(i))) {
      const Point p = mesh_.point(nodeOf(i));
      std::ostringstream text;
      text << "subdomain '" << mesh_.name << "': no stiffness at node " << placeText(p, mesh_.dimension);
      throw NumericalError(text.str());
    }

  liftLoad();
  findFreeMotions();
}

void Subdomain::findFreeMotions() {
  const Matrix modes = doRigidModes(), onSprings = springModes(modes);
  heldModes_ = Matrix(onSprings.rows() + Eigen::Index(fixed_.size()), modes.cols());
  const Matrix atFree = rowsAt(modes, free_);
  const Matrix following = expansion_.rows() > 0 ? Matrix(modes - expansion_ * atFree) : modes;  // prescribed values account for the rest
  heldModes_ << rowsAt(following, fixed_), onSprings;
  freeMotions_ = nullSpace(heldModes_);
}

Matrix Subdomain::kernel() const {
  const Matrix rigid = rigidModes() * freeMotions_, idle = idleMasters();
  if (idle.cols() == 0) return rigid;
  Matrix all(rigid.rows(), rigid.cols() + idle.cols());
  all << rigid, idle;
  return all;
}

/// A subdomain with few nodes of a rigid group does not resist every motion of the group.
Matrix Subdomain::idleMasters() const {
  const int d = components();
  std::vector<Vector> columns;
  std::vector<char> hasElement(mesh_.rigidGroups.empty() ? 0 : mesh_.nodes(), 0);
  if (!hasElement.empty())
    for (const int node : mesh_.connectivity) hasElement[node] = 1;
  for (const RigidGroup& group : mesh_.rigidGroups) {
    std::vector<const double*> rows;
    for (std::size_t place = 0; place < group.nodes.size(); ++place)
      for (int k = 0; hasElement[group.nodes[place]] && k < d; ++k) rows.push_back(group.row(place, k, d));
    Matrix moved(static_cast<Eigen::Index>(rows.size()), group.masters());
    for (std::size_t r = 0; r < rows.size(); ++r)
      for (int m = 0; m < group.masters(); ++m) moved(static_cast<Eigen::Index>(r), m) = rows[r][m];
    const Matrix idle = nullSpace(moved);
    for (Eigen::Index c = 0; c < idle.cols(); ++c) {
      columns.push_back(Vector::Zero(dofs()));
      for (int m = 0; m < group.masters(); ++m)
        columns.back()(dof(group.masterNodes[static_cast<std::size_t>(m)], group.masterComponents[static_cast<std::size_t>(m)])) =
            idle(m, c);
    }
  }
  Matrix all(dofs(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c) all.col(static_cast<Eigen::Index>(c)) = columns[c];
  return all;
}

SparseMatrix Subdomain::assembled(
    const std::function<void(const std::function<void(int element, ConstLocalView stiffness)>& take)>& elements) const {
  const int d = components();
  const CoatedBlock coated(mesh_);
  ElementMatrices matrices;
  matrices.reserve(mesh_.connectivity.size() * mesh_.connectivity.size() / std::max(mesh_.elements(), 1) * d * d);
  elements([&](int element, ConstLocalView given) {
    const auto nodes = coated.block().nodesOf(element);
    const auto begin = matrices.size();
    matrices.insert(matrices.end(), given.data(), given.data() + given.size());
    if (!std::any_of(nodes.begin(), nodes.end(), [this](int node) { return axes(node) != nullptr; })) return;
    Eigen::Map<Matrix> k(matrices.data() + begin, given.rows(), given.cols());
    for (std::size_t a = 0; a < nodes.size(); ++a)
      if (const Matrix* q = axes(nodes[a])) {
        k.middleRows(a * d, d) = (*q * k.middleRows(a * d, d)).eval();
        k.middleCols(a * d, d) = (k.middleCols(a * d, d) * q->transpose()).eval();
      }
  });
  return assembleNodal(coated.block(), d, matrices);
}

Matrix Subdomain::springModes(const Matrix& modes) const {
  if (!mesh_.springs.empty() && !followsModel())
    throw InputError("Boundary Conditions", "an Elastic Support acts only on bodies whose Subdomain is Elastic; subdomain '" + mesh_.name +
                                                "' has its own physics");
  const int d = components();
  Matrix rows(static_cast<Eigen::Index>(mesh_.springs.size()), modes.cols());
  for (std::size_t i = 0; i < mesh_.springs.size(); ++i) {
    const SpringDirection& spring = mesh_.springs[i];
    Vector direction = Eigen::Map<const Vector>(spring.direction.data(), d);
    if (const Matrix* q = axes(spring.node)) direction = (*q * direction).eval();
    rows.row(static_cast<Eigen::Index>(i)) = direction.transpose() * modes.middleRows(spring.node * d, d);
  }
  return rows;
}

Matrix Subdomain::stresses(const Vector& displacement) const {
  Matrix found = doStresses(displacement);
  if (found.rows() != mesh_.elements() || found.cols() != (mesh_.dimension == 2 ? 4 : 6))
    throw NumericalError("subdomain '" + mesh_.name + "': expected stresses xx, yy, zz, xy (in 3D also yz, xz) of every element");
  return found;
}

ElementForces Subdomain::internalForces(const Vector& displacement) const {
  const int d = components(), n = static_cast<int>(numberOf_.size());
  const Vector u = inAxes(displacement);
  if (expansion_.rows() > 0) {
    const SparseMatrix full = whole_.full(), sizes = full.cwiseAbs();
    ElementForces all{outOfAxes(full * u), Vector::Zero(mesh_.nodes()), Vector::Zero(mesh_.nodes())};
    const Vector absolute = sizes * u.cwiseAbs(), diagonal = whole_.diagonal();
    for (int i = 0; i < n; ++i) {
      all.rounding(i / d) += std::numeric_limits<double>::epsilon() * absolute(i);
      all.stiffness(i / d) += diagonal(i) / d;
    }
    return all;
  }
  const Vector free = rowsAt(u, free_), given = rowsAt(u, fixed_);
  const auto product = [&](const Vector& onFree, const Vector& onFixed, auto&& times, auto&& held) {
    Vector all = held * onFixed;  // rows of the free unknowns: contribution of the prescribed ones
    const Vector inside = times(onFree);
    for (int i = 0; i < dofs(); ++i) all(free_[i]) += inside(i);
    Vector whole = Vector::Zero(n);
    for (int i = 0; i < dofs(); ++i) whole(free_[i]) = onFree(i);
    for (std::size_t i = 0; i < fixed_.size(); ++i) whole(fixed_[i]) = onFixed(static_cast<int>(i));
    const Vector reactions = held.transpose() * whole;
    for (std::size_t i = 0; i < fixed_.size(); ++i) all(fixed_[i]) = reactions(static_cast<int>(i));
    return all;
  };
  const SparseMatrix stiffness = stiffness_.full(), sizes = stiffness.cwiseAbs(), heldSizes = held_.cwiseAbs();
  const Vector force = product(
      free, given, [&](const Vector& x) { return Vector(stiffness * x); }, held_);
  const Vector absolute = product(
      free.cwiseAbs(), given.cwiseAbs(), [&](const Vector& x) { return Vector(sizes * x); }, heldSizes);
  Vector diagonal(n);
  const Vector own = stiffness_.diagonal();
  for (int i = 0; i < dofs(); ++i) diagonal(free_[i]) = own(i);
  for (std::size_t i = 0; i < fixed_.size(); ++i) diagonal(fixed_[i]) = held_.coeff(fixed_[i], static_cast<int>(i));

  ElementForces all{outOfAxes(force), Vector::Zero(mesh_.nodes()), Vector::Zero(mesh_.nodes())};
  for (int i = 0; i < n; ++i) {
    all.rounding(i / d) += std::numeric_limits<double>::epsilon() * absolute(i);
    all.stiffness(i / d) += diagonal(i) / d;
  }
  return all;
}

Vector Subdomain::nodalLoads() const { return outOfAxes(fullLoad_); }

Hint Subdomain::hint(const std::string& name) const {
  Hint all = doHint(name);
  if (all.empty() && name == Hint::kCoarseModes) all = {doRigidModes(), Hint::Join::Columns};
  if (all.empty()) return {Matrix(dofs(), 0), all.join};
  if (all.values.rows() != Eigen::Index(numberOf_.size()))
    throw NumericalError("subdomain '" + mesh_.name + "': the hint '" + name + "' has " + std::to_string(all.values.rows()) +
                         " rows; expected " + std::to_string(numberOf_.size()));
  return {rowsAt(all.values, free_), all.join};
}

Matrix Subdomain::rigidModes() const { return rowsAt(doRigidModes(), free_); }

Point Subdomain::direction(int dof) const {
  Point along{0, 0, 0};
  const Matrix* q = axes(nodeOf(dof));
  for (int c = 0; c < components(); ++c) along[c] = q ? (*q)(componentOf(dof), c) : (c == componentOf(dof) ? 1.0 : 0.0);
  return along;
}

void Subdomain::toAxes(LocalView values) const {
  const int d = components();
  for (int node = 0; node < mesh_.nodes(); ++node)
    if (const Matrix* q = axes(node)) values.middleRows(node * d, d) = (*q * values.middleRows(node * d, d)).eval();
}

Vector Subdomain::inAxes(const Vector& cartesian) const {
  Vector values = cartesian;
  toAxes(values);
  return values;
}

Vector Subdomain::outOfAxes(Vector values) const {
  const int d = components();
  for (int node = 0; node < mesh_.nodes(); ++node)
    if (const Matrix* q = axes(node)) values.segment(node * d, d) = (q->transpose() * values.segment(node * d, d)).eval();
  return values;
}

Vector Subdomain::cartesian(const Vector& values) const { return outOfAxes(expanded(values)); }

Vector Subdomain::freeValues(const Vector& cartesian) const {
  const Vector all = inAxes(cartesian);
  Vector values(dofs());
  for (int i = 0; i < dofs(); ++i) values(i) = all(free_[i]);
  return values;
}

void Subdomain::resultants(const Vector& values, Point& applied, Point& reactions, double& absoluteForces) const {
  const int d = components();
  const Vector all = expanded(values), reaction = held_.transpose() * all;
  Vector force = Vector::Zero(all.size());
  for (std::size_t i = 0; i < fixed_.size(); ++i) force(fixed_[i]) = reaction(static_cast<int>(i)) - fullLoad_(fixed_[i]);
  Vector load = fullLoad_;
  for (int node = 0; node < mesh_.nodes(); ++node) {
    Vector f = force.segment(node * d, d), l = load.segment(node * d, d);
    if (const Matrix* q = axes(node)) {
      f = (q->transpose() * f).eval();
      l = (q->transpose() * l).eval();
    }
    for (int k = 0; k < d; ++k) {
      applied[k] += l(k);
      reactions[k] += f(k);
      absoluteForces += std::abs(f(k)) + std::abs(l(k));
    }
  }
}

}  // namespace suture
