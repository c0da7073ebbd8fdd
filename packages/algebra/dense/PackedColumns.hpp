#pragma once
#include <suture/algebra/dense/PackedSymmetric.hpp>

namespace suture {

/// A dense matrix with more rows than columns, used only for products with vectors from either side: the bases of BDDC. Four columns are
/// stored next to each other, interleaved by cache lines, so that a product reads memory sequentially. Local; const access is thread-safe.
class PackedColumns {
 public:
  using Precision = PackedSymmetric::Precision;

  PackedColumns() = default;
  explicit PackedColumns(const Matrix& matrix, Precision precision = Precision::Double);

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  double bytes() const { return static_cast<double>(sizeof(double) * values_.size() + sizeof(float) * singles_.size()); }
  /// y <- A^T x.
  void multiplyTransposed(const Eigen::Ref<const Vector>& x, Vector& y) const;
  /// y <- y + A x.
  void addProduct(const Vector& x, Eigen::Ref<Vector> y) const;
  Matrix full() const;

 private:
  template <typename Real>
  void fill(const Matrix& matrix, AlignedVector<Real>& values) const;
  template <typename Real>
  std::size_t place(int row, int column) const;

  int rows_ = 0, columns_ = 0;
  AlignedVector<double> values_;  // one of the two
  AlignedVector<float> singles_;
};

}  // namespace suture
