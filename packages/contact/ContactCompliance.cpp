#include <suture/base/Dense.hpp>
#include <suture/base/Errors.hpp>
#include <suture/contact/ContactCompliance.hpp>
#include <suture/subdomain/WorkSpace.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// Forces and gaps below this fraction of the largest ones are rounding of the dense solves, not violated conditions.
constexpr double kNegligible = 1e-11;
// The same for the balance of rigid motions, a sum of many forces.
constexpr double kUnbalanced = 1e-9;

bool isClosed(PairStatus status) { return status != PairStatus::Open; }

std::vector<int> closedOnes(const std::vector<PairStatus>& status) {
  std::vector<int> closed;
  for (std::size_t i = 0; i < status.size(); ++i)
    if (isClosed(status[i])) closed.push_back(static_cast<int>(i));
  return closed;
}

Matrix blockAt(const Matrix& matrix, const std::vector<int>& at) {
  Matrix result(at.size(), at.size());
  for (std::size_t j = 0; j < at.size(); ++j)
    for (std::size_t i = 0; i < at.size(); ++i) result(i, j) = matrix(at[i], at[j]);
  return result;
}

/// Lower Cholesky factor; rows that repeat others (two pairs that say the same) are kept definite by a shift of the size of rounding.
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

// x <- (L L^T)^-1 x. One right-hand side without work space of Eigen's, which the inner loop would pay for.
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

/// Pairs whose status contradicts their force or gap.
std::vector<int> violatedPairs(const Vector& force, const Vector& gap, const std::vector<PairStatus>& status, double gapScale) {
  const double f = kNegligible * force.lpNorm<Eigen::Infinity>();
  const double g = kNegligible * std::max(gap.lpNorm<Eigen::Infinity>(), gapScale);
  std::vector<int> pairs;
  for (std::size_t i = 0; i < status.size(); ++i)
    if (isClosed(status[i]) ? force(i) < -f : gap(i) < -g) pairs.push_back(static_cast<int>(i));
  return pairs;
}

void flip(PairStatus& status) { status = isClosed(status) ? PairStatus::Open : PairStatus::Slip; }

/// Which violated pairs to change next: all of them while their number falls, else the last one alone (Murty), which cannot cycle.
class Pivoting {
 public:
  void change(const std::vector<int>& violated, std::vector<PairStatus>& status) {
    if (violated.size() < fewest_) {
      fewest_ = violated.size();
      patience_ = 8;
    } else if (patience_ > 0) {
      --patience_;
    }
    if (patience_ > 0)
      for (int i : violated) flip(status[i]);
    else
      flip(status[violated.back()]);
  }

 private:
  std::size_t fewest_ = static_cast<std::size_t>(-1);
  int patience_ = 8;
};

}  // namespace

ContactCompliance::ContactCompliance(const GeneralisedInverse& inverse, const ContactRows& rows)
    : inverse_(inverse), rows_(rows), compliance_(rows.size(), rows.size()), rigidRows_(rows.rows * inverse.kernel()) {
  constexpr int kBatch = 64;  // right-hand sides at once: the responses themselves are not kept
  const SparseMatrix transposed = rows.rows.transpose();
  for (int first = 0; first < rows.size(); first += kBatch) {
    const int count = std::min(kBatch, rows.size() - first);
    Matrix response = transposed.middleCols(first, count);
    inverse.apply(response);
    compliance_.middleCols(first, count) = rows.rows * response;
  }
  compliance_ = (0.5 * (compliance_ + compliance_.transpose())).eval();
}

ContactCompliance::Closed::Closed(const ContactCompliance& contact, const std::vector<PairStatus>& status)
    : contact_(contact), status_(status), closed_(closedOnes(status)) {
  const Matrix g = rowsAt(contact.rigidRows_, closed_);
  loose_ = nullSpace(g);
  held_ = nullSpace(loose_.transpose());
  if (loose_.cols() == 0) held_ = Matrix::Identity(g.cols(), g.cols());
  factor_ = shiftedCholeskyFactor(blockAt(contact.compliance_, closed_));
  gHeld_ = g * held_;
  rigidFactor_ = shiftedCholeskyFactor(gHeld_.transpose() * solveWith(factor_, gHeld_));
  kernel_ = contact.inverse_.kernel() * loose_;
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

double ContactCompliance::Closed::unbalanced(const Vector& e) const {
  return loose_.cols() == 0 ? 0.0 : (loose_.transpose() * e).lpNorm<Eigen::Infinity>();
}

void ContactCompliance::Closed::solve(LocalView v, double gaps, Matrix* pairForce) const {
  const Matrix& kernel = contact_.inverse_.kernel();
  const Matrix e = kernel.transpose() * v;
  contact_.inverse_.apply(v);
  thread_local std::vector<double> keptGap, keptForce, keptCorrection;
  WorkSpace gapSpace(contact_.pairs(), v.cols(), keptGap), forceSpace(static_cast<int>(closed_.size()), v.cols(), keptForce);
  LocalView gap = gapSpace.values, closedForce = forceSpace.values;
  gap.setZero();
  gap.noalias() += contact_.rows_.rows * v;
  for (std::size_t i = 0; i < closed_.size(); ++i) closedForce.row(i) = gap.row(closed_[i]);
  if (gaps != 0.0)
    for (std::size_t i = 0; i < closed_.size(); ++i) closedForce.row(i).array() -= gaps * contact_.rows_.gap(closed_[i]);
  Matrix rigid;
  forces(closedForce, e, rigid);
  LocalView force = gap;  // of all pairs, in the same place
  force.setZero();
  for (std::size_t i = 0; i < closed_.size(); ++i) force.row(closed_[i]) = closedForce.row(i);
  WorkSpace correctionSpace(v.rows(), v.cols(), keptCorrection);
  LocalView correction = correctionSpace.values;
  correction.setZero();
  correction.noalias() += contact_.rows_.rows.transpose() * force;
  contact_.inverse_.apply(correction);
  v -= correction;
  if (kernel.cols() > 0) v.noalias() += kernel * rigid;
  if (pairForce) *pairForce = force;
}

ContactCompliance::State ContactCompliance::solve(LocalView v, const std::vector<PairStatus>& start) const {
  State state;
  state.status = start;
  const Matrix& kernel = inverse_.kernel();
  const Vector load = v.col(0);
  const Vector e = kernel.transpose() * load;
  inverse_.apply(v);
  const Vector d = rows_.rows * v.col(0) - rows_.gap;
  if (!activeSet(d, e, state)) multipliers(d, e, state);
  Matrix correction = rows_.rows.transpose() * state.force;
  inverse_.apply(correction);
  v -= correction;
  v += kernel * state.rigid;
  return state;
}

bool ContactCompliance::activeSet(const Vector& d, const Vector& e, State& state) const {
  Pivoting pivoting;
  const double scale = e.lpNorm<Eigen::Infinity>();
  const int most = 50 + 4 * pairs();
  for (; state.steps < most; ++state.steps) {
    const Closed closed(*this, state.status);
    if (closed.unbalanced(e) > kUnbalanced * scale) return false;
    Matrix closedForce = rowsAt(d, closed.closed_), rigid;
    closed.forces(closedForce, e, rigid);
    state.rigid = rigid;
    state.force = Vector::Zero(pairs());
    for (std::size_t i = 0; i < closed.closed_.size(); ++i) state.force(closed.closed_[i]) = closedForce(i, 0);
    const Vector gap = compliance_ * state.force - d - rigidRows_ * state.rigid;
    const std::vector<int> violated = violatedPairs(state.force, gap, state.status, d.lpNorm<Eigen::Infinity>());
    if (violated.empty()) return true;
    pivoting.change(violated, state.status);
  }
  return false;
}

void ContactCompliance::multipliers(const Vector& d, const Vector& e, State& state) const {
  const double weight = rigidRows_.squaredNorm() > 0.0 ? 100.0 * compliance_.trace() / rigidRows_.squaredNorm() : 0.0;
  const Matrix m = compliance_ + weight * rigidRows_ * rigidRows_.transpose();
  const double scale = std::max(e.lpNorm<Eigen::Infinity>(), 1e-300);
  state.rigid = Vector::Zero(rigidRows_.cols());
  for (int round = 0; round < 500; ++round) {
    boundedSolve(m, d + rigidRows_ * (state.rigid + weight * e), state.force, state.status, state.steps);
    const Vector excess = rigidRows_.transpose() * state.force - e;
    state.rigid -= weight * excess;
    if (excess.lpNorm<Eigen::Infinity>() <= 1e-3 * kUnbalanced * scale) {
      // The status is right; the forces are made so to rounding.
      State polished = state;
      if (activeSet(d, e, polished)) state = polished;
      return;
    }
  }
  throw NumericalError("contact: no equilibrium was found; a body is pushed away from the pairs that could hold it");
}

void ContactCompliance::boundedSolve(const Matrix& m, const Vector& q, Vector& force, std::vector<PairStatus>& status, int& steps) const {
  Pivoting pivoting;
  const int most = steps + 200 + 20 * pairs();
  for (; steps < most; ++steps) {
    const std::vector<int> closed = closedOnes(status);
    const Matrix closedForce = solveWith(shiftedCholeskyFactor(blockAt(m, closed)), rowsAt(q, closed));
    force = Vector::Zero(pairs());
    for (std::size_t i = 0; i < closed.size(); ++i) force(closed[i]) = closedForce(i, 0);
    const Vector gap = m * force - q;
    const std::vector<int> violated = violatedPairs(force, gap, status, q.lpNorm<Eigen::Infinity>());
    if (violated.empty()) return;
    pivoting.change(violated, status);
  }
  throw NumericalError("contact: the active set of a bounded problem did not settle");
}

}  // namespace suture
