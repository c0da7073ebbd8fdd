#include <suture/algebra/Lanes.hpp>
#include <suture/answer/bound/SmallProducts.hpp>

namespace suture {

SUTURE_FOR_EACH_PROCESSOR
void combineColumns(int rows, int columns, const double* matrix, const double* x, double* result) {
  using Many = Register<double>;
  constexpr int width = Many::count;
  int i = 0;
  for (; i + 2 * width <= rows; i += 2 * width) {
    Many::Type first = {}, second = {};
    for (int j = 0; j < columns; ++j) {
      const double* from = matrix + static_cast<long>(j) * rows + i;
      first += x[j] * Many::at(from);
      second += x[j] * Many::at(from + width);
    }
    Many::at(result + i) = first;
    Many::at(result + i + width) = second;
  }
  for (; i < rows; ++i) {
    double sum = 0.0;
    for (int j = 0; j < columns; ++j) sum += x[j] * matrix[static_cast<long>(j) * rows + i];
    result[i] = sum;
  }
}

namespace {

/// Twelve rows of two columns of a product, all in registers.
__attribute__((always_inline)) inline void multiplyTwelve(int inner, const double* a, int strideA, const double* b, const double* c,
                                                          double* toB, double* toC) {
  using Many = Register<double>;
  constexpr int width = Many::count;
  Many::Type b0 = {}, b1 = {}, b2 = {}, c0 = {}, c1 = {}, c2 = {};
  for (int k = 0; k < inner; ++k, a += strideA) {
    const Many::Type a0 = Many::at(a), a1 = Many::at(a + width), a2 = Many::at(a + 2 * width);
    b0 += b[k] * a0, b1 += b[k] * a1, b2 += b[k] * a2;
    c0 += c[k] * a0, c1 += c[k] * a1, c2 += c[k] * a2;
  }
  Many::at(toB) = b0, Many::at(toB + width) = b1, Many::at(toB + 2 * width) = b2;
  Many::at(toC) = c0, Many::at(toC + width) = c1, Many::at(toC + 2 * width) = c2;
}

}  // namespace

SUTURE_FOR_EACH_PROCESSOR
void multiplySmall(int rows, int inner, int columns, const double* a, int strideA, const double* b, int strideB, double* result,
                   int strideResult) {
  constexpr int block = 3 * Register<double>::count;
  const int evenColumns = columns / 2 * 2;
  int done = 0;
  for (; done + block <= rows; done += block)
    for (int j = 0; j < evenColumns; j += 2)
      multiplyTwelve(inner, a + done, strideA, b + j * strideB, b + (j + 1) * strideB, result + done + j * strideResult,
                     result + done + (j + 1) * strideResult);
  for (int j = 0; j < columns; ++j)
    for (int i = j < evenColumns ? done : 0; i < rows; ++i) {
      double sum = 0.0;
      for (int k = 0; k < inner; ++k) sum += a[i + k * strideA] * b[k + j * strideB];
      result[i + j * strideResult] = sum;
    }
}

}  // namespace suture
