#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Collective.hpp>
#include <suture/precond/DeluxeWeighting.hpp>
#include <suture/precond/EntitySides.hpp>

namespace suture {

namespace {

/// Entities with dense weights: edges and faces without their ends, and vertices whose unknowns no relation joins.
std::vector<InterfaceEntity> weighed(const InterfaceSpace& space) {
  std::vector<char> apart(space.overlapSize(), 0);
  for (const InterfaceEntity& entity : space.entities())
    for (const int place : entity.ends) apart[place] = 1;
  std::vector<char> joined(space.overlapSize(), 0);
  for (int place = 0; place < space.overlapSize(); ++place)
    if (const InterfaceRelation* by = space.relation(place))
      for (const int other : by->others) joined[other] = 1;
  for (const InterfaceEntity& entity : space.entities())
    if (entity.kind == EntityKind::Vertex)
      for (const int place : entity.unknowns) apart[place] = joined[place];
  return withoutAlone(space, apart);
}

}  // namespace

void DeluxeWeighting::doSetup(const InterfaceSpace& space, const LocalProblems& locals) {
  StiffnessDiagonalWeighting::doSetup(space, locals);
  blocks_.assign(locals.size(), {});
  const std::vector<InterfaceEntity> entities = weighed(space);
  const std::vector<EntitySide> sides = entitySides(space, entities);
  // In unknowns of the entity: T S T, with T the coefficients of the trace. Local problems that do not take part have zero stiffness.
  const auto stiffness = exchangeSides(space, entities, sides, [&](std::size_t k) {
    const EntitySide& side = sides[k];
    const int n = static_cast<int>(side.rows.size());
    if (!locals[side.local]) return Matrix(Matrix::Zero(n, n));
    return Matrix(side.coefficients.asDiagonal() * locals[side.local]->schurBlock(side.rows) * side.coefficients.asDiagonal());
  });
  collectively(*space.comm(), "weighting the entities", [&] {
    for (const EntitySide& side : sides) {
      if (!locals[side.local]) continue;
      const std::vector<Matrix>& all = stiffness[side.entity];
      Matrix sum = all[0];
      for (std::size_t k = 1; k < all.size(); ++k) sum += all[k];
      const Vector back = side.coefficients.cwiseInverse();
      const Matrix share = solvePositive(sum, all[side.side]);
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
