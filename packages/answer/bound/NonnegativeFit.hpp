#pragma once
#include <Eigen/SparseCore>
#include <suture/base/Types.hpp>

namespace suture {

/// The nearest nonnegative solution of linear equations:
///   min  1/2 sum_i w_i (x_i - s_i)^2,   C x = b,   x >= 0.
struct NonnegativeProblem {
  Eigen::SparseMatrix<double> columns;  ///< C, equations x unknowns; few equations per unknown
  Vector weights;                       ///< w > 0
  Vector start;                         ///< s
  Vector targets;                       ///< b
};

struct NonnegativeSolution {
  Vector values;           ///< x >= 0
  Vector misfit;           ///< b - C x
  int steps = 0;           ///< Newton steps
  bool converged = false;  ///< max |b - C x| <= 1e-13 max |b|
};

/// Solves the dual problem, x = max(0, s + W^-1 C^T y) with C x(y) = b, by a semismooth Newton method: each matrix C S C^T is factored by a
/// sparse Cholesky factorisation; line searches on the convex dual function make the method converge from y = 0. Equations may be linearly
/// dependent. If no x >= 0 solves the equations, y grows without bound; the search ends as soon as y proves that there is no solution, and
/// `converged` is false. Deterministic. Local.
NonnegativeSolution nonnegativeFit(const NonnegativeProblem& problem);

}  // namespace suture
