#pragma once
#include <suture/algebra/LocalInverse.hpp>

#include <support/DenseAlgebra.hpp>

/// The saddle problem of BDDC by dense algebra, for tests of its inverses.
namespace suture::saddle {

using dense::random;

// Symmetric, semidefinite, with a kernel of the given dimension; its diagonal varies over some orders of magnitude, as with a jump of
// stiffness.
Matrix semidefinite(int n, int kernel, double orders = 4.0);

// Units (corners), averages along stretches, and one row, not of unit length, that overlaps a unit and a stretch.
Matrix rows(int n);

// Solved as one dense system by elimination with full pivoting.
struct Saddle {
  Matrix inverse, basis, energy;
  Saddle(const Matrix& s, const Matrix& c);
};

Matrix applied(const LocalInverse& inverse, const Matrix& flux);

// A user's LocalInverse: apply(), with or without a basis.
struct Given : LocalInverse {
  Matrix phi;
  void apply(ConstLocalView flux, LocalView trace) const override { trace = flux; }
  Matrix basis() const override { return phi; }
};

}  // namespace suture::saddle
