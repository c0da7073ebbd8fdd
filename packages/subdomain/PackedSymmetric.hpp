#pragma once
#include <suture/base/Types.hpp>

#include <vector>

namespace suture {

/// A dense symmetric matrix of which little more than the lower triangle is kept: panels of some columns each, from their diagonal block
/// (whole) downwards. A product is two calls of BLAS a panel, of which the second finds it in the cache: memory is read once. In single
/// precision half of that, for what need not be exact: a preconditioner. Local; a product uses work space of its own, so that one object
/// serves one thread.
class PackedSymmetric {
 public:
  enum class Precision { Double, Single };

  PackedSymmetric() = default;
  /// \param matrix  its lower triangle is read
  explicit PackedSymmetric(const Matrix& matrix, Precision precision = Precision::Double);

  int size() const { return size_; }
  double bytes() const { return static_cast<double>(sizeof(double) * values_.size() + sizeof(float) * singles_.size()); }
  /// y <- A x, for several right-hand sides at once.
  void multiply(ConstLocalView x, LocalView y) const;
  Matrix full() const;
  /// A(positions, positions).
  Matrix block(const std::vector<int>& positions) const;

 private:
  double at(int row, int column) const;

  int size_ = 0;
  std::vector<double> values_;  // one of the two
  std::vector<float> singles_;
  std::vector<std::size_t> panels_;  // where each begins
  mutable Eigen::MatrixXf x_, y_;
};

}  // namespace suture
