#include <suture/algebra/Lanes.hpp>
#include <suture/algebra/WorkSpace.hpp>
#include <suture/algebra/elimination/SingleFactor.hpp>
#include <suture/base/Errors.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kAccuracy = 1e-15;  // accuracy of the recursive residual; the true residual has the round-off of a direct solve
constexpr double kSurely = 1e-4;     // safety factor on the squared target for a predicted residual
constexpr int kMost = 200;

/// Largest power of two that does not exceed a positive number.
double powerOfTwo(double value) { return std::ldexp(1.0, std::ilogb(value)); }

// Most supernodes have about sixteen columns, for which these loops are faster than BLAS: hertz at 1M unknowns 0.11 to 0.14 s in total,
// 0.20 to 0.21 with four BLAS calls per supernode (three runs in alternation).

/// x <- [L_11 0; L_21 I]^-1 x, column by column of the supernode; one right-hand side, or as many as a register holds.
template <int columns>
SUTURE_FOR_EACH_PROCESSOR void eliminate(int width, int rows, const float* values, float* x) {
  using Many = Register<float>;
  int j = 0;
  if constexpr (columns == 1)
    for (; j + 4 <= width; j += 4) {
      const int below = rows - j - 4;
      const float *a = values, *b = a + below + 4, *c = b + below + 3, *d = c + below + 2;
      float* const own = x + j;
      own[0] *= a[0];
      own[1] = (own[1] - a[1] * own[0]) * b[0];
      own[2] = (own[2] - a[2] * own[0] - b[1] * own[1]) * c[0];
      own[3] = (own[3] - a[3] * own[0] - b[2] * own[1] - c[1] * own[2]) * d[0];
      subtractMultiples(below, own, a + 4, b + 3, c + 2, d + 1, own + 4);
      values = d + below + 1;
    }
  for (; j < width; ++j, values += rows - j + 1) {
    if constexpr (columns == 1) {
      x[j] *= values[0];
      subtractMultiple(rows - j - 1, x[j], values + 1, x + j + 1);
    } else {
      const Many::Type own = Many::at(x + columns * j) * values[0];
      Many::at(x + columns * j) = own;
      for (int i = 1; i < rows - j; ++i) Many::at(x + columns * (j + i)) -= values[i] * own;
    }
  }
}

/// x <- the transposed inverse times x; `end`: end of the supernode's values.
template <int columns>
SUTURE_FOR_EACH_PROCESSOR void substituteBack(int width, int rows, const float* end, float* x) {
  using Many = Register<float>;
  for (int j = width - 1; j >= 0; --j) {
    end -= rows - j;
    if constexpr (columns == 1) {
      x[j] = (x[j] - scalarProduct(rows - j - 1, end + 1, x + j + 1)) * end[0];
    } else {
      Many::Type own = Many::at(x + columns * j), other = {};
      int i = 1;
      for (; i + 1 < rows - j; i += 2) {
        own -= end[i] * Many::at(x + columns * (j + i));
        other += end[i + 1] * Many::at(x + columns * (j + i + 1));
      }
      if (i < rows - j) own -= end[i] * Many::at(x + columns * (j + i));
      Many::at(x + columns * j) = (own - other) * end[0];
    }
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
  values_.resize(values_.size() + entries(columns, count));
  float* to = values_.data() + supernodes_.back().values;
  for (int j = 0; j < columns; ++j) {
    const double* from = values + static_cast<std::ptrdiff_t>(j) * stride;
    *to++ = static_cast<float>(scale_ / from[j]);
    for (int i = j + 1; i < columns + count; ++i) *to++ = static_cast<float>(from[i] * unscaled);
  }
  mostRows_ = std::max(mostRows_, columns + count);
}

// The right-hand sides are interleaved row by row.
template <int columns>
void SingleFactor::substitute(float* y, float* x) const {
  const auto isZero = [](float value) { return value == 0.0F; };
  const auto gather = [&](const int* rows, int count, float* to) {
    for (int k = 0; k < count; ++k) std::copy_n(y + columns * rows[k], columns, to + columns * k);
  };
  for (const Supernode& s : supernodes_) {
    float* const own = y + columns * s.first;
    if (std::all_of(own, own + columns * s.columns, isZero)) continue;
    const int* below = rows_.data() + s.rows;
    float* const rest = x + columns * s.columns;
    std::copy_n(own, columns * s.columns, x);
    std::fill_n(rest, columns * s.below, 0.0F);
    eliminate<columns>(s.columns, s.columns + s.below, values_.data() + s.values, x);
    std::copy_n(x, columns * s.columns, own);
    for (int k = 0; k < s.below; ++k)
      for (int c = 0; c < columns; ++c) y[columns * below[k] + c] += rest[columns * k + c];
  }
  for (auto s = supernodes_.rbegin(); s != supernodes_.rend(); ++s) {
    float* const own = y + columns * s->first;
    std::copy_n(own, columns * s->columns, x);
    gather(rows_.data() + s->rows, s->below, x + columns * s->columns);
    substituteBack<columns>(s->columns, s->columns + s->below, values_.data() + s->values + entries(s->columns, s->below), x);
    std::copy_n(x, columns * s->columns, own);
  }
}

/// Applies the factor to up to `columns` right-hand sides.
template <int columns>
void SingleFactor::applyTo(ConstLocalView r, LocalView z) const {
  const std::size_t n = unknownOf_.size();
  float* const y = kernelSpace<float>(columns * (n + mostRows_));
  double largest[columns] = {};  // residuals are scaled to order one: single precision has a narrow range
  const int given = static_cast<int>(r.cols());
  for (int c = 0; c < given; ++c) {
    for (const int unknown : unknownOf_) largest[c] = std::max(largest[c], std::abs(r(unknown, c)));
    const double scale = largest[c] > 0.0 ? largest[c] : 1.0;
    for (std::size_t j = 0; j < n; ++j) y[columns * j + c] = static_cast<float>(r(unknownOf_[j], c) / scale);
  }
  for (int c = given; c < columns; ++c)
    for (std::size_t j = 0; j < n; ++j) y[columns * j + c] = 0.0F;
  substitute<columns>(y, y + columns * n);
  for (int c = 0; c < given; ++c) {
    if (static_cast<Eigen::Index>(n) < z.rows()) z.col(c).setZero();
    const double back = largest[c] / scale_ / scale_;
    for (std::size_t j = 0; j < n; ++j) z(unknownOf_[j], c) = back * static_cast<double>(y[columns * j + c]);
  }
}

void SingleFactor::apply(ConstLocalView r, LocalView z) const {
  constexpr int many = Register<float>::count;
  for (Eigen::Index first = 0; first < r.cols(); first += many) {
    const Eigen::Index count = std::min<Eigen::Index>(many, r.cols() - first);
    if (count == 1)
      applyTo<1>(r.middleCols(first, count), z.middleCols(first, count));
    else
      applyTo<many>(r.middleCols(first, count), z.middleCols(first, count));
  }
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
    apply(r, z);
    const double now = r.dot(z);
    if (!std::isfinite(now)) break;
    if (step == 0) target = kAccuracy * kAccuracy * now;
    if (now <= target) return;
    // The next residual is predicted to fall by the same factor; if the prediction is far below the target, it is not computed.
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
