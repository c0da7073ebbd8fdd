#pragma once
#include <suture/base/Types.hpp>
#include <suture/subdomain/SparseMatrix.hpp>

#include <vector>

namespace suture {

/// A Cholesky factor in single precision, half the memory of the original. It is used as preconditioner of conjugate gradients in double
/// precision, which gives back what rounding took: two or three steps where it is nearly the inverse, a few more where stiffness jumps
/// by many orders of magnitude; the accuracy does not depend on it. Local, const.
class SingleFactor {
 public:
  /// Columns that share their pattern: a lower triangle `columns` wide, and the dense rows below it.
  struct Supernode {
    int first = 0, columns = 0;
    std::vector<int> below;     // numbers of the rows under the triangle
    std::vector<float> values;  // by columns, (columns + below) x columns
  };

  SingleFactor() = default;
  /// \param unknownOf  column of L -> unknown of the matrix that solve() is given; unknowns that do not occur are held at zero
  SingleFactor(std::vector<Supernode> supernodes, std::vector<int> unknownOf);

  /// x <- A_II^-1 x for the unknowns of the factor, I; entries of the others are not read and become zero. x has the size of the matrix.
  /// Relative residual 1e-15 in the norm of the preconditioner. \throws NumericalError  not reached in 200 steps
  void solve(const SparseMatrix& matrix, Vector& x) const;

  double bytes() const { return bytes_; }

 private:
  void precondition(const Vector& r, Vector& z) const;

  std::vector<Supernode> supernodes_;
  std::vector<int> unknownOf_;
  int mostBelow_ = 0;
  double bytes_ = 0.0;
};

}  // namespace suture
