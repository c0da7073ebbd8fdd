#pragma once
#include <suture/interface/InterfaceOperator.hpp>
#include <suture/precond/coarse/DirectCoarse.hpp>

#include <memory>
#include <vector>

namespace suture {

/// The coarse problem of balancing: E = Z^T S Z for columns Z with local support, a DirectCoarse.
///
/// Columns of different local problems may be linearly dependent (two subdomains that share one edge have the same D_i Z_i there). Then E
/// is singular, and its solution is unique up to combinations n with Z n = 0, which do not change any trace.
class BalancingCoarse {
 public:
  /// \param columns  traces of each local problem of this rank: size() x k, orthonormal. Collective. \throws NumericalError
  /// \param copies  see DirectCoarse
  BalancingCoarse(const InterfaceOperator& matrix, const std::vector<Matrix>& columns, std::unique_ptr<LocalSolver> solver, int copies);

  int size() const { return size_; }
  // Coefficients y belong to the columns that are nonzero on this rank's local problems, see DirectCoarse::names.
  /// E^-1 Z^T r, kept until the next solve. `r`: overlap values. Collective.
  const Vector& fromResidual(const Matrix& overlap) const;
  /// E^-1 (S Z)^T t, kept until the next solve. `t`: overlap values. Collective.
  const Vector& fromTrace(const Matrix& overlap) const;
  /// overlap += Z y, this rank's part of the sum over ranks. Local.
  void addColumns(const Vector& y, Matrix& overlap) const;
  /// overlap += S Z y, this rank's part of the sum over ranks. Local.
  void addImages(const Vector& y, Matrix& overlap) const;

 private:
  void exchange(const std::vector<Matrix>& columns);
  void assemble(const InterfaceOperator& matrix, std::unique_ptr<LocalSolver> solver, int copies);

  std::shared_ptr<const InterfaceSpace> space_;
  int size_ = 0, coefficients_ = 0;
  std::vector<Matrix> columns_;            // own columns of each local problem
  std::vector<int> firstColumn_;           // number of its first column; after assemble() its place among the coefficients
  std::vector<Matrix> seen_, images_;      // columns V that are nonzero on each local problem, and S V
  std::vector<std::vector<int>> seenIds_;  // numbers of these columns; after assemble() their places among the coefficients
  std::unique_ptr<DirectCoarse> system_;
  mutable Matrix trace_;  // work space for any local problem
  mutable Vector part_, mine_;
};

}  // namespace suture
