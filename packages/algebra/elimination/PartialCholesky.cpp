#include <cblas.h>
#include <suture/algebra/Lanes.hpp>
#include <suture/algebra/elimination/PartialCholesky.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr int kPanel = 12;    // columns eliminated one by one
constexpr int kBlock = 96;    // columns updated panel by panel; larger products between these blocks
constexpr int kColumns = 24;  // columns of a product; its part above the diagonal is wasted work

__attribute__((always_inline)) inline void scale(int n, double x, double* y) {
  int i = 0;
  for (; i + Line<double>::count <= n; i += Line<double>::count) Line<double>::at(y + i) *= x;
  for (; i < n; ++i) y[i] *= x;
}

/// Column by column; each is subtracted from those that follow.
SUTURE_FOR_EACH_PROCESSOR int factorPanel(int columns, int rows, double* values, std::ptrdiff_t stride) {
  for (int j = 0; j < columns; ++j) {
    double* own = values + j * stride;
    if (!(own[j] > 0.0)) return j + 1;
    own[j] = std::sqrt(own[j]);
    scale(rows - j - 1, 1.0 / own[j], own + j + 1);
    for (int k = j + 1; k < columns; ++k) subtractMultiple(rows - k, own[k], own + k, values + k * stride + k);
  }
  return 0;
}

/// Subtracts the product of the columns before `first` from the columns from `first` on.
void subtractColumnsBefore(int first, int columns, int rows, double* values, int stride) {
  if (first > 0)
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, rows - first, columns, first, -1.0, values + first, stride, values + first, stride,
                1.0, values + static_cast<std::ptrdiff_t>(first) * (stride + 1), stride);
}

/// Processes strips of `width` columns in order: subtracts the columns before a strip, then factors it.
template <typename Factor>
int factorStrips(int width, int columns, int rows, double* values, int stride, const Factor& factor) {
  for (int first = 0; first < columns; first += width) {
    const int own = std::min(width, columns - first);
    subtractColumnsBefore(first, own, rows, values, stride);
    if (const int failed = factor(own, rows - first, values + static_cast<std::ptrdiff_t>(first) * (stride + 1)); failed > 0)
      return first + failed;
  }
  return 0;
}

}  // namespace

int partialCholesky(int columns, int rows, double* values, int stride) {
  return factorStrips(kBlock, columns, rows, values, stride, [stride](int block, int below, double* of) {
    return factorStrips(kPanel, block, below, of, stride,
                        [stride](int panel, int rest, double* own) { return factorPanel(panel, rest, own, stride); });
  });
}

void symmetricRankUpdate(int rows, int columns, const double* panel, int panelStride, double share, double* target, int targetStride) {
  for (int first = 0; first < rows; first += kColumns)
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, rows - first, std::min(kColumns, rows - first), columns, -1.0, panel + first,
                panelStride, panel + first, panelStride, share, target + static_cast<std::ptrdiff_t>(first) * (targetStride + 1),
                targetStride);
}

}  // namespace suture
