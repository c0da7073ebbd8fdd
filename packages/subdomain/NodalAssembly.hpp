#pragma once
#include <suture/algebra/SparseMatrix.hpp>
#include <suture/mesh/CellBlock.hpp>

#include <vector>

namespace suture {

/// Consecutive element matrices: that of element e has components x its nodes rows and columns, node-major, by columns.
using ElementMatrices = std::vector<double>;

/// Lower triangle of the sum of the (symmetric) element matrices over nodes x components. Assembled node by node, from the elements around
/// each: one pass for the pattern, one for the values, no sorting of entries. Local.
SparseMatrix assembleNodal(const CellBlock& mesh, int components, const ElementMatrices& matrices);

}  // namespace suture
