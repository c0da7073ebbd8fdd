#include <suture/subdomain/Lanes.hpp>
#include <suture/subdomain/PackedSymmetric.hpp>

#include <algorithm>

namespace suture {

namespace {

constexpr int kWidth = 4;        // columns of a panel: what one pass over x and y takes
constexpr int kPanelsAhead = 4;  // what is fetched before its turn

/// Where a panel begins.
std::size_t begin(int panel, int rows) { return static_cast<std::size_t>(kWidth) * panel * (rows - kWidth * (panel - 1) / 2); }

/// Rows of four columns, as many as a vector holds, used twice: v += sum of b_k x_k, and s_k += b_k u. Inlined for each processor.
template <typename Lanes, typename Real, typename Vector>
__attribute__((always_inline)) inline void addRows(const Real* a0, const Real* a1, const Real* a2, const Real* a3, const Real* x,
                                                   const Real* u, Real* v, Vector& s0, Vector& s1, Vector& s2, Vector& s3) {
  const Vector b0 = Lanes::at(a0), b1 = Lanes::at(a1), b2 = Lanes::at(a2), b3 = Lanes::at(a3), by = Lanes::at(u);
  Lanes::at(v) += b0 * x[0] + b1 * x[1] + b2 * x[2] + b3 * x[3];
  s0 += b0 * by;
  s1 += b1 * by;
  s2 += b2 * by;
  s3 += b3 * by;
}

/// y += A x, `rows` of them, a multiple of the panel's width. A comes from memory once and is used twice. The panel after the next three is
/// fetched into the second level of the cache: the ends of short columns stop the processor's own fetching, and in the first level, of
/// 32 kB on many, what comes so early would drive out what is used now. 66 matrices one after the other, one core of an EPYC, n = 470:
/// 16.7 GB/s, in single precision 20.3; into the first level 9.8 and 16.4, without fetching 10.5 and 8.5; to read the memory 14.5 to 20
/// and 22.
template <typename Real>
SUTURE_FOR_EACH_PROCESSOR void addProduct(int rows, const Real* a, const Real* x, Real* y) {
  using Line = suture::Line<Real>;
  using Four = suture::Four<Real>;
  for (int first = 0; first < rows; first += kWidth) {
    const int m = rows - first;
    const Real *a0 = a, *a1 = a + m, *a2 = a + 2 * m, *a3 = a + 3 * m, *u = x + first;
    const Real own[kWidth] = {u[0], u[1], u[2], u[3]};
    Real* v = y + first;
    typename Line::Type s0 = {}, s1 = {}, s2 = {}, s3 = {};
    typename Four::Type t0 = {}, t1 = {}, t2 = {}, t3 = {};
    Four::at(v) += Four::at(a0) * own[0] + Four::at(a1) * own[1] + Four::at(a2) * own[2] + Four::at(a3) * own[3];
    int i = kWidth;
    for (; i + Line::count <= m; i += Line::count) {
      const Real* ahead = a + kPanelsAhead * kWidth * m + kWidth * i;  // beyond the end nothing of A
      for (int k = 0; k < kWidth; ++k) __builtin_prefetch(ahead + k * Line::count, 0, kSecondLevel);
      addRows<Line>(a0 + i, a1 + i, a2 + i, a3 + i, own, u + i, v + i, s0, s1, s2, s3);
    }
    for (; i < m; i += kWidth) addRows<Four>(a0 + i, a1 + i, a2 + i, a3 + i, own, u + i, v + i, t0, t1, t2, t3);
    foldInto<Real>(s0, t0);
    foldInto<Real>(s1, t1);
    foldInto<Real>(s2, t2);
    foldInto<Real>(s3, t3);
    for (int k = 0; k < kWidth; ++k) {
      v[0] += t0[k];
      v[1] += t1[k];
      v[2] += t2[k];
      v[3] += t3[k];
    }
    a += kWidth * m;
  }
}

template <typename Given, typename Real>
void fill(const Given& matrix, std::vector<Real>& values) {
  const int size = static_cast<int>(matrix.rows()), rows = padded(size, kWidth);
  values.assign(begin(rows / kWidth, rows), Real(0));
  Real* to = values.data();
  for (int j = 0; j < rows; ++j) {
    const int first = j / kWidth * kWidth;
    if (j < size) {
      for (int i = first; i < j; ++i) to[i - first] = static_cast<Real>(matrix(j, i));
      for (int i = j; i < size; ++i) to[i - first] = static_cast<Real>(matrix(i, j));
    }
    to += rows - first;
  }
}

}  // namespace

PackedSymmetric::PackedSymmetric(const Matrix& matrix, Precision precision) : size_(static_cast<int>(matrix.rows())) {
  if (precision == Precision::Single)
    fill(matrix, singles_);
  else
    fill(matrix, values_);
}

PackedSymmetric::PackedSymmetric(const Eigen::MatrixXf& matrix) : size_(static_cast<int>(matrix.rows())) { fill(matrix, singles_); }

template <typename Real>
void PackedSymmetric::multiply(const std::vector<Real>& values, Work<Real>& work, ConstLocalView x, LocalView y) const {
  const int rows = padded(size_, kWidth);
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    const double scale = scaleOf<Real>(x.col(c));
    work.x.setZero(rows);
    work.y.setZero(rows);
    work.x.head(size_) = (x.col(c) / scale).template cast<Real>();
    addProduct(rows, values.data(), work.x.data(), work.y.data());
    y.col(c) = scale * work.y.head(size_).template cast<double>();
  }
}

void PackedSymmetric::multiply(ConstLocalView x, LocalView y) const {
  if (size_ == 0) return;
  if (singles_.empty())
    multiply(values_, double_, x, y);
  else
    multiply(singles_, single_, x, y);
}

double PackedSymmetric::at(int row, int column) const {
  if (row < column) std::swap(row, column);
  const int rows = padded(size_, kWidth), panel = column / kWidth, first = panel * kWidth;
  const std::size_t place = begin(panel, rows) + static_cast<std::size_t>(column - first) * (rows - first) + (row - first);
  return singles_.empty() ? values_[place] : static_cast<double>(singles_[place]);
}

Matrix PackedSymmetric::full() const {
  Matrix made(size_, size_);
  const int rows = padded(size_, kWidth);
  for (int j = 0; j < size_; ++j) {
    const int first = j / kWidth * kWidth;
    const std::size_t place = begin(first / kWidth, rows) + static_cast<std::size_t>(j - first) * (rows - first) + (j - first);
    if (singles_.empty())
      made.col(j).tail(size_ - j) = Eigen::Map<const Vector>(values_.data() + place, size_ - j);
    else
      made.col(j).tail(size_ - j) = Eigen::Map<const Eigen::VectorXf>(singles_.data() + place, size_ - j).cast<double>();
  }
  // By blocks: rows of a block stay in the cache while its columns are gone through.
  constexpr int block = 32;
  for (int first = 0; first < size_; first += block)
    for (int row = first; row < size_; row += block)
      for (int j = first; j < std::min(first + block, size_); ++j)
        for (int i = std::max(row, j + 1); i < std::min(row + block, size_); ++i) made(j, i) = made(i, j);
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
