#include <cblas.h>
#include <suture/subdomain/PackedSymmetric.hpp>

#include <algorithm>

namespace suture {

namespace {

constexpr int kWidth = 32;  // columns of a panel: a tenth more than the triangle for n = 350; 16 and 64 are slower (34 us in single
                            // precision, 54 and 41; spmv: 47)

void product(int rows, int columns, const double* a, const double* x, double* y) {
  cblas_dgemv(CblasColMajor, CblasNoTrans, rows, columns, 1.0, a, rows, x, 1, 1.0, y, 1);
}
void product(int rows, int columns, const float* a, const float* x, float* y) {
  cblas_sgemv(CblasColMajor, CblasNoTrans, rows, columns, 1.0F, a, rows, x, 1, 1.0F, y, 1);
}
void transposedProduct(int rows, int columns, const double* a, int stride, const double* x, double* y) {
  cblas_dgemv(CblasColMajor, CblasTrans, rows, columns, 1.0, a, stride, x, 1, 1.0, y, 1);
}
void transposedProduct(int rows, int columns, const float* a, int stride, const float* x, float* y) {
  cblas_sgemv(CblasColMajor, CblasTrans, rows, columns, 1.0F, a, stride, x, 1, 1.0F, y, 1);
}

/// y += A x
template <typename Real>
void addProduct(int size, const std::vector<std::size_t>& panels, const std::vector<Real>& values, const Real* x, Real* y) {
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const int first = static_cast<int>(p) * kWidth, columns = std::min(kWidth, size - first), rows = size - first;
    const Real* panel = values.data() + panels[p];
    product(rows, columns, panel, x + first, y + first);
    if (rows > columns) transposedProduct(rows - columns, columns, panel + columns, rows, x + first + columns, y + first);
  }
}

template <typename Real>
void fill(const Matrix& matrix, std::vector<Real>& values, std::vector<std::size_t>& panels) {
  const int size = static_cast<int>(matrix.rows());
  for (int first = 0; first < size; first += kWidth) {
    const int end = std::min(first + kWidth, size);
    panels.push_back(values.size());
    for (int j = first; j < end; ++j) {
      for (int i = first; i < j; ++i) values.push_back(static_cast<Real>(matrix(j, i)));
      for (int i = j; i < size; ++i) values.push_back(static_cast<Real>(matrix(i, j)));
    }
  }
}

std::size_t entries(int size) {
  std::size_t all = 0;
  for (int first = 0; first < size; first += kWidth) all += static_cast<std::size_t>(size - first) * std::min(kWidth, size - first);
  return all;
}

}  // namespace

PackedSymmetric::PackedSymmetric(const Matrix& matrix, Precision precision) : size_(static_cast<int>(matrix.rows())) {
  if (precision == Precision::Single) {
    singles_.reserve(entries(size_));
    fill(matrix, singles_, panels_);
  } else {
    values_.reserve(entries(size_));
    fill(matrix, values_, panels_);
  }
}

void PackedSymmetric::multiply(ConstLocalView x, LocalView y) const {
  if (singles_.empty()) {
    y.setZero();
    for (Eigen::Index c = 0; c < x.cols(); ++c) addProduct(size_, panels_, values_, x.col(c).data(), y.col(c).data());
    return;
  }
  // The range of single precision is narrow: vectors are brought to the size of one. What is no number stays none.
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    double scale = x.col(c).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    if (scale == 0.0) scale = 1.0;
    x_ = (x.col(c) / scale).cast<float>();
    y_.setZero(size_, 1);
    addProduct(size_, panels_, singles_, x_.data(), y_.data());
    y.col(c) = scale * y_.cast<double>();
  }
}

double PackedSymmetric::at(int row, int column) const {
  if (row < column) std::swap(row, column);
  const int panel = column / kWidth, first = panel * kWidth;
  const std::size_t place = panels_[panel] + static_cast<std::size_t>(column - first) * (size_ - first) + (row - first);
  return singles_.empty() ? values_[place] : static_cast<double>(singles_[place]);
}

Matrix PackedSymmetric::full() const {
  Matrix made(size_, size_);
  for (int j = 0; j < size_; ++j)
    for (int i = j; i < size_; ++i) made(i, j) = at(i, j);
  made.triangularView<Eigen::StrictlyUpper>() = made.transpose();
  return made;
}

Matrix PackedSymmetric::block(const std::vector<int>& positions) const {
  const int n = static_cast<int>(positions.size());
  Matrix made(n, n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) made(i, j) = at(positions[i], positions[j]);
  return made;
}

}  // namespace suture
