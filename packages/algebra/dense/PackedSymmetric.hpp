#pragma once
#include <suture/algebra/dense/AlignedVector.hpp>
#include <suture/base/Types.hpp>

#include <vector>

namespace suture {

/// A dense symmetric matrix of which little more than the lower triangle is stored: panels of four columns each, from their diagonal block
/// (stored in full) downwards, with the columns interleaved by cache lines. A product reads memory once, sequentially, and is limited only
/// by memory bandwidth. Single precision halves that, for operators that need not be exact: preconditioners. Local; const access is
/// thread-safe.
class PackedSymmetric {
 public:
  enum class Precision { Double, Single };

  PackedSymmetric() = default;
  /// \param matrix  its lower triangle is read
  explicit PackedSymmetric(const Matrix& matrix, Precision precision = Precision::Double);
  /// From a matrix already in single precision. \param factor  of the matrix: a power of two that may exceed the range of single precision
  explicit PackedSymmetric(const Eigen::MatrixXf& matrix, double factor = 1.0);

  int size() const { return size_; }
  double bytes() const { return static_cast<double>(sizeof(double) * values_.size() + sizeof(float) * singles_.size()); }
  /// y <- A x, for several right-hand sides at once.
  void multiply(ConstLocalView x, LocalView y) const;
  Matrix full() const;
  /// A(positions, positions).
  Matrix block(const std::vector<int>& positions) const;

 private:
  template <typename Real>
  void multiply(const AlignedVector<Real>& values, ConstLocalView x, LocalView y) const;
  double at(int row, int column) const;

  int size_ = 0;
  double factor_ = 1.0;           // times the values kept
  AlignedVector<double> values_;  // one of the two
  AlignedVector<float> singles_;
};

}  // namespace suture
