#pragma once
#include <suture/elasticity/StressVector.hpp>

#include <array>

namespace suture {

/// Weights with which a law acts on products of gradients in space: block (a, b) of an element's stiffness is
/// K_ij = sum over k, l of C_ikjl S_kl, S = integral of grad N_a (grad N_b)^T, C the law as a tensor of fourth order.
struct ProductWeights {
  bool isotropic = true;
  double lambda = 0.0, mu = 0.0;          ///< K = lambda S + mu S^T + mu tr(S) I
  Eigen::Matrix<double, 9, 9> general{};  ///< rows: entries of K, columns: those of S, both column by column

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
    constexpr int component[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};  // of a pair of axes
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l) general(i + 3 * j, k + 3 * l) = law(component[i][k], component[j][l]);
  }
};

/// Integrals over an element in space of the products of its shape functions' gradients, of which only the blocks a <= b are computed. In
/// the integrals stands no law: 9 products a pair of nodes and point, a half of what B^T D B takes. \tparam nodes  of the element
template <int nodes>
class GradientProducts {
 public:
  static constexpr int n = 3 * nodes;

  /// \param storage  room for n x n numbers
  explicit GradientProducts(double* storage) : s_(storage) { std::fill_n(s_, n * n, 0.0); }

  /// Adds those of a point. \param gradients  nodes x 3
  void add(double measure, const double* gradients) {
    for (int b = 0; b < nodes; ++b)
      for (int j = 3 * b; j < 3 * b + 3; ++j) {
        const double weighted = measure * gradients[j];
        double* column = s_ + n * j;
        for (int i = 0; i < 3 * b + 3; ++i) column[i] += weighted * gradients[i];
      }
  }

  /// Sets the blocks a <= b of a stiffness matrix. \param k  n x n, column by column
  void contract(const ProductWeights& law, double* k) const {
    for (int b = 0; b < nodes; ++b)
      for (int a = 0; a <= b; ++a) {
        const double* s = s_ + n * 3 * b + 3 * a;
        double* own = k + n * 3 * b + 3 * a;
        if (law.isotropic) {
          const double trace = law.mu * (s[0] + s[n + 1] + s[2 * n + 2]);
          for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) own[n * j + i] = law.lambda * s[n * j + i] + law.mu * s[n * i + j];
          for (int i = 0; i < 3; ++i) own[n * i + i] += trace;
        } else {
          Eigen::Matrix<double, 9, 1> entries;
          for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) entries[3 * j + i] = s[n * j + i];
          const Eigen::Matrix<double, 9, 1> sum = law.general * entries;
          for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) own[n * j + i] = sum[3 * j + i];
        }
      }
  }

 private:
  double* s_;
};

}  // namespace suture
