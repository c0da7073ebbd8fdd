#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/precond/coarse/ChebyshevInverse.hpp>

#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr int kLanczosSteps = 12;
constexpr double kMargin = 1.05;     // the Lanczos estimate is a lower bound
constexpr int kMostChebyshev = 100;  // above a condition number of 5000 the outer iteration does the rest

/// A vector with a component in every eigenvector, independent of the number of ranks.
void fillUneven(const InterfaceSpace& space, MultiVector& x) {
  auto values = localView(x);
  for (int row = 0; row < values.rows(); ++row) {
    const auto id = static_cast<unsigned long long>(space.map()->getGlobalElement(row));
    values(row, 0) = static_cast<double>((id * 2654435761ull + 12345ull) % 65536ull) / 32768.0 - 1.0;
  }
}

}  // namespace

ChebyshevInverse::ChebyshevInverse(Teuchos::RCP<const InterfaceOperator> matrix, Teuchos::RCP<const Preconditioner> preconditioner,
                                   double accuracy)
    : matrix_(std::move(matrix)), preconditioner_(std::move(preconditioner)), largest_(std::max(1.0, estimateLargest())) {
  const double high = std::max(kMargin * largest_, 1.0 + 1e-3);
  const double needed = std::ceil(std::acosh(1.0 / accuracy) / std::acosh((high + 1.0) / (high - 1.0)));
  isClamped_ = needed > kMostChebyshev;
  steps_ = static_cast<int>(std::clamp(needed, 1.0, static_cast<double>(kMostChebyshev)));
}

/// Largest eigenvalue of the Lanczos matrix of conjugate gradients.
double ChebyshevInverse::estimateLargest() const {
  const InterfaceSpace& space = *matrix_->space();
  const MultiVectorPtr r = space.vector(), z = space.vector(), p = space.vector(), q = space.vector();
  fillUneven(space, *r);
  preconditioner_->apply(*r, *z);
  p->assign(*z);
  double rho = dot(*r, *z);
  const double first = rho;
  std::vector<double> diagonal, offDiagonal;
  double alpha = 1.0, beta = 0.0;
  while (static_cast<int>(diagonal.size()) < kLanczosSteps && rho > 1e-20 * first && rho > 0.0) {
    matrix_->apply(*p, *q);
    const double last = alpha;
    alpha = rho / dot(*p, *q);
    if (!diagonal.empty()) offDiagonal.push_back(std::sqrt(beta) / last);
    diagonal.push_back(1.0 / alpha + beta / last);
    r->update(-alpha, *q, 1.0);
    preconditioner_->apply(*r, *z);
    const double next = dot(*r, *z);
    beta = next / rho;
    rho = next;
    p->update(1.0, *z, beta);
  }
  return diagonal.empty() ? 1.0 : tridiagonalEigenvalues(diagonal, offDiagonal).back();
}

void ChebyshevInverse::apply(const MultiVector& b, MultiVector& x) const {
  const double high = std::max(kMargin * largest_, 1.0 + 1e-3);
  const double middle = 0.5 * (high + 1.0), half = 0.5 * (high - 1.0);
  if (work_[0].is_null())
    for (MultiVectorPtr& vector : work_) vector = matrix_->space()->vector();
  const auto& [r, z, d, image] = work_;
  r->assign(b);
  preconditioner_->apply(*r, *z);
  d->update(1.0 / middle, *z, 0.0);
  x.assign(*d);
  double rho = half / middle;
  for (int k = 1; k < steps_; ++k) {
    matrix_->apply(*d, *image);
    r->update(-1.0, *image, 1.0);
    preconditioner_->apply(*r, *z);
    const double next = 1.0 / (2.0 * middle / half - rho);
    d->update(2.0 * next / half, *z, next * rho);
    x.update(1.0, *d, 1.0);
    rho = next;
  }
}

}  // namespace suture
