#pragma once
#include <interface/DenseSpace.hpp>
#include <support/Blocks.hpp>
#include <suture/precond/Preconditioner.hpp>

#include <Eigen/Dense>

namespace suture::blocks {

/// S and M^-1 as dense matrices on the unknowns that are not idle; the same on any number of ranks.
struct DensePair {
  Matrix s, m;
  /// Collective.
  DensePair(const InterfaceOperator& matrix, const Preconditioner& preconditioner) {
    const DenseSpace all(*matrix.space());
    s = all.dense(static_cast<const Operator&>(matrix));
    m = all.dense(static_cast<const Operator&>(preconditioner));
    std::vector<int> used;
    for (int i = 0; i < s.rows(); ++i)
      if (s(i, i) > 0.0) used.push_back(i);
    idle = m.norm() - rowsAt(rowsAt(m, used).transpose(), used).norm();
    s = rowsAt(rowsAt(s, used).transpose(), used);
    m = rowsAt(rowsAt(m, used).transpose(), used);
  }
  double idle;  ///< what M^-1 does to idle unknowns

  /// Of M^-1 S, ascending: those of L^T M^-1 L, S = L L^T.
  Vector eigenvalues() const {
    const Matrix l = Eigen::LLT<Matrix>(0.5 * (s + s.transpose())).matrixL();
    const Matrix product = l.transpose() * m * l;
    return Eigen::SelfAdjointEigenSolver<Matrix>(0.5 * (product + product.transpose())).eigenvalues();
  }
};

}  // namespace suture::blocks
