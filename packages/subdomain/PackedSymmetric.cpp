#include <cblas.h>
#include <suture/subdomain/PackedSymmetric.hpp>

namespace suture {

PackedSymmetric::PackedSymmetric(const Matrix& matrix)
    : size_(static_cast<int>(matrix.rows())), values_(matrix.rows() * (matrix.rows() + 1) / 2) {
  Eigen::Index next = 0;
  for (int j = 0; j < size_; ++j) {
    values_.segment(next, size_ - j) = matrix.col(j).tail(size_ - j);
    next += size_ - j;
  }
}

void PackedSymmetric::multiply(ConstLocalView x, LocalView y) const {
  for (Eigen::Index c = 0; c < x.cols(); ++c)
    cblas_dspmv(CblasColMajor, CblasLower, size_, 1.0, values_.data(), x.col(c).data(), 1, 0.0, y.col(c).data(), 1);
}

Matrix PackedSymmetric::full() const {
  Matrix made(size_, size_);
  Eigen::Index next = 0;
  for (int j = 0; j < size_; ++j) {
    made.col(j).tail(size_ - j) = values_.segment(next, size_ - j);
    next += size_ - j;
  }
  made.triangularView<Eigen::StrictlyUpper>() = made.transpose();
  return made;
}

Matrix PackedSymmetric::block(const std::vector<int>& positions) const {
  const int n = static_cast<int>(positions.size());
  Matrix made(n, n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) made(i, j) = at(positions[i], positions[j]);
  return made;
}

}  // namespace suture
