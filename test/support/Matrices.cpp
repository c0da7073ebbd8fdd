#include <support/Matrices.hpp>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace suture::matrices {

Sparse floatingBody(int nx, int ny) {
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

std::vector<Point> placesOfBody(int nx, int ny) {
  std::vector<Point> places;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) places.insert(places.end(), 2, Point{double(i), double(j), 0.0});
  return places;
}

std::vector<Point> randomPlaces(int n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<Point> places(n);
  for (Point& place : places) place = {value(random), value(random), value(random)};
  return places;
}

Sparse randomDefinite(int n, unsigned seed) {
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

Matrix rows(std::initializer_list<std::initializer_list<double>> values) {
  Matrix all(values.size(), values.begin()->size());
  Eigen::Index i = 0;
  for (const auto& row : values) {
    Eigen::Index j = 0;
    for (const double value : row) all(i, j++) = value;
    ++i;
  }
  return all;
}

}  // namespace suture::matrices
