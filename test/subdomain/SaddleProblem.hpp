#pragma once
#include <suture/subdomain/LocalProblem.hpp>

#include <Eigen/LU>
#include <cmath>
#include <random>

/// The saddle problem of BDDC by dense algebra, for tests of its inverses.
namespace suture::saddle {

inline Matrix random(int rows, int columns, unsigned seed) {
  std::mt19937 generator(seed);
  Matrix values(rows, columns);
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) values(i, j) = generator() / 2147483647.5 - 1.0;
  return values;
}

// Symmetric, semidefinite, with a kernel of the given dimension, its diagonal over some orders of magnitude as with a jump of stiffness.
inline Matrix semidefinite(int n, int kernel, double orders = 4.0) {
  Matrix root = random(n, n - kernel, 3);
  for (int i = 0; i < n; ++i) root.row(i) *= std::pow(10.0, 0.5 * orders * i / n);
  return root * root.transpose();
}

// Units (corners), averages along stretches, and one row that overlaps a unit and a stretch, not of length one.
inline Matrix rows(int n) {
  Matrix c = Matrix::Zero(5, n);
  c.block(0, 0, 1, 4).setConstant(0.5);
  c(1, 2) = 1.0;
  c(2, n - 1) = 1.0;
  c.row(3).segment(5, 4) << 1.0, -2.0, 3.0, 0.5;
  c.row(4).segment(3, 5) << 4.0, 1.0, 1.0, -1.0, 2.0;
  return c;
}

// As one dense system, solved by elimination with full pivoting.
struct Saddle {
  Matrix inverse, basis, energy;
  Saddle(const Matrix& s, const Matrix& c) {
    const int n = int(s.rows()), m = int(c.rows());
    Matrix kkt = Matrix::Zero(n + m, n + m);
    kkt << s, c.transpose(), c, Matrix::Zero(m, m);
    const Matrix x = Eigen::FullPivLU<Matrix>(kkt).inverse();
    inverse = x.topLeftCorner(n, n);
    basis = x.topRightCorner(n, m);
    energy = -x.bottomRightCorner(m, m);
  }
};

inline Matrix applied(const LocalInverse& inverse, const Matrix& flux) {
  Matrix trace(flux.rows(), flux.cols());
  inverse.apply(flux, trace);
  return trace;
}

// What a user writes: apply(), and a basis or none.
struct Given : LocalInverse {
  Matrix phi;
  void apply(ConstLocalView flux, LocalView trace) const override { trace = flux; }
  Matrix basis() const override { return phi; }
};

}  // namespace suture::saddle
