#pragma once
#include <suture/elasticity/StressVector.hpp>

#include <algorithm>

namespace suture {

/// Weights with which a law acts on products of gradients in 3D: block (a, b) of an element's stiffness is
/// K_ij = sum over k, l of C_ikjl S_kl, S = integral of grad N_a (grad N_b)^T, C the law as a tensor of fourth order.
struct ProductWeights {
  bool isotropic = true;
  double lambda = 0.0, mu = 0.0;          ///< K = lambda S + mu S^T + mu tr(S) I
  Eigen::Matrix<double, 9, 9> general{};  ///< rows: entries of K, columns: entries of S, both column by column

  ProductWeights() = default;
  explicit ProductWeights(const StressMatrix<3>& law) {
    lambda = law(0, 1);
    mu = law(3, 3);
    StressMatrix<3> same = StressMatrix<3>::Zero();
    same.topLeftCorner<3, 3>().setConstant(lambda);
    same.diagonal().head<3>().array() += 2.0 * mu;
    same.diagonal().tail<3>().setConstant(mu);
    isotropic = (law - same).cwiseAbs().maxCoeff() <= 1e-15 * law.cwiseAbs().maxCoeff();
    if (isotropic) return;
    constexpr int component[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};  // stress component of a pair of axes
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l) general(i + 3 * j, k + 3 * l) = law(component[i][k], component[j][l]);
  }
};

/// Integrals over a 3D element of the products of its shape functions' gradients, independent of the law: 9 products per pair of nodes and
/// point, half of what B^T D B needs. \tparam nodes  of the element
template <int nodes>
class GradientProducts {
 public:
  static constexpr int n = 3 * nodes;
  static constexpr int rows = (n + 3) / 4 * 4;  ///< rows of the storage, padded to packets of four

  /// \param storage  room for rows x n numbers
  explicit GradientProducts(double* storage) : s_(storage) { std::fill_n(s_, rows * n, 0.0); }

  /// Adds the products at a point, in the blocks a <= b. \param gradients  nodes x 3
  void add(double measure, const double* gradients) {
    using Packet = Eigen::Matrix<double, 4, 1>;  // explicit, because the compiler does not vectorise the scalar loop
    double g[rows];
    std::copy_n(gradients, n, g);
    std::fill(g + n, g + rows, 0.0);
    for (int b = 0; b < nodes; ++b) {
      const double x = measure * g[3 * b], y = measure * g[3 * b + 1], z = measure * g[3 * b + 2];
      double* column = s_ + rows * 3 * b;
      const double* const end = column + 3 * b + 3;  // the diagonal
      for (const double* own = g; column < end; own += 4, column += 4) {
        const Packet packet = Eigen::Map<const Packet>(own);
        Eigen::Map<Packet>(column) += x * packet;
        Eigen::Map<Packet>(column + rows) += y * packet;
        Eigen::Map<Packet>(column + 2 * rows) += z * packet;
      }
    }
  }

  /// Sets a stiffness matrix, exactly symmetric. \param k  n x n, column by column
  void contract(const ProductWeights& law, double* k) const {
    using Products = Eigen::Map<const Eigen::Matrix3d, 0, Eigen::OuterStride<rows>>;
    using Block = Eigen::Map<Eigen::Matrix3d, 0, Eigen::OuterStride<n>>;
    for (int b = 0; b < nodes; ++b)
      for (int a = 0; a <= b; ++a) {
        const Products s(s_ + rows * 3 * b + 3 * a);
        Eigen::Matrix3d own;
        if (law.isotropic) {
          own = law.lambda * s + law.mu * s.transpose();
          own.diagonal().array() += law.mu * s.trace();
        } else {
          const Eigen::Matrix3d products = s;
          Eigen::Map<Eigen::Matrix<double, 9, 1>>(own.data()) =
              law.general * Eigen::Map<const Eigen::Matrix<double, 9, 1>>(products.data());
        }
        Block(k + n * 3 * b + 3 * a) = own;
        if (a == b)  // round-off of the two halves differs
          Block(k + n * 3 * b + 3 * b).template triangularView<Eigen::StrictlyLower>() = own.transpose();
        else
          Block(k + n * 3 * a + 3 * b) = own.transpose();
      }
  }

 private:
  double* s_;
};

}  // namespace suture
