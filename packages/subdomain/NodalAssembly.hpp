#pragma once
#include <suture/algebra/SparseMatrix.hpp>
#include <suture/mesh/CellBlock.hpp>

#include <vector>

namespace suture {

/// Element matrices one behind the other: that of element e has components x its nodes rows and columns, node-major, by columns.
using ElementMatrices = std::vector<double>;

/// The lower triangle of their sum over nodes x components; element matrices are symmetric. Node by node, from the elements around each:
/// one pass for the pattern, one for the values, no list of entries to be sorted. Local.
SparseMatrix assembleNodal(const CellBlock& mesh, int components, const ElementMatrices& matrices);

}  // namespace suture
