#pragma once
#include <suture/algebra/dense/SymmetricMatrix.hpp>
#include <suture/base/Types.hpp>

#include <vector>

namespace suture {

/// A Cholesky factor in single precision, with half the memory of the original. It is used as preconditioner of conjugate gradients in
/// double precision, which restore full accuracy: two or three steps if the factor is nearly the inverse, a few more if stiffness jumps by
/// many orders of magnitude. Factor and loads are scaled by powers of two before conversion, so that all values stay within the narrow
/// range of single precision in any units. Local, const.
class SingleFactor {
 public:
  SingleFactor() = default;
  /// \param unknownOf  column of L -> unknown of the matrix passed to solve(); unknowns that do not occur are held at zero
  explicit SingleFactor(std::vector<int> unknownOf) : unknownOf_(std::move(unknownOf)) {}

  /// Number of values of a supernode of `columns` columns with `below` rows below its triangle.
  static std::size_t entries(int columns, int below) {
    return static_cast<std::size_t>(columns) * (columns + 1) / 2 + static_cast<std::size_t>(columns) * below;
  }
  /// Reserves memory for all supernodes, to avoid copies while they are appended. \param rows, entries  sums over the supernodes
  void reserve(std::size_t supernodes, std::size_t rows, std::size_t entries);
  /// Appends the next supernode: columns that share their pattern, a lower triangle and the dense rows below it. The last one completes L.
  /// \param below   numbers of the rows below the triangle
  /// \param values  by columns, `stride` apart: the triangle, then the rows
  void append(int first, int columns, const std::vector<int>& below, const double* values, int stride);

  /// x <- A_II^-1 x for the unknowns I of the factor; other entries are not read and become zero. x has the size of the matrix. Relative
  /// residual 1e-15 in the norm of the preconditioner. \throws NumericalError  if not reached in 200 steps
  void solve(const SymmetricMatrix& matrix, Vector& x) const;

  /// z <- A_II^-1 r by the factor alone, to single precision; entries of other unknowns are not read and become zero. r and z may be the
  /// same. Several right-hand sides share passes over the factor. For preconditioners.
  void apply(ConstLocalView r, LocalView z) const;

  /// Turns the factor of a block into one of the matrix from which the block was taken. \param numbers  unknown of the block -> unknown of
  /// the matrix
  void renumber(const std::vector<int>& numbers) {
    for (int& unknown : unknownOf_) unknown = numbers[unknown];
  }

  double bytes() const { return static_cast<double>(sizeof(float) * values_.size() + sizeof(int) * rows_.size()); }

 private:
  void iterate(const SymmetricMatrix& matrix, Vector& r, Vector& x) const;
  template <int columns>
  void substitute(float* y, float* work) const;
  template <int columns>
  void applyTo(ConstLocalView r, LocalView z) const;

  struct Supernode {
    int first, columns, below;
    std::size_t rows, values;  // offsets of its rows and values
  };

  std::vector<Supernode> supernodes_;
  std::vector<int> rows_;
  std::vector<float> values_;  // columns of each supernode, from the reciprocal of the diagonal entry downwards
  std::vector<int> unknownOf_;
  double scale_ = 0.0;  // power of two by which `values_` are divided; zero: no supernode yet
  int mostRows_ = 0;
};

}  // namespace suture
