#include <cblas.h>
#include <cholmod.h>
#include <suture/algebra/Lanes.hpp>
#include <suture/algebra/WorkSpace.hpp>
#include <suture/algebra/elimination/SingleFactor.hpp>
#include <suture/algebra/solvers/CholmodTriangle.hpp>

#include <Eigen/Dense>
#include <algorithm>

// LAPACK: upper <- U U^T in place, with a third of the operations of a general product.
extern "C" void dlauum_(const char* uplo, const int* n, double* a, const int* lda, int* info);

namespace suture {

namespace {

thread_local std::vector<double> keptUpdate;  // a supernode's part of x, in both substitutions

/// x <- [L_11 0; L_21 I]^-1 x for a supernode, column by column.
SUTURE_FOR_EACH_PROCESSOR void eliminate(int columns, int rows, const double* values, int stride, double* x) {
  for (int j = 0; j < columns; ++j, values += stride + 1) {
    x[j] /= values[0];
    subtractMultiple(rows - j - 1, x[j], values + 1, x + j + 1);
  }
}

/// x_1 <- L_11^-T (x_1 - L_21^T x_2)
SUTURE_FOR_EACH_PROCESSOR void substituteBack(int columns, int rows, const double* values, int stride, double* x) {
  values += static_cast<std::ptrdiff_t>(columns) * (stride + 1);
  for (int j = columns - 1; j >= 0; --j) {
    values -= stride + 1;
    x[j] = (x[j] - scalarProduct(rows - j - 1, values + 1, x + j + 1)) / values[0];
  }
}

}  // namespace

CholmodTriangle::CholmodTriangle(const cholmod_factor_struct& factor) : factor_(&factor), isSupernodal_(factor.is_super != 0) {
  if (!isSupernodal_) return;
  columnSupernode_.resize(factor.n);
  const int* super = static_cast<const int*>(factor.super);
  for (std::size_t s = 0; s < factor.nsuper; ++s) {
    std::fill(columnSupernode_.begin() + super[s], columnSupernode_.begin() + super[s + 1], int(s));
    mostRows_ = std::max(mostRows_, supernode(int(s), size()).rows);
  }
}

int CholmodTriangle::size() const { return static_cast<int>(factor_->n); }

double CholmodTriangle::bytes() const {
  if (isSupernodal_) return sizeof(double) * double(factor_->xsize) + sizeof(int) * double(factor_->ssize);
  return (sizeof(double) + sizeof(int)) * double(factor_->nzmax);
}

double CholmodTriangle::pivot(int column) const {
  const double* x = static_cast<const double*>(factor_->x);
  if (!isSupernodal_) return x[static_cast<const int*>(factor_->p)[column]];
  const Supernode s = supernode(columnSupernode_[column], size());
  const int inside = column - s.first;
  return s.values[std::size_t(inside) * s.stride + inside];
}

CholmodTriangle::Supernode CholmodTriangle::supernode(int s, int upTo) const {
  const int* super = static_cast<const int*>(factor_->super);
  const int* pi = static_cast<const int*>(factor_->pi);
  const int* px = static_cast<const int*>(factor_->px);
  const int* rows = static_cast<const int*>(factor_->s) + pi[s];
  const int allRows = pi[s + 1] - pi[s];
  Supernode node;
  node.first = super[s];
  node.columns = std::min(super[s + 1], upTo) - super[s];  // relaxed supernodes may straddle the limit
  node.rows = upTo >= size() ? allRows : int(std::lower_bound(rows, rows + allRows, upTo) - rows);
  node.values = static_cast<const double*>(factor_->x) + px[s];
  node.stride = allRows;
  node.below = rows + node.columns;
  return node;
}

// x <- L^-1 x for the first columns and rows of L. Row numbers ascend within a column, so the limit removes the end of each column.
void CholmodTriangle::forward(Eigen::Ref<Matrix> x) const {
  const int upTo = static_cast<int>(x.rows());
  if (!isSupernodal_) {
    const int *p = static_cast<const int*>(factor_->p), *rows = static_cast<const int*>(factor_->i),
              *nz = static_cast<const int*>(factor_->nz);
    const double* l = static_cast<const double*>(factor_->x);
    for (int c = 0; c < x.cols(); ++c) {
      double* y = x.col(c).data();
      for (int j = 0; j < upTo; ++j) {
        const double yj = y[j] /= l[p[j]];
        for (int k = p[j] + 1; k < p[j] + nz[j] && rows[k] < upTo; ++k) y[rows[k]] -= l[k] * yj;
      }
    }
    return;
  }
  WorkSpace space(mostRows_, x.cols(), keptUpdate);
  Eigen::Map<Matrix>& update = space.values;
  for (int s = 0; s < int(factor_->nsuper); ++s) {
    const Supernode node = supernode(s, upTo);
    if (node.columns <= 0) break;
    const int m = node.rows - node.columns;
    const double* off = node.values + node.columns;
    if (x.cols() == 1) {
      double *own = x.data() + node.first, *all = update.data(), *below = all + node.columns;
      std::copy_n(own, node.columns, all);
      std::fill_n(below, m, 0.0);
      eliminate(node.columns, node.rows, node.values, node.stride, all);
      std::copy_n(all, node.columns, own);
      for (int r = 0; r < m; ++r) x(node.below[r], 0) += below[r];
      continue;
    }
    double* y = x.data() + node.first;
    if (x.middleRows(node.first, node.columns).isZero(0.0)) continue;  // frequent for right-hand sides that begin on the boundary
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, node.columns, x.cols(), 1.0, node.values, node.stride, y,
                x.outerStride());
    if (m == 0) continue;
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, m, x.cols(), node.columns, 1.0, off, node.stride, y, x.outerStride(), 0.0,
                update.data(), update.outerStride());
    for (int c = 0; c < x.cols(); ++c)
      for (int r = 0; r < m; ++r) x(node.below[r], c) -= update(r, c);
  }
}

// x <- L^-T x for the first columns and rows of L.
void CholmodTriangle::backward(Eigen::Ref<Matrix> x) const {
  const int upTo = static_cast<int>(x.rows());
  if (!isSupernodal_) {
    const int *p = static_cast<const int*>(factor_->p), *rows = static_cast<const int*>(factor_->i),
              *nz = static_cast<const int*>(factor_->nz);
    const double* l = static_cast<const double*>(factor_->x);
    for (int c = 0; c < x.cols(); ++c) {
      double* y = x.col(c).data();
      for (int j = upTo - 1; j >= 0; --j) {
        double sum = y[j];
        for (int k = p[j] + 1; k < p[j] + nz[j] && rows[k] < upTo; ++k) sum -= l[k] * y[rows[k]];
        y[j] = sum / l[p[j]];
      }
    }
    return;
  }
  if (upTo == 0) return;
  WorkSpace space(mostRows_, x.cols(), keptUpdate);
  Eigen::Map<Matrix>& update = space.values;
  for (int s = columnSupernode_[upTo - 1]; s >= 0; --s) {
    const Supernode node = supernode(s, upTo);
    const int m = node.rows - node.columns;
    const double* off = node.values + node.columns;
    if (x.cols() == 1) {
      double *own = x.data() + node.first, *all = update.data(), *below = all + node.columns;
      std::copy_n(own, node.columns, all);
      for (int r = 0; r < m; ++r) below[r] = x(node.below[r], 0);
      substituteBack(node.columns, node.rows, node.values, node.stride, all);
      std::copy_n(all, node.columns, own);
      continue;
    }
    for (int c = 0; c < x.cols(); ++c)
      for (int r = 0; r < m; ++r) update(r, c) = x(node.below[r], c);
    double* y = x.data() + node.first;
    if (m > 0)
      cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, node.columns, x.cols(), m, -1.0, off, node.stride, update.data(),
                  update.outerStride(), 1.0, y, x.outerStride());
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasTrans, CblasNonUnit, node.columns, x.cols(), 1.0, node.values, node.stride, y,
                x.outerStride());
  }
}

void CholmodTriangle::solve(Eigen::Ref<Matrix> x) const {
  forward(x);
  backward(x);
}

Matrix CholmodTriangle::trailingProduct(int trailing) const {
  const int n = size();
  // L rotated by 180 degrees is upper triangular, U, and U U^T is L L^T rotated.
  Matrix upper = Matrix::Zero(trailing, trailing);
  const auto turned = [&](int dof) { return n - 1 - dof; };
  const double* x = static_cast<const double*>(factor_->x);
  for (int j = n - trailing; j < n; ++j) {
    if (isSupernodal_) {
      const Supernode node = supernode(columnSupernode_[j], n);
      const int inside = j - node.first;
      const double* column = node.values + std::size_t(inside) * node.stride;
      for (int r = inside; r < node.rows; ++r) {
        const int row = r < node.columns ? node.first + r : node.below[r - node.columns];
        upper(turned(row), turned(j)) = column[r];
      }
    } else {
      const int begin = static_cast<const int*>(factor_->p)[j], count = static_cast<const int*>(factor_->nz)[j];
      for (int k = begin; k < begin + count; ++k) upper(turned(static_cast<const int*>(factor_->i)[k]), turned(j)) = x[k];
    }
  }
  int info = 0;
  dlauum_("U", &trailing, upper.data(), &trailing, &info);
  upper.triangularView<Eigen::StrictlyLower>() = upper.transpose();
  return upper.reverse();
}

std::unique_ptr<SingleFactor> CholmodTriangle::inSinglePrecision(const std::vector<int>& permutation) const {
  if (!isSupernodal_) return nullptr;
  auto single = std::make_unique<SingleFactor>(permutation);
  const auto supernodes = factor_->nsuper;
  std::size_t rows = 0, entries = 0;
  for (std::size_t s = 0; s < supernodes; ++s) {
    const Supernode node = supernode(static_cast<int>(s), size());
    rows += node.rows - node.columns;
    entries += SingleFactor::entries(node.columns, node.rows - node.columns);
  }
  single->reserve(supernodes, rows, entries);
  for (std::size_t s = 0; s < supernodes; ++s) {
    const Supernode node = supernode(static_cast<int>(s), size());
    single->append(node.first, node.columns, {node.below, node.below + node.rows - node.columns}, node.values, node.stride);
  }
  return single;
}

}  // namespace suture
