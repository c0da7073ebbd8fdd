#include <array>
#include <suture/answer/bound/SimplexBasis.hpp>
#include <suture/base/Errors.hpp>

namespace suture {

namespace {

constexpr int kEdges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};

double factorial(int n) { return n < 2 ? 1.0 : n * factorial(n - 1); }

/// Mean value over a simplex of dimension S of the product of the barycentric coordinates with the given indices.
template <int S, std::size_t N>
double meanOfProduct(const std::array<int, N>& indices) {
  std::array<int, S + 1> powers{};
  for (const int i : indices) ++powers[i];
  double mean = factorial(S) / factorial(S + int(N));
  for (const int power : powers) mean *= factorial(power);
  return mean;
}

}  // namespace

template <int S>
SimplexBasis<S>::SimplexBasis(int degree) : degree_(degree) {
  if (degree != 1 && degree != 2) throw InternalError("SimplexBasis: degree " + std::to_string(degree) + ", expected 1 or 2");
  places_.setZero(S + 1, nodes(degree));
  for (int i = 0; i <= S; ++i) places_(i, i) = 1.0;
  for (int node = S + 1; node < places_.cols(); ++node)
    for (const int end : kEdges[node - S - 1]) places_(end, node) = 0.5;
}

template <int S>
Vector SimplexBasis<S>::values(const Barycentric& point) const {
  if (degree_ == 1) return point;
  Vector result(nodes());
  for (int i = 0; i <= S; ++i) result(i) = point(i) * (2 * point(i) - 1);
  for (int node = S + 1; node < nodes(); ++node) result(node) = 4 * point(kEdges[node - S - 1][0]) * point(kEdges[node - S - 1][1]);
  return result;
}

template <int S>
Matrix SimplexBasis<S>::derivatives(const Barycentric& point) const {
  if (degree_ == 1) return Matrix::Identity(S + 1, S + 1);
  Matrix result = Matrix::Zero(nodes(), S + 1);
  for (int i = 0; i <= S; ++i) result(i, i) = 4 * point(i) - 1;
  for (int node = S + 1; node < nodes(); ++node) {
    const auto [from, to] = kEdges[node - S - 1];
    result(node, from) = 4 * point(to);
    result(node, to) = 4 * point(from);
  }
  return result;
}

template <int S>
Matrix SimplexBasis<S>::mass() const {
  if (degree_ == 1) {
    Matrix result(S + 1, S + 1);
    for (int i = 0; i <= S; ++i)
      for (int j = 0; j <= S; ++j) result(i, j) = meanOfProduct<S, 2>({i, j});
    return result;
  }
  // The products a b of two barycentric coordinates, numbered as the nodes; a vertex function is a a minus the products of a with others.
  const int n = nodes();
  Matrix products(n, n), functions = Matrix::Identity(n, n);
  const auto factors = [](int node) {
    return node <= S ? std::array<int, 2>{node, node} : std::array<int, 2>{kEdges[node - S - 1][0], kEdges[node - S - 1][1]};
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) products(i, j) = meanOfProduct<S, 4>({factors(i)[0], factors(i)[1], factors(j)[0], factors(j)[1]});
  for (int node = S + 1; node < n; ++node) {
    functions(node, node) = 4.0;
    for (const int end : factors(node)) functions(node, end) = -1.0;
  }
  return functions.transpose() * products * functions;
}

template class SimplexBasis<1>;
template class SimplexBasis<2>;
template class SimplexBasis<3>;

}  // namespace suture
