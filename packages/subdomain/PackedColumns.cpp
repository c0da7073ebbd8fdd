#include <suture/subdomain/Lanes.hpp>
#include <suture/subdomain/PackedColumns.hpp>

namespace suture {

namespace {

constexpr int kWidth = 4;  // columns of a panel

template <typename Real>
constexpr int kLine = suture::Line<Real>::count;

// How far ahead of its use a line is fetched: numbers.
template <typename Real>
constexpr int kAhead = 4096 / static_cast<int>(sizeof(Real));

/// y <- A^T x; rows a multiple of the line's, columns of the panel's.
template <typename Real>
SUTURE_FOR_EACH_PROCESSOR void transposedProduct(int rows, int columns, const Real* a, const Real* x, Real* y) {
  using Line = suture::Line<Real>;
  using Four = suture::Four<Real>;
  for (int j = 0; j < columns; j += kWidth) {
    typename Line::Type s0 = {}, s1 = {}, s2 = {}, s3 = {};
    for (int i = 0; i < rows; i += Line::count) {
      for (int k = 0; k < kWidth; ++k) __builtin_prefetch(a + kAhead<Real> + k * Line::count, 0, kSecondLevel);
      const typename Line::Type& u = Line::at(x + i);
      s0 += Line::at(a) * u;
      s1 += Line::at(a + Line::count) * u;
      s2 += Line::at(a + 2 * Line::count) * u;
      s3 += Line::at(a + 3 * Line::count) * u;
      a += kWidth * Line::count;
    }
    typename Four::Type t0 = {}, t1 = {}, t2 = {}, t3 = {};
    foldInto<Real>(s0, t0);
    foldInto<Real>(s1, t1);
    foldInto<Real>(s2, t2);
    foldInto<Real>(s3, t3);
    y[j] = t0[0] + t0[1] + t0[2] + t0[3];
    y[j + 1] = t1[0] + t1[1] + t1[2] + t1[3];
    y[j + 2] = t2[0] + t2[1] + t2[2] + t2[3];
    y[j + 3] = t3[0] + t3[1] + t3[2] + t3[3];
  }
}

/// y += A x
template <typename Real>
SUTURE_FOR_EACH_PROCESSOR void product(int rows, int columns, const Real* a, const Real* x, Real* y) {
  using Line = suture::Line<Real>;
  for (int j = 0; j < columns; j += kWidth) {
    const Real x0 = x[j], x1 = x[j + 1], x2 = x[j + 2], x3 = x[j + 3];
    for (int i = 0; i < rows; i += Line::count) {
      for (int k = 0; k < kWidth; ++k) __builtin_prefetch(a + kAhead<Real> + k * Line::count, 0, kSecondLevel);
      Line::at(y + i) +=
          Line::at(a) * x0 + Line::at(a + Line::count) * x1 + Line::at(a + 2 * Line::count) * x2 + Line::at(a + 3 * Line::count) * x3;
      a += kWidth * Line::count;
    }
  }
}

}  // namespace

PackedColumns::PackedColumns(const Matrix& matrix, Precision precision)
    : rows_(static_cast<int>(matrix.rows())), columns_(static_cast<int>(matrix.cols())) {
  if (precision == Precision::Single)
    fill(matrix, singles_, single_);
  else
    fill(matrix, values_, double_);
}

template <typename Real>
std::size_t PackedColumns::place(int row, int column) const {
  constexpr int line = kLine<Real>;
  const std::size_t panel = static_cast<std::size_t>(column / kWidth) * kWidth * padded(rows_, line);
  return panel + static_cast<std::size_t>(row / line) * line * kWidth + column % kWidth * line + row % line;
}

template <typename Real>
void PackedColumns::fill(const Matrix& matrix, std::vector<Real>& values, Work<Real>& work) const {
  const int rows = padded(rows_, kLine<Real>), columns = padded(columns_, kWidth);
  values.assign(static_cast<std::size_t>(rows) * columns, Real(0));
  for (int j = 0; j < columns_; ++j)
    for (int i = 0; i < rows_; ++i) values[place<Real>(i, j)] = static_cast<Real>(matrix(i, j));
  work.rows.setZero(rows);
  work.columns.setZero(columns);
}

template <typename Real>
void PackedColumns::multiplyTransposed(const std::vector<Real>& values, Work<Real>& work, const Eigen::Ref<const Vector>& x,
                                       Vector& y) const {
  const double scale = scaleOf<Real>(x);
  work.rows.head(rows_) = (x / scale).template cast<Real>();
  transposedProduct(static_cast<int>(work.rows.size()), static_cast<int>(work.columns.size()), values.data(), work.rows.data(),
                    work.columns.data());
  y = scale * work.columns.head(columns_).template cast<double>();
}

template <typename Real>
void PackedColumns::addProduct(const std::vector<Real>& values, Work<Real>& work, const Vector& x, Eigen::Ref<Vector> y) const {
  const double scale = scaleOf<Real>(x);
  work.columns.head(columns_) = (x / scale).template cast<Real>();
  work.columns.tail(work.columns.size() - columns_).setZero();
  work.rows.setZero();
  product(static_cast<int>(work.rows.size()), static_cast<int>(work.columns.size()), values.data(), work.columns.data(), work.rows.data());
  y += scale * work.rows.head(rows_).template cast<double>();
  work.rows.tail(work.rows.size() - rows_).setZero();  // not zero if x held what is no number
}

void PackedColumns::multiplyTransposed(const Eigen::Ref<const Vector>& x, Vector& y) const {
  if (rows_ == 0 || columns_ == 0)
    y.setZero(columns_);
  else if (singles_.empty())
    multiplyTransposed(values_, double_, x, y);
  else
    multiplyTransposed(singles_, single_, x, y);
}

void PackedColumns::addProduct(const Vector& x, Eigen::Ref<Vector> y) const {
  if (rows_ == 0 || columns_ == 0) return;
  if (singles_.empty())
    addProduct(values_, double_, x, y);
  else
    addProduct(singles_, single_, x, y);
}

Matrix PackedColumns::full() const {
  Matrix made(rows_, columns_);
  for (int j = 0; j < columns_; ++j)
    for (int i = 0; i < rows_; ++i)
      made(i, j) = singles_.empty() ? values_[place<double>(i, j)] : static_cast<double>(singles_[place<float>(i, j)]);
  return made;
}

}  // namespace suture
