#pragma once
#include <suture/base/Types.hpp>
#include <suture/mesh/CellBlock.hpp>

#include <array>
#include <vector>

namespace suture {

/// Place of a new node in the mesh from which it was made: its values are those of the element's shape functions there.
struct NodeOrigin {
  int element = -1;
  std::array<float, 3> at{};  ///< reference coordinates (ShapeFunctions.hpp), exact in single precision
};

/// Point of an element. Local. [length]
Point pointAt(const CellBlock& block, const NodeOrigin& origin);

/// A nodal field at new nodes. Local. \param values  nodes of the block x components \return origins x components
Matrix valuesAt(const CellBlock& block, const std::vector<NodeOrigin>& origins, const Matrix& values);

}  // namespace suture
