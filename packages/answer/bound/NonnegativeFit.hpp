#pragma once
#include <Eigen/SparseCore>
#include <suture/base/Types.hpp>

namespace suture {

/// The nearest solution of linear equations within limits, nonnegative by default:
///   min  1/2 sum_i w_i (x_i - s_i)^2,   C x = b,   0 <= x, or lowest <= x <= highest.
struct NonnegativeProblem {
  Eigen::SparseMatrix<double> columns;  ///< C, equations x unknowns; few equations per unknown
  Vector weights;                       ///< w > 0
  Vector start;                         ///< s
  Vector targets;                       ///< b
  Vector lowest = {};                   ///< empty: zero; otherwise numbers or -infinity
  Vector highest = {};                  ///< empty: none; otherwise numbers or infinity, above the lowest values
};

struct NonnegativeSolution {
  Vector values;           ///< x within its limits
  Vector misfit;           ///< b - C x
  int steps = 0;           ///< Newton steps
  bool converged = false;  ///< max |b - C x| <= 1e-13 max |b|
};

/// Solves the dual problem, x = s + W^-1 C^T y cut off at the limits with C x(y) = b, by a semismooth Newton method: each matrix C S C^T is
/// factored by a sparse Cholesky factorisation; line searches on the convex dual function make the method converge from y = 0. Equations
/// may be linearly dependent. If no x within the limits solves the equations, y grows without bound; the search ends as soon as y proves
/// that there is no solution, and `converged` is false. Deterministic. Local.
NonnegativeSolution nonnegativeFit(const NonnegativeProblem& problem);

}  // namespace suture
