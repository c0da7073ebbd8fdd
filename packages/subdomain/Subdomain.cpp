#include <suture/base/Dense.hpp>
#include <suture/base/Errors.hpp>
#include <suture/subdomain/Subdomain.hpp>

#include <numeric>
#include <sstream>

namespace suture {

Subdomain::Subdomain(const SubdomainMesh& mesh) : mesh_(mesh), numberOf_(mesh.nodes() * mesh.dimension, 0), axesOfNode_(mesh.nodes(), -1) {
  const int d = components();
  prescribed_ = Vector::Zero(mesh.nodes() * d);
  for (const NodeRule& rule : mesh.rules) {
    const Matrix q = axesOf(rule, d);
    if (!q.isIdentity(0.0)) {
      axesOfNode_[rule.node] = static_cast<int>(axes_.size());
      axes_.push_back(q);
    }
    for (int k = 0; k < d; ++k)
      if (rule.fixed[k]) {
        numberOf_[rule.node * d + k] = -1;
        prescribed_(rule.node * d + k) = rule.value[k];
      }
  }
  for (std::size_t i = 0; i < numberOf_.size(); ++i) {
    if (numberOf_[i] < 0) {
      fixed_.push_back(static_cast<int>(i));
    } else {
      numberOf_[i] = static_cast<int>(free_.size());
      free_.push_back(static_cast<int>(i));
    }
  }
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
  if (!fixed_.empty()) {
    const SparseMatrix full = stiffness_.full();
    std::vector<int> all(n);
    std::iota(all.begin(), all.end(), 0);
    held_ = block(full, all, fixed_);
    stiffness_ = SymmetricMatrix(block(full, free_, free_));
  }
  const Vector diagonal = stiffness_.diagonal();
  for (int i = 0; i < dofs(); ++i)
    if (!(diagonal(i) > 0.0)) {
      const Point p = mesh_.point(nodeOf(i));
      std::ostringstream text;
      text << "subdomain '" << mesh_.name << "': no stiffness at the node (" << p[0] << ", " << p[1] << ")";
      throw NumericalError(text.str());
    }

  const Vector given = rowsAt(prescribed_, fixed_);
  const Vector held = held_ * given, lifted = fullLoad_ - held;
  load_ = Vector(dofs());
  for (int i = 0; i < dofs(); ++i) load_(i) = lifted(free_[i]);
  constantEnergy_ = 0.5 * prescribed_.dot(held) - prescribed_.dot(fullLoad_);

  const Vector young = doYoungModulus();
  if (young.size() != mesh_.nodes() || !(young.minCoeff() > 0.0))
    throw NumericalError("subdomain '" + mesh_.name + "': expected a positive Young modulus at every node");
  if (const Vector shear = doShearDiagonal(); shear.size() > 0) shearDiagonal_ = rowsAt(shear, free_);
  heldModes_ = rowsAt(doRigidModes(), fixed_);
  freeMotions_ = nullSpace(heldModes_);
}

Vector Subdomain::youngModulus() const {
  const Vector young = doYoungModulus();
  Vector values(dofs());
  for (int i = 0; i < dofs(); ++i) values(i) = young(nodeOf(i));
  return values;
}

Matrix Subdomain::rigidModes() const { return rowsAt(doRigidModes(), free_); }

Matrix Subdomain::coarseModes() const { return rowsAt(doCoarseModes(), free_); }

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

Vector Subdomain::cartesian(const Vector& values) const {
  const int d = components();
  Vector all = prescribed_;
  for (int i = 0; i < dofs(); ++i) all(free_[i]) = values(i);
  for (int node = 0; node < mesh_.nodes(); ++node)
    if (const Matrix* q = axes(node)) all.segment(node * d, d) = (q->transpose() * all.segment(node * d, d)).eval();
  return all;
}

Vector Subdomain::freeValues(const Vector& cartesian) const {
  Vector all = cartesian;
  toAxes(all);
  Vector values(dofs());
  for (int i = 0; i < dofs(); ++i) values(i) = all(free_[i]);
  return values;
}

void Subdomain::resultants(const Vector& values, Point& applied, Point& reactions, double& absoluteForces) const {
  const int d = components();
  Vector all = prescribed_;
  for (int i = 0; i < dofs(); ++i) all(free_[i]) = values(i);
  const Vector reaction = held_.transpose() * all;
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
