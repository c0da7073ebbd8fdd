#include <suture/algebra/Lanes.hpp>
#include <suture/algebra/elimination/SingleFactor.hpp>
#include <suture/base/Errors.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace suture {

namespace {

using Singles = Eigen::VectorXf;

constexpr double kAccuracy = 1e-15;  // accuracy of the recursion; the rounding left in the true residual is that of a direct solve
constexpr double kSurely = 1e-4;     // by how much a residual that is only expected has to be below its square
constexpr int kMost = 200;

/// Largest power of two that is not larger than a positive number.
double powerOfTwo(double value) { return std::ldexp(1.0, std::ilogb(value)); }

// Most supernodes have some sixteen columns, which take less time than a call of BLAS: hertz at 1M unknowns 0.11 to 0.14 s in all, 0.20 to
// 0.21 with four calls a supernode (three runs in alternation).

/// x <- [L_11 0; L_21 I]^-1 x, columns of the supernode one after the other.
SUTURE_FOR_EACH_PROCESSOR void eliminate(int columns, int rows, const float* values, float* x) {
  for (int j = 0; j < columns; ++j) {
    x[j] *= values[0];
    subtractMultiple(rows - j - 1, x[j], values + 1, x + j + 1);
    values += rows - j;
  }
}

/// x <- its transpose's inverse times x; `end` of the supernode's values.
SUTURE_FOR_EACH_PROCESSOR void substituteBack(int columns, int rows, const float* end, float* x) {
  for (int j = columns - 1; j >= 0; --j) {
    end -= rows - j;
    x[j] = (x[j] - scalarProduct(rows - j - 1, end + 1, x + j + 1)) * end[0];
  }
}

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
  if (scale_ == 0.0) scale_ = powerOfTwo(values[0]);
  const double unscaled = 1.0 / scale_;
  for (int j = 0; j < columns; ++j) {
    const double* from = values + static_cast<std::ptrdiff_t>(j) * stride;
    values_.push_back(static_cast<float>(scale_ / from[j]));
    for (int i = j + 1; i < columns + count; ++i) values_.push_back(static_cast<float>(from[i] * unscaled));
  }
  mostRows_ = std::max(mostRows_, columns + count);
}

void SingleFactor::precondition(const Vector& r, Vector& z) const {
  Singles y(unknownOf_.size()), x(mostRows_);
  // Single precision has a narrow range: residuals are brought to the size of one.
  double largest = 0.0;
  for (const int unknown : unknownOf_) largest = std::max(largest, std::abs(r(unknown)));
  z.setZero();
  if (largest == 0.0) return;
  for (std::size_t j = 0; j < unknownOf_.size(); ++j) y(static_cast<int>(j)) = static_cast<float>(r(unknownOf_[j]) / largest);
  for (const Supernode& s : supernodes_) {
    const int* below = rows_.data() + s.rows;
    std::copy_n(y.data() + s.first, s.columns, x.data());
    std::fill_n(x.data() + s.columns, s.below, 0.0F);
    eliminate(s.columns, s.columns + s.below, values_.data() + s.values, x.data());
    std::copy_n(x.data(), s.columns, y.data() + s.first);
    for (int k = 0; k < s.below; ++k) y(below[k]) += x(s.columns + k);
  }
  for (auto s = supernodes_.rbegin(); s != supernodes_.rend(); ++s) {
    const int* below = rows_.data() + s->rows;
    std::copy_n(y.data() + s->first, s->columns, x.data());
    for (int k = 0; k < s->below; ++k) x(s->columns + k) = y(below[k]);
    substituteBack(s->columns, s->columns + s->below, values_.data() + s->values + entries(s->columns, s->below), x.data());
    std::copy_n(x.data(), s->columns, y.data() + s->first);
  }
  const double back = largest / scale_ / scale_;
  for (std::size_t j = 0; j < unknownOf_.size(); ++j) z(unknownOf_[j]) = back * static_cast<double>(y(static_cast<int>(j)));
}

void SingleFactor::solve(const SymmetricMatrix& matrix, Vector& x) const {
  double largest = 0.0;
  for (const int unknown : unknownOf_) largest = std::max(largest, std::abs(x(unknown)));
  const double size = largest > 0.0 && std::isfinite(largest) ? powerOfTwo(largest) : 1.0;  // squares of small loads would underflow
  Vector r = Vector::Zero(x.size());
  for (const int unknown : unknownOf_) r(unknown) = x(unknown) / size;
  x.setZero();
  iterate(matrix, r, x);
  x *= size;
}

void SingleFactor::iterate(const SymmetricMatrix& matrix, Vector& r, Vector& x) const {
  Vector z(x.size()), p, q;
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
    q = matrix * p;
    const double length = rz / p.dot(q);
    x += length * p;
    if (isLast) return;
    for (const int unknown : unknownOf_) r(unknown) -= length * q(unknown);
  }
  throw NumericalError("interior unknowns: " + std::to_string(kMost) + " steps with a factor in single precision did not suffice");
}

}  // namespace suture
