#pragma once
#include <suture/algebra/SparseMatrix.hpp>

#include <type_traits>
#include <utility>

namespace suture {

/// A symmetric sparse matrix of which the lower triangle is stored: half the memory of a SparseMatrix. Used for stiffness matrices, which
/// are kept until interiors are recovered. Local.
class SymmetricMatrix {
 public:
  SymmetricMatrix() = default;
  /// Keeps the lower triangle; entries above it are not read and may be absent.
  /// \param matrix  square, compressed, rows ascending in each column
  explicit SymmetricMatrix(SparseMatrix&& matrix);
  explicit SymmetricMatrix(const SparseMatrix& matrix) : SymmetricMatrix(SparseMatrix(matrix)) {}

  SymmetricMatrix(const SymmetricMatrix&) = default;
  SymmetricMatrix& operator=(const SymmetricMatrix&) = default;
  // Eigen 3.4 copies sparse matrices where they could be moved.
  SymmetricMatrix(SymmetricMatrix&& other) noexcept { swap(other); }
  SymmetricMatrix& operator=(SymmetricMatrix&& other) noexcept {
    swap(other);
    return *this;
  }

  int rows() const { return static_cast<int>(lower_.rows()); }
  int cols() const { return rows(); }
  const SparseMatrix& lower() const { return lower_; }
  Vector diagonal() const { return lower_.diagonal(); }
  /// Entries of both triangles.
  Eigen::Index nonZeros() const { return nonZeros_; }

  /// Both triangles, rebuilt at each call, for eliminations and for extracting blocks.
  SparseMatrix full() const;
  Matrix dense() const { return Matrix(full()); }

  /// A x for one or several vectors x.
  template <typename Columns>
  auto operator*(const Eigen::MatrixBase<Columns>& x) const {
    return std::conditional_t<Columns::ColsAtCompileTime == 1, Vector, Matrix>(lower_.selfadjointView<Eigen::Lower>() * x);
  }

 private:
  void swap(SymmetricMatrix& other) noexcept {
    lower_.swap(other.lower_);
    std::swap(nonZeros_, other.nonZeros_);
  }

  SparseMatrix lower_;
  Eigen::Index nonZeros_ = 0;
};

}  // namespace suture
