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
  const int rows = columns + count;
  values_.resize(values_.size() + static_cast<std::size_t>(rows) * columns);
  float* to = values_.data() + supernodes_.back().values;
  for (int j = 0; j < columns; ++j, to += rows) {
    const double* column = values + static_cast<std::ptrdiff_t>(j) * stride;
    for (int i = 0; i < rows; ++i) to[i] = static_cast<float>(column[i]);
  }
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
    const int stride = s.columns + s.below;
    const float *triangle = values_.data() + s.values, *panel = triangle + s.columns;
    const int* rows = rows_.data() + s.rows;
    float* own = y.data() + s.first;
    cblas_strsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, s.columns, triangle, stride, own, 1);
    if (s.below == 0) continue;
    cblas_sgemv(CblasColMajor, CblasNoTrans, s.below, s.columns, 1.0F, panel, stride, own, 1, 0.0F, rest.data(), 1);
    for (int k = 0; k < s.below; ++k) y(rows[k]) -= rest(k);
  }
  for (auto s = supernodes_.rbegin(); s != supernodes_.rend(); ++s) {
    const int stride = s->columns + s->below;
    const float *triangle = values_.data() + s->values, *panel = triangle + s->columns;
    const int* rows = rows_.data() + s->rows;
    float* own = y.data() + s->first;
    if (s->below > 0) {
      for (int k = 0; k < s->below; ++k) rest(k) = y(rows[k]);
      cblas_sgemv(CblasColMajor, CblasTrans, s->below, s->columns, -1.0F, panel, stride, rest.data(), 1, 1.0F, own, 1);
    }
    cblas_strsv(CblasColMajor, CblasLower, CblasTrans, CblasNonUnit, s->columns, triangle, stride, own, 1);
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
    p = step == 0 ? z : Vector(z + (now / rz) * p);
    rz = now;
    q.noalias() = matrix * p;
    const double length = rz / p.dot(q);
    x += length * p;
    for (const int unknown : unknownOf_) r(unknown) -= length * q(unknown);
  }
  throw NumericalError("interior unknowns: " + std::to_string(kMost) + " steps with a factor in single precision did not suffice");
}

}  // namespace suture
