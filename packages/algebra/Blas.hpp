#pragma once
#include <cblas.h>
#include <suture/base/Types.hpp>

// BLAS and LAPACK in either precision, matrices stored by columns. For sources only.

extern "C" void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
extern "C" void dlauum_(const char* uplo, const int* n, double* a, const int* lda, int* info);
extern "C" void slauum_(const char* uplo, const int* n, float* a, const int* lda, int* info);

namespace suture {

/// c <- factor * a b + share * c; `transposed` applies to a.
inline void gemm(CBLAS_TRANSPOSE transposed, int m, int n, int k, double factor, const double* a, int lda, const double* b, int ldb,
                 double share, double* c, int ldc) {
  cblas_dgemm(CblasColMajor, transposed, CblasNoTrans, m, n, k, factor, a, lda, b, ldb, share, c, ldc);
}
inline void gemm(CBLAS_TRANSPOSE transposed, int m, int n, int k, float factor, const float* a, int lda, const float* b, int ldb,
                 float share, float* c, int ldc) {
  cblas_sgemm(CblasColMajor, transposed, CblasNoTrans, m, n, k, factor, a, lda, b, ldb, share, c, ldc);
}

/// c <- a b, a symmetric, of which the lower triangle is read.
inline void symm(int m, int n, const double* a, const double* b, double* c) {
  cblas_dsymm(CblasColMajor, CblasLeft, CblasLower, m, n, 1.0, a, m, b, m, 0.0, c, m);
}
inline void symm(int m, int n, const float* a, const float* b, float* c) {
  cblas_ssymm(CblasColMajor, CblasLeft, CblasLower, m, n, 1.0F, a, m, b, m, 0.0F, c, m);
}

/// c <- c + factor * (a b^T + b a^T), lower triangle.
inline void syr2k(int n, int k, double factor, const double* a, const double* b, double* c) {
  cblas_dsyr2k(CblasColMajor, CblasLower, CblasNoTrans, n, k, factor, a, n, b, n, 1.0, c, n);
}
inline void syr2k(int n, int k, float factor, const float* a, const float* b, float* c) {
  cblas_ssyr2k(CblasColMajor, CblasLower, CblasNoTrans, n, k, factor, a, n, b, n, 1.0F, c, n);
}

/// b <- factor * a b or, from the right, factor * b a, a lower triangular.
inline void trmm(CBLAS_SIDE side, int m, int n, double factor, const double* a, double* b, int stride) {
  cblas_dtrmm(CblasColMajor, side, CblasLower, CblasNoTrans, CblasNonUnit, m, n, factor, a, stride, b, stride);
}
inline void trmm(CBLAS_SIDE side, int m, int n, float factor, const float* a, float* b, int stride) {
  cblas_strmm(CblasColMajor, side, CblasLower, CblasNoTrans, CblasNonUnit, m, n, factor, a, stride, b, stride);
}

/// a <- l, a = l l^T, lower triangles, in place. False: a is not positive definite.
inline bool potrf(int n, double* a) {
  int info = 0;
  if (n > 0) dpotrf_("L", &n, a, &n, &info);
  return info == 0;
}

/// l <- l^T l, lower triangles, in place.
inline void lauum(int n, double* a) {
  int info = 0;
  dlauum_("L", &n, a, &n, &info);
}
inline void lauum(int n, float* a) {
  int info = 0;
  slauum_("L", &n, a, &n, &info);
}

template <typename Real>
using Dense = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// c <- factor * a b + share * c; `transposed` applies to a. Eigen's own products are compiled for the oldest processors.
template <typename Real>
void addProductTo(Real factor, CBLAS_TRANSPOSE transposed, const Dense<Real>& a, const Dense<Real>& b, Real share, Dense<Real>& c) {
  const int rows = static_cast<int>(transposed == CblasTrans ? a.cols() : a.rows()), columns = static_cast<int>(b.cols());
  if (share == Real(0)) c.resize(rows, columns);
  if (c.size() == 0 || b.rows() == 0) {
    if (share == Real(0)) c.setZero();
    return;
  }
  gemm(transposed, rows, columns, static_cast<int>(b.rows()), factor, a.data(), static_cast<int>(a.rows()), b.data(),
       static_cast<int>(b.rows()), share, c.data(), rows);
}

/// a b, or a^T b.
template <typename Real>
Dense<Real> product(CBLAS_TRANSPOSE transposed, const Dense<Real>& a, const Dense<Real>& b) {
  Dense<Real> c;
  addProductTo(Real(1), transposed, a, b, Real(0), c);
  return c;
}

}  // namespace suture
