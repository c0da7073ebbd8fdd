#include <corpus/CorpusJudge.hpp>
#include <suture/algebra/dense/NonnegativeLeastSquares.hpp>
#include <suture/base/Errors.hpp>

#include <Eigen/Dense>

#include <cfloat>
#include <cstdio>

namespace suture::corpus {

namespace {

constexpr double bound = 1e-6;

double along(const Point& direction, const Vector& field, int node) {
  return direction[0] * field[2 * node] + direction[1] * field[2 * node + 1];
}

std::string complaint(const char* what, const std::string& where, double value) {
  char text[160];
  std::snprintf(text, sizeof text, "%s %s: %.1e times the bound", what, where.c_str(), value);
  return text;
}

void worsen(std::string& worst, double& most, double value, const char* what, const std::string& where) {
  if (value <= most) return;
  most = value;
  worst = complaint(what, where, value);
}

}  // namespace

Judge::Judge(const Whole& whole) : whole_(whole), ruleOf_(whole.mesh.nodes(), -1) {
  const Mesh& mesh = whole.mesh;
  loads_ = Vector::Zero(2 * mesh.nodes());
  for (const Load& load : whole.model.loads) {
    if (!load.onBody()) {
      addSideLoad(mesh, sidesOf(mesh.sideGroups, load.groups), load, loads_);
      continue;
    }
    std::vector<int> elements;
    for (int e = 0; e < mesh.elements(); ++e)
      if (load.actsOn(mesh.bodies[mesh.bodyOfElement[e]])) elements.push_back(e);
    addBodyForce(mesh, elements, load, loads_);
  }
  for (std::size_t r = 0; r < whole.constraints.rules.size(); ++r) ruleOf_[whole.constraints.rules[r].node] = static_cast<int>(r);

  const int bodies = static_cast<int>(mesh.bodies.size());
  Matrix low = Matrix::Constant(2, bodies, DBL_MAX), high = Matrix::Constant(2, bodies, -DBL_MAX);
  for (int node = 0; node < mesh.nodes(); ++node)
    for (int k = 0; k < 2; ++k) {
      double &l = low(k, mesh.bodyOfNode[node]), &h = high(k, mesh.bodyOfNode[node]);
      l = std::min(l, mesh.point(node)[k]);
      h = std::max(h, mesh.point(node)[k]);
    }
  rigid_ = Matrix::Zero(2 * mesh.nodes(), 3 * bodies);
  for (int node = 0; node < mesh.nodes(); ++node) {
    const int b = mesh.bodyOfNode[node];
    const double size = (high.col(b) - low.col(b)).norm() / 2;
    rigid_(2 * node, 3 * b) = rigid_(2 * node + 1, 3 * b + 1) = 1.0;
    rigid_(2 * node, 3 * b + 2) = -(mesh.point(node)[1] - (low(1, b) + high(1, b)) / 2) / size;
    rigid_(2 * node + 1, 3 * b + 2) = (mesh.point(node)[0] - (low(0, b) + high(0, b)) / 2) / size;
  }
}

Judge::Scales Judge::scales(const Outcome& found) const {
  const Mesh& mesh = whole_.mesh;
  const Vector& u = found.displacement;
  const int bodies = static_cast<int>(mesh.bodies.size());
  Scales all{Vector::Zero(bodies), Vector::Zero(bodies), Vector::Zero(bodies), loads_};
  Vector sums = Vector::Zero(u.size()), absolute;
  elementStiffnesses(
      mesh, [&](int e) -> const Material& { return whole_.model.materialOf(mesh, e, mesh.bodyOfElement[e]); }, whole_.model.plane,
      [&](int element, ConstLocalView stiffness) {
        const Span<const int> nodes = mesh.nodesOf(element);
        Vector local(2 * nodes.size());
        for (std::size_t i = 0; i < nodes.size(); ++i) local.segment(2 * i, 2) = u.segment(2 * nodes[i], 2);
        const Vector force = stiffness * local, size = stiffness.cwiseAbs() * local.cwiseAbs();
        for (std::size_t i = 0; i < nodes.size(); ++i) {
          all.residual.segment(2 * nodes[i], 2) -= force.segment(2 * i, 2);
          sums.segment(2 * nodes[i], 2) += size.segment(2 * i, 2);
        }
      });
  Matrix applied = Matrix::Zero(3, bodies), pieces = Matrix::Zero(whole_.constraints.pieces.size() + 1, bodies);
  for (const ContactPair& pair : whole_.constraints.pairs)
    for (const PairEnd& end : pair.ends) {
      const double force = -found.forces[pair.id] * end.weight;
      for (int k = 0; k < 2; ++k) all.residual[2 * end.node + k] += force * pair.normal[k];
      pieces(pair.piece, bodyOf(end)) += std::abs(force);
    }
  for (int node = 0; node < mesh.nodes(); ++node) {
    const int b = mesh.bodyOfNode[node];
    applied(0, b) += std::abs(loads_[2 * node]);
    applied(1, b) += std::abs(loads_[2 * node + 1]);
    for (int k = 0; k < 2; ++k) {
      all.displacement[b] = std::max(all.displacement[b], std::abs(u[2 * node + k]));
      all.floor[b] = std::max(all.floor[b], 30 * DBL_EPSILON * sums[2 * node + k]);
    }
    if (const NodeRule* rule = ruleAt(node))
      for (int k = 0; k < 2; ++k)
        if (rule->fixed[k]) applied(2, b) += std::abs(along(rule->axes[k], all.residual, node));
  }
  for (int b = 0; b < bodies; ++b) all.force[b] = std::max(applied.col(b).maxCoeff(), pieces.col(b).maxCoeff());
  const double least = 1e-13 * all.force.maxCoeff();
  all.force = all.force.cwiseMax(least);
  all.displacement = all.displacement.cwiseMax(1e-13 * all.displacement.maxCoeff());
  for (int b = 0; b < bodies; ++b)
    if (all.force[b] > 0.0) all.loosened = std::max(all.loosened, all.floor[b] / (bound * all.force[b]));
  all.floor = all.floor.cwiseMax((all.loosened - 1.0) * bound * all.force);
  all.displacement *= all.loosened;
  return all;
}

std::string Judge::verdict(const Outcome& found) const {
  const Mesh& mesh = whole_.mesh;
  const Vector& u = found.displacement;
  if (!u.allFinite()) return "displacement not finite";
  if (found.forces.size() != whole_.constraints.pairs.size()) return "pairs missing";
  const Scales scale = scales(found);
  std::string worst;
  double most = 1.0;  // within bounds
  worsen(worst, most, found.seam / bound, "seam", "");
  for (int node = 0; node < mesh.nodes(); ++node) {
    const int b = mesh.bodyOfNode[node];
    const NodeRule* rule = ruleAt(node);
    const double allowed = bound * scale.force[b] + scale.floor[b];
    for (int k = 0; k < 2; ++k) {
      const double r = rule ? along(rule->axes[k], scale.residual, node) : scale.residual[2 * node + k];
      if (rule && rule->fixed[k])
        worsen(worst, most, std::abs(along(rule->axes[k], u, node) - rule->value[k]) / (bound * scale.displacement[b]), "prescribed",
               mesh.bodies[b]);
      else
        worsen(worst, most, allowed > 0 ? std::abs(r) / allowed : 0.0, "residual", mesh.bodies[b]);
    }
  }
  for (const ContactPair& pair : whole_.constraints.pairs) {
    double gap = pair.gap, length = 0, force = 0, floor = 0;
    for (const PairEnd& end : pair.ends) {
      gap -= end.weight * along(pair.normal, u, end.node);
      length = std::max(length, scale.displacement[bodyOf(end)]);
      const double own = scale.force[bodyOf(end)];
      if (force == 0.0 || own < force) force = own;
      floor = std::max(floor, scale.floor[bodyOf(end)]);
    }
    length = std::max({length, std::abs(pair.gap), DBL_MIN});
    const double own = found.forces[pair.id], allowed = bound * force + floor;
    const std::string where = "pair " + std::to_string(pair.id);
    worsen(worst, most, -gap / (bound * length), "penetration", where);
    if (allowed > 0) worsen(worst, most, -own / allowed, "tension", where);
    if (own > allowed) worsen(worst, most, gap / (bound * length), "force over a gap", where);
  }
  return worst;
}

namespace {

/// Orthonormal basis of the kernel of the sum of row^T row, rows of size about 1.
Matrix kernel(const Matrix& gram) {
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(gram);
  int count = 0;
  while (count < gram.cols() && eigen.eigenvalues()[count] < 1e-10) ++count;
  return eigen.eigenvectors().leftCols(count);
}

}  // namespace

Vector Judge::contactRow(const ContactPair& pair) const {
  Vector row = Vector::Zero(rigid_.cols());
  for (const PairEnd& end : pair.ends)
    for (int k = 0; k < 2; ++k) row += end.weight * pair.normal[k] * rigid_.row(2 * end.node + k).transpose();
  return row;
}

Matrix Judge::prescribedGram() const {
  Matrix gram = Matrix::Zero(rigid_.cols(), rigid_.cols());
  for (const NodeRule& rule : whole_.constraints.rules)
    for (int k = 0; k < 2; ++k) {
      if (!rule.fixed[k]) continue;
      const Vector row = (rule.axes[k][0] * rigid_.row(2 * rule.node) + rule.axes[k][1] * rigid_.row(2 * rule.node + 1)).transpose();
      gram += row * row.transpose();
    }
  return gram;
}

Feasibility Judge::feasibility() const {
  const Matrix free = kernel(prescribedGram());
  if (free.cols() == 0) return Feasibility::Held;
  Matrix rows(whole_.constraints.pairs.size(), free.cols());
  for (const ContactPair& pair : whole_.constraints.pairs) rows.row(pair.id) = (free.transpose() * contactRow(pair)).transpose();
  const Vector work = free.transpose() * (rigid_.transpose() * loads_);
  if (work.norm() > 0.0) {
    const Vector unit = work / work.norm(), p = nonnegativeLeastSquares(rows.transpose(), unit), escape = unit - rows.transpose() * p;
    if (escape.norm() > 1e-8) {
      const bool proved = (rows * escape).maxCoeff() < 1e-7 * escape.norm() && unit.dot(escape) > 0.5 * escape.squaredNorm();
      if (!proved) throw NumericalError("corpus: neither contact forces that hold the bodies nor a motion of escape was found");
      return Feasibility::None;
    }
    if (p.size() > 0 && p.minCoeff() < 0.0) throw NumericalError("corpus: contact forces that pull");
  }
  return kernel(rows.transpose() * rows).cols() > 0 ? Feasibility::Slides : Feasibility::Held;
}

Matrix Judge::neutral(const Outcome& found) const {
  const Scales scale = scales(found);
  Matrix gram = prescribedGram();
  for (const ContactPair& pair : whole_.constraints.pairs) {
    double least = DBL_MAX;
    for (const PairEnd& end : pair.ends) least = std::min(least, bound * scale.force[bodyOf(end)] + scale.floor[bodyOf(end)]);
    if (found.forces[pair.id] <= least) continue;
    const Vector row = contactRow(pair);
    gram += row * row.transpose();
  }
  return kernel(gram);
}

std::string Judge::difference(const Outcome& found, const Outcome& reference) const {
  const Mesh& mesh = whole_.mesh;
  const Scales scale = scales(reference);
  std::string worst;
  double most = 1.0;
  Vector largest = 1e-13 * scale.force;  // pair force of each body
  for (const ContactPair& pair : whole_.constraints.pairs)
    for (const PairEnd& end : pair.ends) largest[bodyOf(end)] = std::max(largest[bodyOf(end)], std::abs(reference.forces[pair.id]));
  for (const ContactPair& pair : whole_.constraints.pairs) {
    double allowed = DBL_MAX;
    for (const PairEnd& end : pair.ends) allowed = std::min(allowed, bound * largest[bodyOf(end)] + scale.floor[bodyOf(end)]);
    if (allowed > 0)
      worsen(worst, most, std::abs(found.forces[pair.id] - reference.forces[pair.id]) / allowed, "force of",
             "pair " + std::to_string(pair.id));
  }
  Vector apart = found.displacement - reference.displacement;
  const Matrix free = neutral(reference);
  if (free.cols() > 0) {
    const Matrix motions = rigid_ * free;
    apart -= motions * motions.colPivHouseholderQr().solve(apart);
  }
  for (int node = 0; node < mesh.nodes(); ++node) {
    const int b = mesh.bodyOfNode[node];
    if (scale.displacement[b] == 0.0) continue;
    for (int k = 0; k < 2; ++k)
      worsen(worst, most, std::abs(apart[2 * node + k]) / (bound * scale.displacement[b]), "displacement of", mesh.bodies[b]);
  }
  return worst;
}

}  // namespace suture::corpus
