#include <cblas.h>
#include <suture/base/Dense.hpp>
#include <suture/base/Errors.hpp>
#include <suture/solver/MonolithicContact.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

extern "C" void dpotrf_(const char* triangle, const int* n, double* a, const int* stride, int* info);

namespace suture {

namespace {

constexpr double rounding = 1e-12;    // violations below this part of the displacements (forces) are none
constexpr double loose = 1e-10;       // relative singular value below which the active rows do not hold a body
constexpr double acceptable = 1e-10;  // residual at which a set that cycles is taken: degenerate rows, decided by rounding
constexpr int patience = 10;          // changes of all wrong rows at once without progress before single ones
constexpr int softenings = 9;         // of the springs that tie loose bodies, each a tenth of the last

// a <- L, a = L L^T, lower triangle. False when a is not definite.
bool factorInPlace(Matrix& a) {
  const int n = int(a.rows()), stride = std::max(1, n);
  int info = 0;
  if (n > 0) dpotrf_("L", &n, a.data(), &stride, &info);
  return info == 0;
}

// b <- L^-1 b, or L^-T b.
void triangularSolve(const Matrix& lower, CBLAS_TRANSPOSE transpose, Eigen::Ref<Matrix> b) {
  if (lower.rows() == 0 || b.cols() == 0) return;
  cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, transpose, CblasNonUnit, int(lower.rows()), int(b.cols()), 1.0, lower.data(),
              int(lower.rows()), b.data(), int(b.outerStride()));
}

class ActiveSet {
 public:
  ActiveSet(const CondensedContact& problem, int iterations, const std::function<void(const ActiveSetStep&)>& step);
  ContactSolution run(std::vector<char> active);

 private:
  enum class Outcome { Solved, Loose, Cycling, OutOfSteps };

  void compliance();
  bool solve(bool tied, double spring);
  std::vector<int> wrongRows();
  Outcome pivot(bool tied, double spring);
  Vector displacement() const;

  const CondensedContact& problem_;
  const std::function<void(const ActiveSetStep&)>& tell_;
  const int rows_, modes_;
  int left_;

  std::vector<Matrix> factors_;  // of S + stiffness of its own on the kernel, each block
  Vector kernelStiffness_;       // that stiffness, each kernel column
  Matrix h_;                     // compliance H of the rows, lower triangle and upper
  Matrix g_;                     // rows times kernel
  Vector gapless_, work_;        // h = C S^-1 f - bound;   Z^T f
  double constant_ = 0.0;        // f.S^-1 f
  Vector holding_;               // diagonal of G^T H^-1 G with all rows closed: what "held" means for each mode

  std::vector<char> active_;
  Vector force_, gap_, place_;  // the current solve; place: amplitudes of the kernel
  double residual_ = 0.0;
};

ActiveSet::ActiveSet(const CondensedContact& problem, int iterations, const std::function<void(const ActiveSetStep&)>& step)
    : problem_(problem),
      tell_(step),
      rows_(int(problem.bounds.size())),
      modes_(int(problem.kernel.cols())),
      left_(iterations),
      place_(Vector::Zero(problem.kernel.cols())) {
  compliance();
}

void ActiveSet::compliance() {
  const Matrix& z = problem_.kernel;
  kernelStiffness_ = Vector::Zero(modes_);
  h_ = Matrix::Zero(rows_, rows_);
  g_ = Matrix::Zero(rows_, modes_);
  gapless_ = -problem_.bounds;
  work_ = z.transpose() * problem_.load;
  for (std::size_t block = 0; block + 1 < problem_.blocks.size(); ++block) {
    const int first = problem_.blocks[block], size = problem_.blocks[block + 1] - first;
    // A loose block gets the stiffness of its own dofs on its kernel: definite, and of the size of everything else in it.
    Matrix s = problem_.stiffness.block(first, first, size, size);
    const double own = size > 0 ? s.diagonal().mean() : 0.0;
    for (int m = 0; m < modes_; ++m) {
      const auto part = z.col(m).segment(first, size);
      if (part.isZero(0.0)) continue;
      kernelStiffness_[m] = own;
      s.noalias() += own * part * part.transpose();
    }
    if (!factorInPlace(s))
      throw NumericalError("contact condensed to its dofs: a body's stiffness is not definite although no rigid motion is left in it");

    std::vector<int> here;
    for (int i = 0; i < rows_; ++i)
      if (std::any_of(problem_.dofs[i].begin(), problem_.dofs[i].end(), [&](int dof) { return dof >= first && dof < first + size; }))
        here.push_back(i);
    Matrix y = Matrix::Zero(size, Eigen::Index(here.size()) + 1);  // rows' transposes, then the load
    for (std::size_t c = 0; c < here.size(); ++c)
      for (std::size_t k = 0; k < problem_.dofs[here[c]].size(); ++k) {
        const int dof = problem_.dofs[here[c]][k] - first;
        if (dof >= 0 && dof < size) y(dof, c) += problem_.coefficients[here[c]][k];
      }
    y.rightCols(1) = problem_.load.segment(first, size);
    triangularSolve(s, CblasNoTrans, y);
    const int count = int(here.size()) + 1;
    Matrix product = Matrix::Zero(count, count);
    if (size > 0) cblas_dsyrk(CblasColMajor, CblasLower, CblasTrans, count, size, 1.0, y.data(), size, 0.0, product.data(), count);
    for (std::size_t c = 0; c < here.size(); ++c) {
      for (std::size_t r = c; r < here.size(); ++r) h_(here[r], here[c]) += product(r, c);
      gapless_[here[c]] += product(count - 1, c);
    }
    constant_ += product(count - 1, count - 1);
    factors_.push_back(std::move(s));
  }
  h_.triangularView<Eigen::StrictlyUpper>() = h_.transpose();
  for (int i = 0; i < rows_; ++i)
    for (std::size_t k = 0; k < problem_.dofs[i].size(); ++k) g_.row(i) += problem_.coefficients[i][k] * z.row(problem_.dofs[i][k]);
}

// Forces and gaps for the active set. `tied`: bodies hang on springs at place_, of `spring` times their own stiffness; else their places
// are unknowns. False when the active rows do not hold the bodies.
bool ActiveSet::solve(bool tied, double spring) {
  std::vector<int> a;
  for (int i = 0; i < rows_; ++i)
    if (active_[i]) a.push_back(i);
  const int n = int(a.size());
  Matrix factor = h_(a, a), rhs(n, 1 + modes_);
  const Matrix ga = g_(a, Eigen::all);
  rhs.col(0) = gapless_(a);
  rhs.rightCols(modes_) = ga;
  Matrix soft;  // compliance that softer springs add
  if (tied) {
    soft = (1 / spring - 1) * (g_ * kernelStiffness_.cwiseInverse().asDiagonal());
    factor.noalias() += soft(a, Eigen::all) * ga.transpose();
    rhs.col(0) += ga * place_ + soft(a, Eigen::all) * work_;
  }
  Matrix original = factor;
  if (!factorInPlace(factor)) {
    // Rows that repeat each other (a node squeezed between parallel obstacles) share their force.
    factor = original;
    factor.diagonal() *= 1 + rounding;
    if (!factorInPlace(factor)) return false;
  }
  triangularSolve(factor, CblasNoTrans, rhs);
  if (!tied && modes_ > 0) {
    const Matrix m = rhs.rightCols(modes_).transpose() * rhs.rightCols(modes_);
    if (holding_.size() == 0) holding_ = m.diagonal();  // the first set has all rows closed
    if (!(holding_.minCoeff() > 0)) return false;
    const Vector scale = holding_.cwiseSqrt().cwiseInverse();
    const Eigenpairs eigen = symmetricEigenpairs(scale.asDiagonal() * m * scale.asDiagonal());
    if (eigen.values[0] < loose * std::max(1.0, eigen.values[modes_ - 1])) return false;
    const Vector missing = scale.cwiseProduct(work_ - rhs.rightCols(modes_).transpose() * rhs.col(0));
    place_ =
        scale.cwiseProduct(Vector(eigen.vectors * eigen.values.cwiseInverse().cwiseProduct(Vector(eigen.vectors.transpose() * missing))));
    rhs.col(0) += rhs.rightCols(modes_) * place_;
  }
  triangularSolve(factor, CblasTrans, rhs.leftCols(1));
  force_ = Vector::Zero(rows_);
  force_(a) = rhs.col(0);
  gap_ = h_(Eigen::all, a) * rhs.col(0) - gapless_ - g_ * place_;
  if (tied) gap_ -= soft * (work_ - g_.transpose() * force_);
  return true;
}

std::vector<int> ActiveSet::wrongRows() {
  double displacements = std::max(gapless_.cwiseAbs().maxCoeff(), problem_.bounds.cwiseAbs().maxCoeff());
  if (modes_ > 0) displacements = std::max(displacements, (g_ * place_).cwiseAbs().maxCoeff());
  if (displacements == 0.0) displacements = 1.0;
  const double forces = rounding * force_.cwiseAbs().maxCoeff() + 1e-2 * rounding * problem_.load.cwiseAbs().maxCoeff();
  std::vector<int> wrong;
  residual_ = 0.0;
  for (int i = 0; i < rows_; ++i) {
    if (problem_.dofs[i].empty()) continue;
    const double by = active_[i] ? -force_[i] * h_(i, i) : -gap_[i];
    residual_ = std::max(residual_, by / displacements);
    if (by > rounding * displacements && (!active_[i] || -force_[i] > forces)) wrong.push_back(i);
  }
  return wrong;
}

ActiveSet::Outcome ActiveSet::pivot(bool tied, double spring) {
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  int tries = patience;
  while (left_-- > 0) {
    if (!solve(tied, spring)) return Outcome::Loose;
    std::vector<int> wrong = wrongRows();
    ActiveSetStep step;
    step.active = int(std::count(active_.begin(), active_.end(), 1));
    step.residual = residual_;
    step.energy = -0.5 * constant_ + 0.5 * gapless_.dot(force_) - 0.5 * work_.dot(place_);
    const bool single = !(wrong.size() < fewest) && tries <= 0;
    if (wrong.size() < fewest) {
      fewest = wrong.size();
      tries = patience;
    } else {
      --tries;
    }
    // A set that needs single changes only because of rounding is as good as the next one.
    const bool done = wrong.empty() || (single && residual_ < acceptable);
    if (single) wrong = {wrong.back()};
    step.changed = done ? 0 : int(wrong.size());
    if (!tied) tell_(step);
    if (done) return Outcome::Solved;
    if (single && !tied && modes_ > 0) return Outcome::Cycling;  // least index is sure to end for definite problems only
    for (const int i : wrong) active_[i] = !active_[i];
  }
  return Outcome::OutOfSteps;
}

Vector ActiveSet::displacement() const {
  Vector x = problem_.load;
  for (int i = 0; i < rows_; ++i)
    for (std::size_t k = 0; k < problem_.dofs[i].size(); ++k) x[problem_.dofs[i][k]] -= problem_.coefficients[i][k] * force_[i];
  for (std::size_t block = 0; block + 1 < problem_.blocks.size(); ++block) {
    const int first = problem_.blocks[block], size = problem_.blocks[block + 1] - first;
    Matrix part = x.segment(first, size);
    triangularSolve(factors_[block], CblasNoTrans, part);
    triangularSolve(factors_[block], CblasTrans, part);
    x.segment(first, size) = part;
  }
  return x + problem_.kernel * place_;
}

ContactSolution ActiveSet::run(std::vector<char> start) {
  const std::vector<char> closed(rows_, 1);
  ContactSolution result;
  const auto begin = [&](const std::vector<char>& active) {
    active_ = active;
    for (int i = 0; i < rows_; ++i)
      if (problem_.dofs[i].empty()) active_[i] = 0;  // takes no part
  };
  Outcome outcome = Outcome::Solved;
  begin(closed);
  if (modes_ > 0 && !solve(false, 1.0)) {
    result.failure = "closed contact does not hold the bodies";
    return result;
  }
  if (!start.empty()) begin(start);
  outcome = pivot(false, 1.0);
  for (int k = 0; k < softenings && (outcome == Outcome::Loose || outcome == Outcome::Cycling); ++k) {
    const double spring = std::pow(0.1, k);
    if (k == 0) {
      begin(closed);
      solve(false, 1.0);  // the place to start from
    }
    outcome = pivot(true, spring);
    if (outcome != Outcome::Solved) break;
    // where the springs let the bodies go; then once more without springs
    place_ += (work_ - g_.transpose() * force_).cwiseQuotient(spring * kernelStiffness_);
    const std::vector<char> set = active_;
    const Vector place = place_;
    outcome = pivot(false, 1.0);
    if (outcome == Outcome::Loose || outcome == Outcome::Cycling) {
      active_ = set;
      place_ = place;
    }
  }
  result.converged = outcome == Outcome::Solved;
  if (outcome == Outcome::OutOfSteps) result.failure = "the active set did not settle within the given iterations";
  if (outcome == Outcome::Loose) result.failure = "the active set leaves a body loose";
  if (outcome == Outcome::Cycling) result.failure = "the active set cycles";
  if (force_.size() == 0) return result;
  for (int i = 0; i < rows_; ++i)
    if (problem_.dofs[i].empty()) active_[i] = problem_.bounds[i] <= 0.0;
  result.x = displacement();
  result.force = force_.cwiseMax(0.0);
  result.active = active_;
  return result;
}

}  // namespace

ContactSolution solveCondensedContact(const CondensedContact& problem, std::vector<char> active, int iterations,
                                      const std::function<void(const ActiveSetStep&)>& step) {
  return ActiveSet(problem, iterations, step).run(std::move(active));
}

}  // namespace suture
