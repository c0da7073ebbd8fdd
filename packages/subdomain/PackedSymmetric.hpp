#pragma once
#include <suture/base/Types.hpp>

#include <vector>

namespace suture {

/// A dense symmetric matrix of which little more than the lower triangle is kept: panels of four columns each, from their diagonal block
/// (whole) downwards. A product reads it once and is as fast as memory is. In single precision half of that, for what need not be exact: a
/// preconditioner. Local; a product uses work space of its own, so that one object serves one thread.
class PackedSymmetric {
 public:
  enum class Precision { Double, Single };

  PackedSymmetric() = default;
  /// \param matrix  its lower triangle is read
  explicit PackedSymmetric(const Matrix& matrix, Precision precision = Precision::Double);
  /// In single precision, what is already.
  explicit PackedSymmetric(const Eigen::MatrixXf& matrix);

  int size() const { return size_; }
  double bytes() const { return static_cast<double>(sizeof(double) * values_.size() + sizeof(float) * singles_.size()); }
  /// y <- A x, for several right-hand sides at once.
  void multiply(ConstLocalView x, LocalView y) const;
  Matrix full() const;
  /// A(positions, positions).
  Matrix block(const std::vector<int>& positions) const;

 private:
  template <typename Real>
  struct Work {
    Eigen::Matrix<Real, Eigen::Dynamic, 1> x, y;
  };

  template <typename Real>
  void multiply(const std::vector<Real>& values, Work<Real>& work, ConstLocalView x, LocalView y) const;
  double at(int row, int column) const;

  int size_ = 0;
  std::vector<double> values_;  // one of the two
  std::vector<float> singles_;
  mutable Work<double> double_;
  mutable Work<float> single_;
};

}  // namespace suture
