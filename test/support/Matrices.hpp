#pragma once
#include <suture/base/Types.hpp>

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <random>
#include <vector>

/// Sparse matrices for tests of factorisations, written from formulas, and the dense algebra that they are compared with.
namespace suture::matrices {

using Sparse = Eigen::SparseMatrix<double>;

// Bilinear squares of an elastic body (both Lame constants 1), written here from the formulas: nodes (nx+1) x (ny+1), nothing held; its
// kernel are the three rigid modes. Scaled by 24 all entries are whole numbers, so that translations are in the kernel without rounding.
inline Sparse floatingBody(int nx, int ny) {
  const double g = std::sqrt(1.0 / 3.0);  // two-point Gauss quadrature
  Eigen::Matrix3d d;
  d << 3, 1, 0, 1, 3, 0, 0, 0, 1;
  Eigen::Matrix<double, 8, 8> k = Eigen::Matrix<double, 8, 8>::Zero();
  const double sx[4] = {-1, 1, 1, -1}, sy[4] = {-1, -1, 1, 1};
  for (double x : {-g, g})
    for (double y : {-g, g}) {
      Eigen::Matrix<double, 3, 8> b = Eigen::Matrix<double, 3, 8>::Zero();
      for (int a = 0; a < 4; ++a) {
        const double dx = sx[a] * (1 + sy[a] * y) / 2, dy = sy[a] * (1 + sx[a] * x) / 2;
        b(0, 2 * a) = b(2, 2 * a + 1) = dx;
        b(1, 2 * a + 1) = b(2, 2 * a) = dy;
      }
      k += b.transpose() * d * b / 4;
    }
  k = (24 * k).array().round();
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int n = j * (nx + 1) + i, nodes[4] = {n, n + 1, n + nx + 2, n + nx + 1};
      for (int r = 0; r < 8; ++r)
        for (int s = 0; s < 8; ++s) entries.emplace_back(2 * nodes[r / 2] + r % 2, 2 * nodes[s / 2] + s % 2, k(r, s));
    }
  Sparse a(2 * (nx + 1) * (ny + 1), 2 * (nx + 1) * (ny + 1));
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

// Where its nodes are, of each unknown.
inline std::vector<Point> placesOfBody(int nx, int ny) {
  std::vector<Point> places;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) places.insert(places.end(), 2, Point{double(i), double(j), 0.0});
  return places;
}

// Of unknowns that are nowhere in particular.
inline std::vector<Point> randomPlaces(int n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<Point> places(n);
  for (Point& place : places) place = {value(random), value(random), value(random)};
  return places;
}

inline Sparse randomDefinite(int n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<Eigen::Triplet<double>> entries;
  for (int e = 0; e < 3 * n; ++e) {
    const int i = int(random() % n), j = int(random() % n);
    const double v = value(random);
    entries.emplace_back(i, j, v);
    entries.emplace_back(j, i, v);
    entries.emplace_back(i, i, 2 * std::abs(v));  // diagonally dominant
    entries.emplace_back(j, j, 2 * std::abs(v));
  }
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, 0.1);
  Sparse a(n, n);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

inline Matrix denseSchur(const Matrix& a, int trailing) {
  const int n = int(a.rows()), i = n - trailing;
  return a.bottomRightCorner(trailing, trailing) -
         a.bottomLeftCorner(trailing, i) * a.topLeftCorner(i, i).ldlt().solve(a.topRightCorner(i, trailing));
}

inline double difference(const Matrix& a, const Matrix& b) { return (a - b).norm() / b.norm(); }

}  // namespace suture::matrices
