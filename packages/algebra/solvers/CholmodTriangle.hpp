#pragma once
#include <suture/base/Types.hpp>

#include <memory>
#include <vector>

struct cholmod_factor_struct;

namespace suture {

class SingleFactor;

/// The triangle L of a CHOLMOD factorisation A = L L^T: substitutions, also with its first columns only, which CHOLMOD does not offer;
/// pivots, trailing products and copies. Rows and columns are in the order of L. Internal to this package; local, const.
class CholmodTriangle {
 public:
  CholmodTriangle() = default;  ///< triangle of an empty matrix
  /// \param factor  with or without supernodes, as L L^T; must outlive this object
  explicit CholmodTriangle(const cholmod_factor_struct& factor);

  bool isSupernodal() const { return isSupernodal_; }
  double bytes() const;  ///< memory of L
  double pivot(int column) const;

  /// x <- (L L^T)^-1 x, with the first x.rows() rows and columns of L.
  void solve(Eigen::Ref<Matrix> x) const;

  /// L_BB L_BB^T of the last `trailing` rows and columns, both triangles.
  Matrix trailingProduct(int trailing) const;

  /// L in single precision; null without supernodes. \param permutation  column of L -> unknown
  std::unique_ptr<SingleFactor> inSinglePrecision(const std::vector<int>& permutation) const;

 private:
  // Supernode s, restricted to columns and rows below a limit.
  struct Supernode {
    int first, columns, rows;
    const double* values;
    int stride;
    const int* below;  // row numbers below the diagonal block
  };
  Supernode supernode(int s, int upTo) const;
  int size() const;
  void forward(Eigen::Ref<Matrix> x) const;
  void backward(Eigen::Ref<Matrix> x) const;

  const cholmod_factor_struct* factor_ = nullptr;
  bool isSupernodal_ = false;
  std::vector<int> columnSupernode_;
  int mostRows_ = 0;  // rows of the largest supernode
};

}  // namespace suture
