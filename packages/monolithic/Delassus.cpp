#include <suture/algebra/Blas.hpp>
#include <suture/base/Errors.hpp>
#include <suture/monolithic/Delassus.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double pointCompliance = 2.0;  // as in ContactCompliance: half of a pair's compliance comes from the body beyond its own elements

// b <- L^-1 b, or L^-T b.
void triangularSolve(const Matrix& lower, CBLAS_TRANSPOSE transpose, Eigen::Ref<Matrix> b) {
  if (lower.rows() == 0 || b.cols() == 0) return;
  cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, transpose, CblasNonUnit, int(lower.rows()), int(b.cols()), 1.0, lower.data(),
              int(lower.rows()), b.data(), int(b.outerStride()));
}

}  // namespace

Delassus::Delassus(const CondensedContact& problem)
    : problem_(problem), rows_(int(problem.bounds.size())), modes_(int(problem.kernel.cols())), blocksOf_(rows_), kernel_(problem.kernel) {
  for (int m = 0; m < modes_; ++m) kernel_.col(m) /= kernel_.col(m).cwiseAbs().maxCoeff();
  const Matrix& z = problem_.kernel;
  h_ = Matrix::Zero(rows_, rows_);
  g_ = Matrix::Zero(rows_, modes_);
  gapless_ = -problem_.bounds;
  work_ = kernel_.transpose() * problem_.load;
  for (std::size_t block = 0; block + 1 < problem_.blocks.size(); ++block) {
    const int first = problem_.blocks[block], size = problem_.blocks[block + 1] - first;
    // A loose block gets the mean stiffness of its dofs on its kernel, which makes it definite without new scales.
    Matrix s = problem_.stiffness.block(first, first, size, size);
    double own = size > 0 ? s.diagonal().mean() : 0.0;
    int modes = 0;
    for (int m = 0; m < modes_; ++m) modes += !z.col(m).segment(first, size).isZero(0.0);
    if (size > 0 && modes == size && problem_.diagonal.size() > 0) {  // a body in contact by a rigid group only: s is mere round-off
      s.setZero();
      own = problem_.diagonal.segment(first, size).mean();
    }
    for (int m = 0; m < modes_; ++m) {
      const auto part = z.col(m).segment(first, size);
      if (part.isZero(0.0)) continue;
      s.noalias() += own * part * part.transpose();
    }
    if (!potrf(int(s.rows()), s.data()))
      throw NumericalError("condensed contact: the stiffness of a body is not positive definite although it has no rigid-body mode left");

    std::vector<int> here;
    for (int i = 0; i < rows_; ++i)
      if (std::any_of(problem_.dofs[i].begin(), problem_.dofs[i].end(), [&](int dof) { return dof >= first && dof < first + size; }))
        here.push_back(i);
    for (const int i : here) blocksOf_[i].push_back(int(block));
    Matrix y = Matrix::Zero(size, Eigen::Index(here.size()) + 1);  // transposed rows, then the load
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
    for (std::size_t k = 0; k < problem_.dofs[i].size(); ++k) g_.row(i) += problem_.coefficients[i][k] * kernel_.row(problem_.dofs[i][k]);
}

RigidBodyModel Delassus::rigidBodyModel() const {
  RigidBodyModel::Pairs pairs;
  pairs.rows = g_.sparseView();
  pairs.work = work_;
  pairs.penetration = gapless_;
  pairs.stiffness = Vector::Ones(rows_);
  pairs.bodies = blocksOf_;
  pairs.surfaces = problem_.surfaces;
  for (int i = 0; i < rows_; ++i) {
    pairs.canChange.push_back(!problem_.dofs[i].empty());
    if (pairs.canChange[i]) pairs.stiffness[i] = pointCompliance / h_(i, i);
    pairs.line.push_back(problem_.lines.empty() ? 0 : problem_.lines[i]);
  }
  return RigidBodyModel(std::move(pairs));
}

/// Round-off of displacements without contact forces, from the bounds and from the displacements under the loads.
Vector Delassus::rounding() const { return 1e-13 * (problem_.bounds.cwiseAbs() + (gapless_ + problem_.bounds).cwiseAbs()); }

Vector Delassus::displacement(const Vector& force, const Vector& place) const {
  Vector x = problem_.load;
  for (int i = 0; i < rows_; ++i)
    for (std::size_t k = 0; k < problem_.dofs[i].size(); ++k) x[problem_.dofs[i][k]] -= problem_.coefficients[i][k] * force[i];
  for (std::size_t block = 0; block + 1 < problem_.blocks.size(); ++block) {
    const int first = problem_.blocks[block], size = problem_.blocks[block + 1] - first;
    Matrix part = x.segment(first, size);
    triangularSolve(factors_[block], CblasNoTrans, part);
    triangularSolve(factors_[block], CblasTrans, part);
    x.segment(first, size) = part;
  }
  return x + kernel_ * place;
}

}  // namespace suture
