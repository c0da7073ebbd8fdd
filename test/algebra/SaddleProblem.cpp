#include <algebra/SaddleProblem.hpp>
#include <cmath>

namespace suture::saddle {

Matrix semidefinite(int n, int kernel, double orders) {
  Matrix root = random(n, n - kernel, 3);
  for (int i = 0; i < n; ++i) root.row(i) *= std::pow(10.0, 0.5 * orders * i / n);
  return root * root.transpose();
}

Matrix rows(int n) {
  Matrix c = Matrix::Zero(5, n);
  c.block(0, 0, 1, 4).setConstant(0.5);
  c(1, 2) = 1.0;
  c(2, n - 1) = 1.0;
  c.row(3).segment(5, 4) << 1.0, -2.0, 3.0, 0.5;
  c.row(4).segment(3, 5) << 4.0, 1.0, 1.0, -1.0, 2.0;
  return c;
}

Saddle::Saddle(const Matrix& s, const Matrix& c) {
  const int n = int(s.rows()), m = int(c.rows());
  Matrix kkt = Matrix::Zero(n + m, n + m);
  kkt << s, c.transpose(), c, Matrix::Zero(m, m);
  const Matrix x = dense::inverse(kkt);
  inverse = x.topLeftCorner(n, n);
  basis = x.topRightCorner(n, m);
  energy = -x.bottomRightCorner(m, m);
}

Matrix applied(const LocalInverse& inverse, const Matrix& flux) {
  Matrix trace(flux.rows(), flux.cols());
  inverse.apply(flux, trace);
  return trace;
}

}  // namespace suture::saddle
