#include <suture/algebra/WorkSpace.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Errors.hpp>
#include <suture/condensed/ContactCompliance.hpp>
#include <suture/search/DelassusProblem.hpp>
#include <suture/search/StateSearch.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// Pad stiffness of a pair from its compliance: half of the compliance comes from the body beyond the pair's own elements.
constexpr double kPointCompliance = 2.0;
constexpr int kMostSolves = 1000;

/// Lower Cholesky factor. A shift of the order of round-off keeps it definite with linearly dependent rows.
Matrix shiftedCholeskyFactor(const Matrix& matrix) {
  if (matrix.rows() == 0) return matrix;
  for (double shift = 0.0; shift < 1e-6; shift = std::max(1e-14, 100 * shift)) {
    Matrix shifted = matrix;
    shifted.diagonal() *= 1.0 + shift;
    Matrix lower;
    if (choleskyFactor(shifted, lower)) return lower;
  }
  throw NumericalError("the compliance of the contact pairs is not positive definite");
}

// x <- (L L^T)^-1 x. The case of one right-hand side avoids Eigen's temporary, which would be costly in the inner loop.
void solveInPlace(const Matrix& lower, LocalView x) {
  const auto both = [&lower](auto&& values) {
    lower.triangularView<Eigen::Lower>().solveInPlace(values);
    lower.transpose().triangularView<Eigen::Upper>().solveInPlace(values);
  };
  if (lower.rows() == 0) return;
  if (x.cols() == 1)
    both(x.col(0));
  else
    both(x);
}

Matrix solveWith(const Matrix& lower, Matrix b) {
  solveInPlace(lower, b);
  return b;
}

}  // namespace

ContactCompliance::ContactCompliance(const GeneralisedInverse& inverse, const ContactRows& rows)
    : inverse_(inverse), rows_(rows), compliance_(rows.rows.rows(), rows.rows.rows()), rigidRows_(rows.rows * inverse.kernel()) {
  constexpr int kBatch = 64;  // right-hand sides at once; the responses themselves are not kept
  const SparseMatrix transposed = rows.rows.transpose();
  for (int first = 0; first < this->rows(); first += kBatch) {
    const int count = std::min(kBatch, this->rows() - first);
    Matrix response = transposed.middleCols(first, count);
    inverse.apply(response);
    compliance_.middleCols(first, count) = rows.rows * response;
  }
  compliance_ = (0.5 * (compliance_ + compliance_.transpose())).eval();
}

ContactCompliance::Closed::Closed(const ContactCompliance& contact, const std::vector<ContactState>& status)
    : contact_(contact), status_(status) {
  const ContactRows& rows = contact.rows_;
  const auto isNone = [&](int row) { return row < 0 || contact.compliance_(row, row) == 0.0; };
  for (int component = 0; component <= (rows.tangents.empty() ? 0 : 2); ++component)
    for (int pair = 0; pair < contact.pairs(); ++pair)
      if (const int row = rows.rowOf(pair, component); status[pair].holds(component) && !isNone(row)) rows_.push_back(row);
  for (int pair = 0; pair < contact.pairs() && !rows.tangents.empty(); ++pair) {
    const ContactState& own = status[pair];
    if (own.status != PairStatus::Slip) continue;
    Spring spring{{-1, -1}, {0.0, 0.0}, own.transverseStiffness > 0.0 ? 1.0 / own.transverseStiffness : 0.0};
    const Point across = acrossSlip(own);
    for (int component = 1; component <= 2; ++component) {
      const int row = rows.rowOf(pair, component);
      if (isNone(row)) continue;
      spring.rows[component - 1] = row;
      spring.coefficients[component - 1] = across[component];
      if (own.bound == 0.0) continue;
      if (slipping_.size() == 0) slipping_ = Vector::Zero(contact.rows());
      slipping_(row) = own.bound * own.direction[component];
    }
    if (own.transverseStiffness > 0.0 && (spring.rows[0] >= 0 || spring.rows[1] >= 0)) springs_.push_back(spring);
  }
  Matrix g(size(), contact.rigidRows_.cols());
  pick(contact.rigidRows_, g);
  loose_ = nullSpace(g);
  held_ = nullSpace(loose_.transpose());
  if (loose_.cols() == 0) held_ = Matrix::Identity(g.cols(), g.cols());
  factor_ = shiftedCholeskyFactor(compliance());
  gHeld_ = g * held_;
  rigidFactor_ = shiftedCholeskyFactor(gHeld_.transpose() * solveWith(factor_, gHeld_));
  kernel_ = contact.inverse_.kernel() * loose_;
}

void ContactCompliance::Closed::pick(ConstLocalView all, LocalView held) const {
  for (std::size_t i = 0; i < rows_.size(); ++i) held.row(static_cast<Eigen::Index>(i)) = all.row(rows_[i]);
  for (std::size_t s = 0; s < springs_.size(); ++s) {
    auto own = held.row(static_cast<Eigen::Index>(rows_.size() + s));
    own.setZero();
    for (int k = 0; k < 2; ++k)
      if (springs_[s].rows[k] >= 0) own += springs_[s].coefficients[k] * all.row(springs_[s].rows[k]);
  }
}

void ContactCompliance::Closed::spread(ConstLocalView held, LocalView all) const {
  all.setZero();
  for (std::size_t i = 0; i < rows_.size(); ++i) all.row(rows_[i]) = held.row(static_cast<Eigen::Index>(i));
  for (std::size_t s = 0; s < springs_.size(); ++s)
    for (int k = 0; k < 2; ++k)
      if (springs_[s].rows[k] >= 0)
        all.row(springs_[s].rows[k]) += springs_[s].coefficients[k] * held.row(static_cast<Eigen::Index>(rows_.size() + s));
}

Matrix ContactCompliance::Closed::compliance() const {
  Matrix half(size(), contact_.rows()), result(size(), size());
  pick(contact_.compliance_, half);
  pick(Matrix(half.transpose()), result);
  for (std::size_t s = 0; s < springs_.size(); ++s) {
    const auto at = static_cast<Eigen::Index>(rows_.size() + s);
    result(at, at) += springs_[s].compliance;
  }
  return result;
}

void ContactCompliance::Closed::forces(LocalView force, const Matrix& e, Matrix& rigid) const {
  solveInPlace(factor_, force);
  const Matrix coefficients = solveWith(rigidFactor_, held_.transpose() * e - gHeld_.transpose() * force);
  rigid = held_ * coefficients;
  if (coefficients.rows() == 0) return;
  thread_local std::vector<double> kept;
  WorkSpace space(force.rows(), force.cols(), kept);
  LocalView balance = space.values;
  balance.noalias() = gHeld_ * coefficients;
  solveInPlace(factor_, balance);
  force += balance;
}

void ContactCompliance::Closed::refinedForces(LocalView force, const Matrix& e, Matrix& rigid) const {
  constexpr int kPasses = 2;
  const Matrix gaps = force, compliance = this->compliance();
  forces(force, e, rigid);
  for (int pass = 0; pass < kPasses; ++pass) {
    const Matrix held = held_.transpose() * rigid;
    Matrix rest = gaps - compliance * force + gHeld_ * held, change;
    const Matrix restE = held_ * (held_.transpose() * e - gHeld_.transpose() * force);
    forces(rest, restE, change);
    force += rest;
    rigid += change;
  }
}

void ContactCompliance::Closed::solve(LocalView v, double gaps, Matrix* pairForce, const Vector& moved) const {
  const Matrix& kernel = contact_.inverse_.kernel();
  if (gaps != 0.0 && slipping_.size() > 0) v.colwise() -= gaps * (contact_.rows_.rows.transpose() * slipping_);
  const Matrix e = kernel.transpose() * v;
  contact_.inverse_.apply(v);
  thread_local std::vector<double> keptGap, keptForce, keptCorrection;
  WorkSpace gapSpace(contact_.rows(), v.cols(), keptGap), forceSpace(size(), v.cols(), keptForce);
  LocalView gap = gapSpace.values, closedForce = forceSpace.values;
  gap.setZero();
  gap.noalias() += contact_.rows_.rows * v;
  if (gaps != 0.0) {
    gap.colwise() -= gaps * contact_.rows_.gap;
    if (moved.size() > 0) gap.colwise() += gaps * moved;
  }
  pick(gap, closedForce);
  Matrix rigid;
  if (pairForce)
    refinedForces(closedForce, e, rigid);
  else
    forces(closedForce, e, rigid);
  LocalView force = gap;  // forces of all rows, stored in the same memory
  spread(closedForce, force);
  WorkSpace correctionSpace(v.rows(), v.cols(), keptCorrection);
  LocalView correction = correctionSpace.values;
  correction.setZero();
  correction.noalias() += contact_.rows_.rows.transpose() * force;
  contact_.inverse_.apply(correction);
  v -= correction;
  if (kernel.cols() > 0) v.noalias() += kernel * rigid;
  if (!pairForce) return;
  *pairForce = force;
  if (gaps != 0.0 && slipping_.size() > 0) pairForce->colwise() += gaps * slipping_;
}

ContactCompliance::State ContactCompliance::solve(LocalView v, const std::vector<ContactState>& start, const Vector& moved) const {
  if (rows() != pairs()) throw InternalError("the unilateral problem of a contact group cannot have friction");
  const Matrix& kernel = inverse_.kernel();
  const Vector work = kernel.transpose() * v.col(0);
  inverse_.apply(v);
  const Vector gap = moved.size() > 0 ? Vector(rows_.gap - moved) : rows_.gap;
  const Vector open = rows_.rows * v.col(0) - gap;
  RigidBodyModel::Pairs data;
  data.rows = rigidRows_.sparseView();
  data.work = work;
  data.penetration = -gap;
  data.stiffness = kPointCompliance * compliance_.diagonal().cwiseInverse();
  data.surfaces = rows_.surfaces;
  for (int i = 0; i < pairs(); ++i) {
    const bool goesOn = i > 0 && rows_.pairIds[i] == rows_.pairIds[i - 1] + 1;
    data.line.push_back(rows_.surfaces ? rows_.lines[i] : goesOn ? data.line.back() : i);
  }
  data.canChange.assign(pairs(), 1);
  RigidBodyModel rigid(std::move(data));
  DelassusProblem problem(rigid, compliance_, open, {});
  PairStates first(start.begin(), start.end());
  StateSearch search(rigid, problem, kMostSolves);
  if (rigid.loosens(first)) first = statesOf(rigid.start());
  const StateSearch::Result found = search.run(first);
  if (!found.converged)
    throw NumericalError(found.slides.size() > 0
                             ? "contact group: the loads push a body away from all contacts that could hold it"
                             : "contact group: found no set of closed pairs that balances the loads without tensile forces");

  State state;
  state.steps = found.solves;
  state.force = found.normal;
  state.rigid = problem.state().amplitude;
  for (int i = 0; i < pairs(); ++i) state.status.push_back(found.states[i].closed() ? rows_.pressed[i] : ContactState());
  Matrix correction = rows_.rows.transpose() * state.force;
  inverse_.apply(correction);
  v -= correction;
  v += kernel * state.rigid;
  return state;
}

}  // namespace suture
