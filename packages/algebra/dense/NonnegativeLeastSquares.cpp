#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/algebra/dense/NonnegativeLeastSquares.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

Vector nonnegativeLeastSquares(const Matrix& a, const Vector& b) {
  const Eigen::Index n = a.cols();
  Vector p = Vector::Zero(n);
  std::vector<int> passive;
  std::vector<char> isPassive(n, 0);
  const double size = a.size() > 0 ? a.colwise().norm().maxCoeff() : 0.0;
  // Each round adds the column with the largest gradient; every inner step drops at least one column. As the residual falls, no set of
  // columns repeats.
  for (Eigen::Index round = 0; round < 3 * n + 30; ++round) {
    const Vector residual = b - a * p, pull = a.transpose() * residual;
    Eigen::Index best = -1;
    double most = 1e-13 * size * b.norm();
    for (Eigen::Index i = 0; i < n; ++i)
      if (!isPassive[i] && pull[i] > most) {
        most = pull[i];
        best = i;
      }
    if (best < 0) break;
    passive.push_back(int(best));
    isPassive[best] = 1;
    while (!passive.empty()) {
      const Vector trial = leastSquares(a(Eigen::all, passive), b);
      if (trial.minCoeff() > 0) {
        for (std::size_t i = 0; i < passive.size(); ++i) p[passive[i]] = trial[Eigen::Index(i)];
        break;
      }
      double step = 1.0;
      for (std::size_t i = 0; i < passive.size(); ++i)
        if (trial[Eigen::Index(i)] <= 0) step = std::min(step, p[passive[i]] / (p[passive[i]] - trial[Eigen::Index(i)]));
      if (!std::isfinite(step)) step = 0.0;
      std::vector<int> kept;
      for (std::size_t i = 0; i < passive.size(); ++i) {
        const int column = passive[i];
        const double value = p[column] + step * (trial[Eigen::Index(i)] - p[column]);
        if (value <= 1e-14 * p.cwiseAbs().maxCoeff() || (trial[Eigen::Index(i)] <= 0 && value <= 0)) {
          p[column] = 0.0;
          isPassive[column] = 0;
        } else {
          p[column] = value;
          kept.push_back(column);
        }
      }
      if (kept.size() == passive.size()) break;
      passive = std::move(kept);
    }
  }
  return p;
}

Vector leastDistance(const Matrix& a, const Vector& b) {
  const Eigen::Index k = a.cols(), rows = a.rows();
  if (rows == 0 || !(b.maxCoeff() > 0.0)) return Vector::Zero(k);
  const double scale = b.cwiseAbs().maxCoeff();
  Matrix e(k + 1, rows);
  e << a.transpose(), (b / scale).transpose();
  const Vector f = Vector::Unit(k + 1, k), r = e * nonnegativeLeastSquares(e, f) - f;
  if (!(r(k) < -1e-12)) return Vector::Zero(k);
  return scale * (-r.head(k) / r(k));
}

}  // namespace suture
