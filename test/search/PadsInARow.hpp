#pragma once
#include <suture/base/Types.hpp>

namespace padsinarow {

/// Motions of pads between bodies in a row along a line, pads x bodies: pad i is between body i - 1 and body i; walls before the first and
/// behind the last body.
inline suture::SparseRows padsInARow(int bodies) {
  suture::Matrix rows = suture::Matrix::Zero(bodies + 1, bodies);
  for (int k = 0; k < bodies; ++k) rows(k, k) = -1.0, rows(k + 1, k) = 1.0;
  return rows.sparseView();
}

}  // namespace padsinarow
