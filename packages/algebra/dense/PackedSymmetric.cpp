#include <suture/algebra/Lanes.hpp>
#include <suture/algebra/WorkSpace.hpp>
#include <suture/algebra/dense/PackedSymmetric.hpp>

#include <algorithm>
#include <type_traits>

namespace suture {

namespace {

/// Offset of a panel.
std::size_t begin(int panel, int rows) { return static_cast<std::size_t>(kWidth) * panel * (rows - kWidth * (panel - 1) / 2); }

/// A panel consists of the diagonal block, then blocks with as many rows as a cache line has numbers, then, for the remaining rows, blocks
/// of four. Calls take(column, row, height, place) for each block in memory order; a block has four columns.
template <typename Real, typename Take>
void eachBlock(int rows, const Take& take) {
  std::size_t place = 0;
  for (int column = 0; column < rows; column += kWidth)
    for (int row = column, height = kWidth; row < rows;
         row += height, height = row + Line<Real>::count <= rows ? Line<Real>::count : kWidth) {
      take(column, row, height, place);
      place += static_cast<std::size_t>(kWidth) * height;
    }
}

/// A block, used twice: v += sum of b_k x_k, and s_k += b_k u. Inlined for each processor.
template <typename Lanes, typename Real, typename Vector>
__attribute__((always_inline)) inline void addBlock(const Real* a, const Real* x, const Real* u, Real* v, Vector& s0, Vector& s1,
                                                    Vector& s2, Vector& s3) {
  const Vector b0 = Lanes::at(a), b1 = Lanes::at(a + Lanes::count), b2 = Lanes::at(a + 2 * Lanes::count),
               b3 = Lanes::at(a + 3 * Lanes::count), by = Lanes::at(u);
  Lanes::at(v) += b0 * x[0] + b1 * x[1] + b2 * x[2] + b3 * x[3];
  s0 += b0 * by;
  s1 += b1 * by;
  s2 += b2 * by;
  s3 += b3 * by;
}

/// y += A x for `rows` rows, a multiple of the panel's width. A is read from memory once and used twice. In this order, starting at a cache
/// line, it is as fast as reading: 17 to 19 GB/s on an idle machine (two processes on an EPYC, the case of AlignedVector in pages of 4 kB,
/// either precision; whole columns one after the other, with software prefetch of the next: 13 to 15), 13 to 15 if others use the memory
/// (both). Software prefetch in this order: none to 1 kB ahead the same, 4 kB and more a quarter slower.
template <typename Real>
__attribute__((always_inline)) inline void addProduct(int rows, const Real* a, const Real* x, Real* y) {
  using Line = suture::Line<Real>;
  using Four = suture::Four<Real>;
  for (int first = 0; first < rows; first += kWidth) {
    const Real* u = x + first;
    const Real own[kWidth] = {u[0], u[1], u[2], u[3]};
    Real* v = y + first;
    Four::at(v) += Four::at(a) * own[0] + Four::at(a + 4) * own[1] + Four::at(a + 8) * own[2] + Four::at(a + 12) * own[3];
    a += kWidth * kWidth;
    typename Line::Type s0 = {}, s1 = {}, s2 = {}, s3 = {};
    typename Four::Type t0 = {}, t1 = {}, t2 = {}, t3 = {};
    const int m = rows - first;
    int i = kWidth;
    for (; i + Line::count <= m; i += Line::count, a += kWidth * Line::count) addBlock<Line>(a, own, u + i, v + i, s0, s1, s2, s3);
    for (; i < m; i += kWidth, a += kWidth * kWidth) addBlock<Four>(a, own, u + i, v + i, t0, t1, t2, t3);
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
  }
}

/// y <- factor A x. `padded`: work space of two vectors of `rows` numbers.
template <typename Real>
SUTURE_FOR_EACH_PROCESSOR void product(int size, int rows, const Real* a, double factor, const double* x, double* y, Real* padded) {
  const double scale = scaleOf<Real>(size, x);
  divide(size, x, scale, padded);
  for (int i = size; i < rows; ++i) padded[i] = 0;
  for (int i = rows; i < 2 * rows; ++i) padded[i] = 0;
  addProduct(rows, a, padded, padded + rows);
  suture::multiply<0>(size, factor * scale, padded + rows, y);
}

template <typename Given, typename Real>
void fill(const Given& matrix, AlignedVector<Real>& values) {
  const int size = static_cast<int>(matrix.rows()), rows = padded(size, kWidth);
  values.resize(begin(rows / kWidth, rows));
  eachBlock<Real>(rows, [&](int column, int row, int height, std::size_t place) {
    Real* to = values.data() + place;
    for (int j = column; j < column + kWidth; ++j)
      for (int i = row; i < row + height; ++i) {
        const int lower = std::max(i, j), upper = std::min(i, j);
        *to++ = lower < size ? static_cast<Real>(matrix(lower, upper)) : Real(0);
      }
  });
}

}  // namespace

PackedSymmetric::PackedSymmetric(const Matrix& matrix, Precision precision) : size_(static_cast<int>(matrix.rows())) {
  if (precision == Precision::Single)
    fill(matrix, singles_);
  else
    fill(matrix, values_);
}

PackedSymmetric::PackedSymmetric(const Eigen::MatrixXf& matrix, double factor) : size_(static_cast<int>(matrix.rows())), factor_(factor) {
  fill(matrix, singles_);
}

template <typename Real>
void PackedSymmetric::multiply(const AlignedVector<Real>& values, ConstLocalView x, LocalView y) const {
  const int rows = padded(size_, kWidth);
  Real* work = kernelSpace<Real>(2 * static_cast<std::size_t>(rows));
  for (Eigen::Index c = 0; c < x.cols(); ++c) product(size_, rows, values.data(), factor_, x.col(c).data(), y.col(c).data(), work);
}

void PackedSymmetric::multiply(ConstLocalView x, LocalView y) const {
  if (size_ == 0) return;
  if (singles_.empty())
    multiply(values_, x, y);
  else
    multiply(singles_, x, y);
}

double PackedSymmetric::at(int row, int column) const {
  if (row < column) std::swap(row, column);
  const int line = singles_.empty() ? Line<double>::count : Line<float>::count;
  const int rows = padded(size_, kWidth), first = column / kWidth * kWidth;
  int top = first, height = kWidth;  // first row and height of the block
  if (row >= first + kWidth) {
    const int below = rows - first - kWidth, whole = below / line * line, at = row - first - kWidth;
    height = at < whole ? line : kWidth;
    top = row - (at < whole ? at % line : (at - whole) % kWidth);
  }
  const std::size_t place = begin(first / kWidth, rows) + static_cast<std::size_t>(kWidth) * (top - first) +
                            static_cast<std::size_t>(column - first) * height + (row - top);
  return factor_ * (singles_.empty() ? values_[place] : static_cast<double>(singles_[place]));
}

Matrix PackedSymmetric::full() const {
  Matrix made(size_, size_);
  const auto copy = [&](const auto& values) {
    using Real = std::decay_t<decltype(values[0])>;
    eachBlock<Real>(padded(size_, kWidth), [&](int column, int row, int height, std::size_t place) {
      for (int j = column; j < std::min(column + kWidth, size_); ++j)
        for (int i = std::max(row, j); i < std::min(row + height, size_); ++i)
          made(i, j) = factor_ * static_cast<double>(values[place + static_cast<std::size_t>(j - column) * height + (i - row)]);
    });
  };
  if (singles_.empty())
    copy(values_);
  else
    copy(singles_);
  // By blocks, so that the rows of a block stay in the cache while its columns are processed.
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
