#include <suture/base/Collective.hpp>
#include <suture/base/Dense.hpp>
#include <suture/precond/DeluxeWeighting.hpp>

namespace suture {

void DeluxeWeighting::doSetup(const InterfaceSpace& space, const LocalProblems& locals) {
  StiffnessDiagonalWeighting::doSetup(space, locals);
  blocks_.assign(locals.size(), {});
  const std::vector<EdgeSide> sides = edgeSides(space);
  // In unknowns of the edge: T S T, T the coefficients of the trace. A local problem that does not take part has no stiffness.
  const auto stiffness = exchangeEdges(space, sides, [&](const EdgeSide& side) {
    const int n = static_cast<int>(side.rows.size());
    if (!locals[side.local]) return Matrix(Matrix::Zero(n, n));
    return Matrix(side.coefficients.asDiagonal() * locals[side.local]->schurBlock(side.rows) * side.coefficients.asDiagonal());
  });
  collectively(*space.comm(), "weighting the edges", [&] {
    for (const EdgeSide& side : sides) {
      if (!locals[side.local]) continue;
      const Matrix& own = stiffness[side.edge][side.side];
      const Vector back = side.coefficients.cwiseInverse();
      const Matrix share = solvePositive(stiffness[side.edge][0] + stiffness[side.edge][1], own);
      blocks_[side.local].push_back({side.rows, back.asDiagonal() * share * back.asDiagonal()});
    }
  });
}

void DeluxeWeighting::doApply(int i, LocalView trace) const {
  std::vector<Matrix> edges;
  for (const Block& block : blocks_[i]) edges.push_back(block.weights * rowsAt(trace, block.rows));
  StiffnessDiagonalWeighting::doApply(i, trace);
  for (std::size_t k = 0; k < edges.size(); ++k)
    for (std::size_t row = 0; row < blocks_[i][k].rows.size(); ++row)
      trace.row(blocks_[i][k].rows[row]) = edges[k].row(static_cast<int>(row));
}

void DeluxeWeighting::doApplyTranspose(int i, LocalView flux) const {
  std::vector<Matrix> edges;
  for (const Block& block : blocks_[i]) edges.push_back(block.weights.transpose() * rowsAt(flux, block.rows));
  StiffnessDiagonalWeighting::doApplyTranspose(i, flux);
  for (std::size_t k = 0; k < edges.size(); ++k)
    for (std::size_t row = 0; row < blocks_[i][k].rows.size(); ++row)
      flux.row(blocks_[i][k].rows[row]) = edges[k].row(static_cast<int>(row));
}

}  // namespace suture
