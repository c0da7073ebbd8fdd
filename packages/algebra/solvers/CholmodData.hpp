#pragma once
#include <suture/algebra/CholmodFactor.hpp>
#include <suture/algebra/CholmodHandle.hpp>
#include <suture/algebra/elimination/PivotCheck.hpp>

#include <vector>

namespace suture {

/// A CHOLMOD factor: factorisation in CholmodFactor.cpp, substitutions in CholmodSolves.cpp.
struct CholmodFactor::Data : CholmodHandle {
  void order(const Eigen::SparseMatrix<double>& matrix, CholmodOptions::Ordering ordering);
  void factorise(const Eigen::SparseMatrix<double>& matrix, const CholmodOptions& options);
  void judgePivots(const Vector& diagonal, PivotCheck& check);

  double pivot(int column) const;
  void forward(int upTo, Eigen::Ref<Matrix> x) const;
  void backward(int upTo, Eigen::Ref<Matrix> x) const;
  void solve(int upTo, LocalView rhs) const;

  // Supernode s, restricted to columns and rows below a limit.
  struct Supernode {
    int first, columns, rows;
    const double* values;
    int stride;
    const int* below;  // row numbers below the diagonal block
  };
  Supernode supernode(int s, int upTo) const;

  std::vector<int> permutation;  // column of L -> dof
  std::vector<int> columnSupernode;
  int mostRows = 0;  // rows of the largest supernode
  Vector shift;
  Statistics statistics;
};

}  // namespace suture
