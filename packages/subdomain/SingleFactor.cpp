#include <cblas.h>
#include <suture/base/Errors.hpp>
#include <suture/subdomain/SingleFactor.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace suture {

namespace {

using Singles = Eigen::VectorXf;

constexpr double kAccuracy = 1e-15;  // of the recursion; what rounding leaves in the true residual is that of a direct solve
constexpr double kSurely = 1e-4;     // by how much a residual that is only expected has to be below its square
constexpr int kMost = 200;

}  // namespace

void SingleFactor::reserve(std::size_t supernodes, std::size_t rows, std::size_t entries) {
  supernodes_.reserve(supernodes);
  rows_.reserve(rows);
  values_.reserve(entries);
}

void SingleFactor::append(int first, int columns, const std::vector<int>& below, const double* values, int stride) {
  const int count = static_cast<int>(below.size());
  supernodes_.push_back({first, columns, count, rows_.size(), values_.size()});
  rows_.insert(rows_.end(), below.begin(), below.end());
  const auto copy = [&](int column, int begin, int end) {
    const double* from = values + static_cast<std::ptrdiff_t>(column) * stride;
    values_.insert(values_.end(), from + begin, from + end);
  };
  for (int j = 0; j < columns; ++j) copy(j, j, columns);
  for (int j = 0; j < columns; ++j) copy(j, columns, columns + count);
  mostBelow_ = std::max(mostBelow_, count);
}

void SingleFactor::precondition(const Vector& r, Vector& z) const {
  Singles y(unknownOf_.size()), rest(mostBelow_);
  // Single precision has a narrow range: residuals are brought to the size of one.
  double largest = 0.0;
  for (const int unknown : unknownOf_) largest = std::max(largest, std::abs(r(unknown)));
  z.setZero();
  if (largest == 0.0) return;
  for (std::size_t j = 0; j < unknownOf_.size(); ++j) y(static_cast<int>(j)) = static_cast<float>(r(unknownOf_[j]) / largest);
  for (const Supernode& s : supernodes_) {
    const float *triangle = values_.data() + s.values, *panel = triangle + entries(s.columns, 0);
    const int* rows = rows_.data() + s.rows;
    float* own = y.data() + s.first;
    cblas_stpsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, s.columns, triangle, own, 1);
    if (s.below == 0) continue;
    cblas_sgemv(CblasColMajor, CblasNoTrans, s.below, s.columns, 1.0F, panel, s.below, own, 1, 0.0F, rest.data(), 1);
    for (int k = 0; k < s.below; ++k) y(rows[k]) -= rest(k);
  }
  for (auto s = supernodes_.rbegin(); s != supernodes_.rend(); ++s) {
    const float *triangle = values_.data() + s->values, *panel = triangle + entries(s->columns, 0);
    const int* rows = rows_.data() + s->rows;
    float* own = y.data() + s->first;
    if (s->below > 0) {
      for (int k = 0; k < s->below; ++k) rest(k) = y(rows[k]);
      cblas_sgemv(CblasColMajor, CblasTrans, s->below, s->columns, -1.0F, panel, s->below, rest.data(), 1, 1.0F, own, 1);
    }
    cblas_stpsv(CblasColMajor, CblasLower, CblasTrans, CblasNonUnit, s->columns, triangle, own, 1);
  }
  for (std::size_t j = 0; j < unknownOf_.size(); ++j) z(unknownOf_[j]) = largest * static_cast<double>(y(static_cast<int>(j)));
}

void SingleFactor::solve(const SparseMatrix& matrix, Vector& x) const {
  Vector r = Vector::Zero(x.size()), z(x.size()), p, q(x.size());
  for (const int unknown : unknownOf_) r(unknown) = x(unknown);
  x.setZero();
  double rz = 0.0, target = 0.0;
  for (int step = 0; step <= kMost; ++step) {
    precondition(r, z);
    const double now = r.dot(z);
    if (!std::isfinite(now)) break;
    if (step == 0) target = kAccuracy * kAccuracy * now;
    if (now <= target) return;
    // The next one will be smaller by the same factor: where that is far below the target, it need not be seen.
    const bool isLast = step > 0 && now * (now / rz) <= kSurely * target;
    p = step == 0 ? z : Vector(z + (now / rz) * p);
    rz = now;
    q.noalias() = matrix * p;
    const double length = rz / p.dot(q);
    x += length * p;
    if (isLast) return;
    for (const int unknown : unknownOf_) r(unknown) -= length * q(unknown);
  }
  throw NumericalError("interior unknowns: " + std::to_string(kMost) + " steps with a factor in single precision did not suffice");
}

}  // namespace suture
