#pragma once
#include <support/Blocks.hpp>
#include <suture/interface/InterfaceOperator.hpp>

namespace suture::blocks {

/// Three sheets of bricks glued along one line: an edge shared by three local problems, as in 3D. The first is clamped, the second floats;
/// the third, clamped as well, has bricks of another size, so that their jumps cut the line elsewhere.
struct Sheets {
  std::vector<Matrix> schur;                     ///< Schur complement of each sheet, onto the line
  std::vector<int> inner;                        ///< unknowns of the line that are at neither end
  Teuchos::RCP<const InterfaceOperator> matrix;  ///< sheets distributed over the ranks

  /// \param jump  between bricks; \param stiffness  of each sheet, a factor
  explicit Sheets(const CommPtr& comm, double jump = 1e4, const std::vector<double>& stiffness = {1.0, 1.0, 1.0});
};

}  // namespace suture::blocks
