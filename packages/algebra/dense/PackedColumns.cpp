#include <suture/algebra/Lanes.hpp>
#include <suture/algebra/WorkSpace.hpp>
#include <suture/algebra/dense/PackedColumns.hpp>

#include <algorithm>

namespace suture {

namespace {

template <typename Real>
constexpr int kLine = suture::Line<Real>::count;

/// y <- A^T x.
template <typename Real>
SUTURE_FOR_EACH_PROCESSOR void transposedProduct(int rows, int columns, const Real* a, const double* given, double* y) {
  using Line = suture::Line<Real>;
  using Four = suture::Four<Real>;
  const int most = padded(rows, Line::count);
  Real *x = kernelSpace<Real>(static_cast<std::size_t>(most) + padded(columns, kWidth)), *product = x + most;
  const double scale = scaleOf<Real>(rows, given);
  divide(rows, given, scale, x);
  for (int i = rows; i < most; ++i) x[i] = 0;
  for (int j = 0; j < columns; j += kWidth) {
    typename Line::Type s0 = {}, s1 = {}, s2 = {}, s3 = {};
    for (int i = 0; i < most; i += Line::count, a += kWidth * Line::count) {
      const typename Line::Type& u = Line::at(x + i);
      s0 += Line::at(a) * u;
      s1 += Line::at(a + Line::count) * u;
      s2 += Line::at(a + 2 * Line::count) * u;
      s3 += Line::at(a + 3 * Line::count) * u;
    }
    typename Four::Type t0 = {}, t1 = {}, t2 = {}, t3 = {};
    foldInto<Real>(s0, t0);
    foldInto<Real>(s1, t1);
    foldInto<Real>(s2, t2);
    foldInto<Real>(s3, t3);
    product[j] = t0[0] + t0[1] + t0[2] + t0[3];
    product[j + 1] = t1[0] + t1[1] + t1[2] + t1[3];
    product[j + 2] = t2[0] + t2[1] + t2[2] + t2[3];
    product[j + 3] = t3[0] + t3[1] + t3[2] + t3[3];
  }
  multiply<0>(columns, scale, product, y);
}

/// y += A x
template <typename Real>
SUTURE_FOR_EACH_PROCESSOR void addProduct(int rows, int columns, const Real* a, const double* given, double* y) {
  using Line = suture::Line<Real>;
  const int most = padded(rows, Line::count);
  Real *sum = kernelSpace<Real>(static_cast<std::size_t>(most) + padded(columns, kWidth)), *x = sum + most;
  const double scale = scaleOf<Real>(columns, given);
  divide(columns, given, scale, x);
  for (int j = columns; j < padded(columns, kWidth); ++j) x[j] = 0;
  for (int i = 0; i < most; ++i) sum[i] = 0;
  for (int j = 0; j < columns; j += kWidth) {
    const Real x0 = x[j], x1 = x[j + 1], x2 = x[j + 2], x3 = x[j + 3];
    for (int i = 0; i < most; i += Line::count, a += kWidth * Line::count)
      Line::at(sum + i) +=
          Line::at(a) * x0 + Line::at(a + Line::count) * x1 + Line::at(a + 2 * Line::count) * x2 + Line::at(a + 3 * Line::count) * x3;
  }
  multiply<1>(rows, scale, sum, y);
}

}  // namespace

PackedColumns::PackedColumns(const Matrix& matrix, Precision precision)
    : rows_(static_cast<int>(matrix.rows())), columns_(static_cast<int>(matrix.cols())) {
  if (precision == Precision::Single)
    fill(matrix, singles_);
  else
    fill(matrix, values_);
}

template <typename Real>
std::size_t PackedColumns::place(int row, int column) const {
  constexpr int line = kLine<Real>;
  const std::size_t panel = static_cast<std::size_t>(column / kWidth) * kWidth * padded(rows_, line);
  return panel + static_cast<std::size_t>(row / line) * line * kWidth + column % kWidth * line + row % line;
}

template <typename Real>
void PackedColumns::fill(const Matrix& matrix, AlignedVector<Real>& values) const {
  values.resize(static_cast<std::size_t>(padded(rows_, kLine<Real>)) * padded(columns_, kWidth));
  std::fill(values.begin(), values.end(), Real(0));
  for (int j = 0; j < columns_; ++j)
    for (int i = 0; i < rows_; ++i) values[place<Real>(i, j)] = static_cast<Real>(matrix(i, j));
}

void PackedColumns::multiplyTransposed(const Eigen::Ref<const Vector>& x, Vector& y) const {
  y.resize(columns_);
  if (rows_ == 0)
    y.setZero();
  else if (singles_.empty())
    transposedProduct(rows_, columns_, values_.data(), x.data(), y.data());
  else
    transposedProduct(rows_, columns_, singles_.data(), x.data(), y.data());
}

void PackedColumns::addProduct(const Vector& x, Eigen::Ref<Vector> y) const {
  if (singles_.empty())
    suture::addProduct(rows_, columns_, values_.data(), x.data(), y.data());
  else
    suture::addProduct(rows_, columns_, singles_.data(), x.data(), y.data());
}

Matrix PackedColumns::full() const {
  Matrix made(rows_, columns_);
  for (int j = 0; j < columns_; ++j)
    for (int i = 0; i < rows_; ++i)
      made(i, j) = singles_.empty() ? values_[place<double>(i, j)] : static_cast<double>(singles_[place<float>(i, j)]);
  return made;
}

}  // namespace suture
