// Substitutions with a CHOLMOD factor, also restricted to its first columns, which CHOLMOD does not offer.
#include <cblas.h>
#include <cholmod.h>
#include <suture/algebra/Lanes.hpp>
#include <suture/algebra/WorkSpace.hpp>
#include <suture/algebra/elimination/SingleFactor.hpp>
#include <suture/algebra/solvers/CholmodData.hpp>
#include <suture/base/Errors.hpp>

#include <algorithm>

namespace suture {

namespace {

constexpr int columnsAtOnce = 32;  // right-hand sides that share one pass over L

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

CholmodFactor::Data::Supernode CholmodFactor::Data::supernode(int s, int upTo) const {
  const int* super = static_cast<const int*>(factor->super);
  const int* pi = static_cast<const int*>(factor->pi);
  const int* px = static_cast<const int*>(factor->px);
  const int* rows = static_cast<const int*>(factor->s) + pi[s];
  const int allRows = pi[s + 1] - pi[s];
  Supernode node;
  node.first = super[s];
  node.columns = std::min(super[s + 1], upTo) - super[s];  // relaxed supernodes may straddle the limit
  node.rows = upTo >= statistics.size ? allRows : int(std::lower_bound(rows, rows + allRows, upTo) - rows);
  node.values = static_cast<const double*>(factor->x) + px[s];
  node.stride = allRows;
  node.below = rows + node.columns;
  return node;
}

// x <- L^-1 x for the first `upTo` columns and rows of L. Row numbers ascend within a column, so the limit removes the end of each column.
void CholmodFactor::Data::forward(int upTo, Eigen::Ref<Matrix> x) const {
  if (!statistics.supernodal) {
    const int *p = static_cast<const int*>(factor->p), *rows = static_cast<const int*>(factor->i),
              *nz = static_cast<const int*>(factor->nz);
    const double* l = static_cast<const double*>(factor->x);
    for (int c = 0; c < x.cols(); ++c) {
      double* y = x.col(c).data();
      for (int j = 0; j < upTo; ++j) {
        const double yj = y[j] /= l[p[j]];
        for (int k = p[j] + 1; k < p[j] + nz[j] && rows[k] < upTo; ++k) y[rows[k]] -= l[k] * yj;
      }
    }
    return;
  }
  WorkSpace space(mostRows, x.cols(), keptUpdate);
  Eigen::Map<Matrix>& update = space.values;
  for (int s = 0; s < int(factor->nsuper); ++s) {
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

// x <- L^-T x for the first `upTo` columns and rows of L.
void CholmodFactor::Data::backward(int upTo, Eigen::Ref<Matrix> x) const {
  if (!statistics.supernodal) {
    const int *p = static_cast<const int*>(factor->p), *rows = static_cast<const int*>(factor->i),
              *nz = static_cast<const int*>(factor->nz);
    const double* l = static_cast<const double*>(factor->x);
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
  WorkSpace space(mostRows, x.cols(), keptUpdate);
  Eigen::Map<Matrix>& update = space.values;
  for (int s = columnSupernode[upTo - 1]; s >= 0; --s) {
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

std::unique_ptr<SingleFactor> CholmodFactor::inSinglePrecision() const {
  if (!data_->statistics.supernodal || trailing() > 0) return nullptr;
  auto single = std::make_unique<SingleFactor>(data_->permutation);
  const auto supernodes = data_->factor->nsuper;
  std::size_t rows = 0, entries = 0;
  for (std::size_t s = 0; s < supernodes; ++s) {
    const Data::Supernode node = data_->supernode(static_cast<int>(s), size());
    rows += node.rows - node.columns;
    entries += SingleFactor::entries(node.columns, node.rows - node.columns);
  }
  single->reserve(supernodes, rows, entries);
  for (std::size_t s = 0; s < supernodes; ++s) {
    const Data::Supernode node = data_->supernode(static_cast<int>(s), size());
    single->append(node.first, node.columns, {node.below, node.below + node.rows - node.columns}, node.values, node.stride);
  }
  return single;
}

void CholmodFactor::Data::solve(int upTo, LocalView rhs) const {
  if (rhs.rows() != upTo)
    throw InternalError("CholmodFactor: right-hand side of " + std::to_string(rhs.rows()) + " rows for " + std::to_string(upTo) + " dofs");
  if (upTo == 0) return;
  thread_local std::vector<double> kept;
  WorkSpace space(upTo, std::min<Eigen::Index>(rhs.cols(), columnsAtOnce), kept);
  Eigen::Map<Matrix>& work = space.values;
  for (Eigen::Index first = 0; first < rhs.cols(); first += columnsAtOnce) {
    const Eigen::Index count = std::min<Eigen::Index>(columnsAtOnce, rhs.cols() - first);
    auto x = work.leftCols(count);
    for (Eigen::Index c = 0; c < count; ++c)
      for (int j = 0; j < upTo; ++j) x(j, c) = rhs(permutation[j], first + c);
    forward(upTo, x);
    backward(upTo, x);
    for (Eigen::Index c = 0; c < count; ++c)
      for (int j = 0; j < upTo; ++j) rhs(permutation[j], first + c) = x(j, c);
  }
}

}  // namespace suture
