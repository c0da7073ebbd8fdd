#include <cblas.h>
#include <cholmod.h>
#include <suture/algebra/CholmodFactor.hpp>
#include <suture/algebra/CholmodHandle.hpp>
#include <suture/algebra/Lanes.hpp>
#include <suture/algebra/SerialSection.hpp>
#include <suture/algebra/WorkSpace.hpp>
#include <suture/algebra/elimination/PivotCheck.hpp>
#include <suture/base/Errors.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>

// LAPACK: upper <- U U^T in place, a third of the operations of a product that does not know of the zeros.
extern "C" void dlauum_(const char* uplo, const int* n, double* a, const int* lda, int* info);

namespace suture {

namespace {

constexpr int columnsAtOnce = 32;  // right-hand sides that share one pass over L

thread_local std::vector<double> keptUpdate;  // a supernode's part of x, forward and backward

// The nested dissections and AMD of CHOLMOD take a pattern: the leading block of the lower triangle.
Eigen::SparseMatrix<double> leadingLower(const Eigen::SparseMatrix<double>& matrix, int size) {
  Eigen::SparseMatrix<double> lower(size, size);
  Eigen::VectorXi count = Eigen::VectorXi::Zero(size);
  for (int j = 0; j < size; ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, j); it; ++it)
      if (it.row() >= j && it.row() < size) ++count[j];
  lower.reserve(count);
  for (int j = 0; j < size; ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, j); it; ++it)
      if (it.row() >= j && it.row() < size) lower.insert(it.row(), j) = it.value();
  lower.makeCompressed();
  return lower;
}

// CHOLMOD's view of an Eigen matrix, lower triangle; nothing is copied and CHOLMOD does not write to it.
cholmod_sparse viewOf(const Eigen::SparseMatrix<double>& matrix) {
  cholmod_sparse view{};
  view.nrow = matrix.rows();
  view.ncol = matrix.cols();
  view.nzmax = matrix.nonZeros();
  view.p = const_cast<int*>(matrix.outerIndexPtr());
  view.i = const_cast<int*>(matrix.innerIndexPtr());
  view.x = const_cast<double*>(matrix.valuePtr());
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

const char* nameOf(CholmodOptions::Ordering ordering) {
  switch (ordering) {
    case CholmodOptions::Ordering::Amd:
      return "AMD";
    case CholmodOptions::Ordering::ConstrainedAmd:
      return "CAMD";
    case CholmodOptions::Ordering::Metis:
      break;
  }
  return "METIS";
}

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

struct CholmodFactor::Data : CholmodHandle {
  void order(const Eigen::SparseMatrix<double>& matrix, CholmodOptions::Ordering ordering);
  void factorise(const Eigen::SparseMatrix<double>& matrix, const CholmodOptions& options);
  void judgePivots(const Vector& diagonal, PivotCheck& check);

  double pivot(int column) const;
  void forward(int upTo, Eigen::Ref<Matrix> x) const;
  void backward(int upTo, Eigen::Ref<Matrix> x) const;
  void solve(int upTo, LocalView rhs) const;

  // Supernode s: its first column, its columns and rows below a limit, its dense block, its row numbers.
  struct Supernode {
    int first, columns, rows;
    const double* values;
    int stride;
    const int* below;  // row numbers after the diagonal block's
  };
  Supernode supernode(int s, int upTo) const;

  std::vector<int> permutation;  // column of L -> dof
  std::vector<int> columnSupernode;
  int mostRows = 0;  // rows of the largest supernode
  Vector shift;
  Statistics statistics;
};

void CholmodFactor::Data::order(const Eigen::SparseMatrix<double>& matrix, CholmodOptions::Ordering ordering) {
  const int n = statistics.size, leading = n - statistics.trailing;
  permutation.resize(n);
  std::iota(permutation.begin(), permutation.end(), 0);
  if (leading == 0) return;
  // All three give a postordered elimination tree of the leading block, which stays one when the trailing dofs are appended: hence the
  // analysis of the whole needs no postordering of its own, which would move the trailing dofs.
  if (ordering == CholmodOptions::Ordering::ConstrainedAmd && leading < n) {
    cholmod_sparse whole = viewOf(matrix);
    std::vector<int> sets(n, 0);
    std::fill(sets.begin() + leading, sets.end(), 1);
    cholmod_camd(&whole, nullptr, 0, sets.data(), permutation.data(), common.get());
    check("ordering with CAMD");
    std::iota(permutation.begin() + leading, permutation.end(), leading);
    return;
  }
  const Eigen::SparseMatrix<double> block = leadingLower(matrix, leading);
  cholmod_sparse view = viewOf(block);
  if (ordering == CholmodOptions::Ordering::Metis) {
    cholmod_metis(&view, nullptr, 0, 1, permutation.data(), common.get());
    check("ordering with METIS");
  } else {
    cholmod_amd(&view, nullptr, 0, permutation.data(), common.get());
    check("ordering with AMD");
  }
}

void CholmodFactor::Data::factorise(const Eigen::SparseMatrix<double>& matrix, const CholmodOptions& options) {
  const int n = statistics.size, leading = n - statistics.trailing;
  const SerialSection alone;
  order(matrix, options.ordering);

  common->nmethods = 1;
  common->method[0].ordering = CHOLMOD_GIVEN;
  common->postorder = 0;
  common->final_ll = 1;
  common->supernodal = options.form == CholmodOptions::Form::Automatic    ? CHOLMOD_AUTO
                       : options.form == CholmodOptions::Form::Simplicial ? CHOLMOD_SIMPLICIAL
                                                                          : CHOLMOD_SUPERNODAL;
  cholmod_sparse view = viewOf(matrix);
  factor = cholmod_analyze_p(&view, permutation.data(), nullptr, 0, common.get());
  check("symbolic analysis");
  statistics.flops = common->fl;
  statistics.factorEntries = common->lnz;
  statistics.ordering = nameOf(options.ordering);

  // The shift is the only change to the matrix; without one CHOLMOD reads the caller's own arrays.
  Vector diagonal = matrix.diagonal();
  if (shift.size() > 0) {
    Eigen::SparseMatrix<double> shifted = matrix;
    for (int b = 0; b < statistics.trailing; ++b) shifted.coeffRef(leading + b, leading + b) += shift[b];
    shifted.makeCompressed();
    diagonal.tail(statistics.trailing) += shift;
    view = viewOf(shifted);
    cholmod_factorize(&view, factor, common.get());
  } else {
    cholmod_factorize(&view, factor, common.get());
  }
  check("factorisation");
  PivotCheck pivots(n, statistics.trailing);
  if (factor->minor < factor->n) pivots.notPositive(permutation[factor->minor], static_cast<int>(factor->minor));
  statistics.supernodal = factor->is_super != 0;
  if (statistics.supernodal) {
    columnSupernode.resize(n);
    const int* super = static_cast<const int*>(factor->super);
    for (std::size_t s = 0; s < factor->nsuper; ++s) {
      std::fill(columnSupernode.begin() + super[s], columnSupernode.begin() + super[s + 1], int(s));
      mostRows = std::max(mostRows, supernode(int(s), n).rows);
    }
    statistics.bytes = sizeof(double) * double(factor->xsize) + sizeof(int) * double(factor->ssize);
  } else {
    statistics.bytes = (sizeof(double) + sizeof(int)) * double(factor->nzmax);
  }
  judgePivots(diagonal, pivots);
}

double CholmodFactor::Data::pivot(int column) const {
  const double* x = static_cast<const double*>(factor->x);
  if (!statistics.supernodal) return x[static_cast<const int*>(factor->p)[column]];
  const Supernode s = supernode(columnSupernode[column], statistics.size);
  const int inside = column - s.first;
  return s.values[std::size_t(inside) * s.stride + inside];
}

void CholmodFactor::Data::judgePivots(const Vector& diagonal, PivotCheck& check) {
  for (int j = 0; j < statistics.size; ++j) {
    const double l = pivot(j);
    check.see(permutation[j], l * l, diagonal[permutation[j]]);
  }
  statistics.smallestPivot = check.smallest();
  statistics.smallestPivotDof = check.unknown();
  check.judge();
}

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

// x <- L^-1 x for the first `upTo` columns and rows of L. Row numbers ascend within a column, so that the limit cuts off a tail.
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
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, node.columns, x.cols(), 1.0, node.values, node.stride, y,
                x.outerStride());
    if (m == 0) continue;
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, m, x.cols(), node.columns, 1.0, off, node.stride, y, x.outerStride(), 0.0,
                update.data(), update.outerStride());
    for (int c = 0; c < x.cols(); ++c)
      for (int r = 0; r < m; ++r) x(node.below[r], c) -= update(r, c);
  }
}

// x <- L^-T x, likewise.
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

CholmodFactor::CholmodFactor(const Eigen::SparseMatrix<double>& matrix, const CholmodOptions& options) : data_(std::make_unique<Data>()) {
  const int n = static_cast<int>(matrix.rows());
  if (matrix.rows() != matrix.cols()) throw InternalError("CholmodFactor: the matrix is not square");
  if (options.trailing < 0 || options.trailing > n) throw InternalError("CholmodFactor: more trailing dofs than dofs");
  if (options.shift.size() != 0 && options.shift.size() != options.trailing)
    throw InternalError("CholmodFactor: one shift for each trailing dof");
  data_->statistics.size = n;
  data_->statistics.trailing = options.trailing;
  data_->shift = options.shift;
  if (n == 0) return;
  if (matrix.isCompressed()) {
    data_->factorise(matrix, options);
  } else {
    Eigen::SparseMatrix<double> compressed = matrix;
    compressed.makeCompressed();
    data_->factorise(compressed, options);
  }
}

CholmodFactor::~CholmodFactor() = default;
CholmodFactor::CholmodFactor(CholmodFactor&&) noexcept = default;
CholmodFactor& CholmodFactor::operator=(CholmodFactor&&) noexcept = default;

int CholmodFactor::size() const { return data_->statistics.size; }
int CholmodFactor::trailing() const { return data_->statistics.trailing; }
const CholmodFactor::Statistics& CholmodFactor::statistics() const { return data_->statistics; }

void CholmodFactor::solve(LocalView rhs) const { data_->solve(size(), rhs); }
void CholmodFactor::solveLeading(LocalView rhs) const { data_->solve(size() - trailing(), rhs); }

Matrix CholmodFactor::trailingSchur() const {
  const int n = size(), nb = trailing(), leading = n - nb;
  // L turned by 180 degrees is upper triangular, U, and U U^T is L L^T turned.
  Matrix upper = Matrix::Zero(nb, nb);
  if (nb == 0) return upper;
  const auto turned = [&](int dof) { return n - 1 - dof; };
  const double* x = static_cast<const double*>(data_->factor->x);
  for (int j = leading; j < n; ++j) {
    if (data_->statistics.supernodal) {
      const Data::Supernode node = data_->supernode(data_->columnSupernode[j], n);
      const int inside = j - node.first;
      const double* column = node.values + std::size_t(inside) * node.stride;
      for (int r = inside; r < node.rows; ++r) {
        const int row = r < node.columns ? node.first + r : node.below[r - node.columns];
        upper(turned(row), turned(j)) = column[r];
      }
    } else {
      const int begin = static_cast<const int*>(data_->factor->p)[j], count = static_cast<const int*>(data_->factor->nz)[j];
      for (int k = begin; k < begin + count; ++k) upper(turned(static_cast<const int*>(data_->factor->i)[k]), turned(j)) = x[k];
    }
  }
  int info = 0;
  dlauum_("U", &nb, upper.data(), &nb, &info);
  upper.triangularView<Eigen::StrictlyLower>() = upper.transpose();
  Matrix schur = upper.reverse();
  if (data_->shift.size() > 0) schur.diagonal() -= data_->shift;
  return schur;
}

Vector CholmodFactor::trailingDiagonal(const Eigen::SparseMatrix<double>& matrix, int trailing) { return matrix.diagonal().tail(trailing); }

}  // namespace suture
