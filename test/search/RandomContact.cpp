#include <search/RandomContact.hpp>

namespace suture {

RandomContact::RandomContact(unsigned seed) {
  std::mt19937_64 engine(seed);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  const auto number = [&](int least, int most) { return least + static_cast<int>(uniform() * (most - least + 1)); };
  const int n = number(1, 10), motions = number(0, 3);
  const int rank = uniform() < 0.3 ? number(1, n) : n;
  const Matrix factor = Matrix::NullaryExpr(n, rank, [&] { return uniform() - 0.5; });
  const double size = std::pow(10.0, number(-6, 6));
  compliance = size * (factor * factor.transpose());
  compliance.diagonal().array() += size * (uniform() < 0.5 ? 0.1 : 1e-6);
  Matrix rows = Matrix::NullaryExpr(n, motions, [&] { return uniform() < 0.2 ? 0.0 : 2.0 * uniform() - 1.0; });
  if (n > 1 && uniform() < 0.3) {  // two identical pairs
    rows.row(n - 1) = rows.row(0);
    compliance.row(n - 1) = compliance.row(0);
    compliance.col(n - 1) = compliance.col(0);
    compliance(n - 1, n - 1) = compliance(0, 0);
  }
  pairs.rows = rows.sparseView();
  const Vector carried = Vector::NullaryExpr(n, [&] { return uniform() < 0.4 ? 0.0 : uniform(); });
  pairs.work = uniform() < 0.1 ? Vector(Vector::Zero(motions)) : Vector(pairs.rows.transpose() * carried);
  const double gap = size * std::pow(10.0, number(-3, 4));
  open = Vector::NullaryExpr(n, [&] { return uniform() < 0.2 ? 0.0 : gap * (uniform() - 0.7); });
  pairs.penetration = open;
  pairs.stiffness = 2.0 * compliance.diagonal().cwiseInverse();
  pairs.line.assign(n, 0);
  pairs.canChange.assign(n, 1);
}

}  // namespace suture
