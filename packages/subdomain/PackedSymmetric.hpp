#pragma once
#include <suture/base/Types.hpp>

#include <utility>
#include <vector>

namespace suture {

/// A dense symmetric matrix, the columns of its lower triangle one after another: half the memory of a full one, and a product with it,
/// which does nothing but read it, takes half the time (BLAS dspmv; n = 250, out of cache: 0.67 of dgemv, 0.34 of Eigen's symmetric product
/// with one column). Local.
class PackedSymmetric {
 public:
  PackedSymmetric() = default;
  /// \param matrix  its lower triangle is read
  explicit PackedSymmetric(const Matrix& matrix);

  int size() const { return size_; }
  /// y <- A x, column by column.
  void multiply(ConstLocalView x, LocalView y) const;
  Matrix full() const;
  /// A(positions, positions).
  Matrix block(const std::vector<int>& positions) const;

 private:
  double at(int row, int column) const {
    if (row < column) std::swap(row, column);
    return values_(column * static_cast<Eigen::Index>(2 * size_ - column - 1) / 2 + row);
  }

  int size_ = 0;
  Vector values_;
};

}  // namespace suture
