#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Collective.hpp>
#include <suture/precond/EntitySides.hpp>
#include <suture/precond/VolumetricPrimalModes.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <random>

namespace suture {

namespace {

// Thresholds relative to the stiffness against change of shape. A trace below them multiplies the condition number by about a twentieth of
// its stiffness.
constexpr double kStiff = 20.0;         // threshold for a trace of a subdomain
constexpr double kStiffOnEntity = 0.5;  // threshold for the part of a trace that weighting leaves on an entity
constexpr int kMostSteps = 10;

Matrix randomColumns(int rows, int columns) {
  std::mt19937 next;  // std distributions differ between platforms, this generator does not
  Matrix values(rows, columns);
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) values(i, j) = static_cast<double>(next()) / 4294967295.0 - 0.5;
  return values;
}

/// Columns of one side, in the unknowns of the entity: the shear stiffness; then for two sharers (I - D_i)^T V_i, the part of V_i that the
/// weights of the other sharer leave; for more sharers V_i and D_i, which the others need.
Matrix sideColumns(const EntitySide& side, int sharers, const LocalProblem& local, const Matrix& traces, const Weighting& weighting) {
  const Vector squares = side.coefficients.cwiseAbs2();
  const Matrix own = rowsAt(traces, side.rows);
  const auto n = static_cast<int>(own.rows()), count = static_cast<int>(own.cols());
  const auto toEntity = side.coefficients.asDiagonal();
  Matrix all(n, 1 + count + (sharers > 2 ? n : 0));
  all.col(0) = squares.cwiseProduct(Vector(rowsAt(local.hint(Hint::kShearDiagonal), side.rows)));
  if (sharers > 2) {
    Matrix weights = Matrix::Zero(local.size(), n);
    for (int k = 0; k < n; ++k) weights(side.rows[k], k) = 1.0;
    weighting.apply(side.local, weights);
    all.middleCols(1, count) = toEntity * own;
    all.rightCols(n) = toEntity * rowsAt(weights, side.rows) * toEntity;
    return all;
  }
  Matrix weighted = Matrix::Zero(local.size(), count);
  for (int k = 0; k < n; ++k) weighted.row(side.rows[k]) = squares(k) * own.row(k);
  weighting.applyTranspose(side.local, weighted);
  all.rightCols(count) = toEntity * (own - rowsAt(weighted, side.rows));
  return all;
}

/// D_j^T V_i for all pairs of sharers, because averaging leaves sum_j D_j (w_i - w_j) on sharer i.
Matrix leftOver(const std::vector<Matrix>& sides) {
  const auto n = sides[0].rows();
  const bool several = sides.size() > 2;
  std::vector<Matrix> parts;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (!several) parts.push_back(sides[i].rightCols(sides[i].cols() - 1));
    for (std::size_t j = 0; j < sides.size() && several; ++j)
      if (j != i) parts.push_back(sides[j].rightCols(n).transpose() * sides[i].middleCols(1, sides[i].cols() - 1 - n));
  }
  Eigen::Index count = 0;
  for (const Matrix& part : parts) count += part.cols();
  Matrix columns(n, count);
  count = 0;
  for (const Matrix& part : parts) {
    columns.middleCols(count, part.cols()) = part;
    count += part.cols();
  }
  return columns;
}

Matrix withColumns(const Matrix& rows, const std::vector<Matrix>& sides) {
  if (sides.empty() || std::any_of(sides.begin(), sides.end(), [](const Matrix& side) { return side.size() == 0; })) return rows;
  Matrix columns = leftOver(sides);
  if (columns.cols() == 0) return rows;
  // A jump acts on springs in series: scale by the harmonic mean of the sides' stiffness.
  Vector give = Vector::Zero(columns.rows());
  for (const Matrix& side : sides) give += side.col(0).cwiseInverse();
  const Vector scale = (static_cast<double>(sides.size()) * give.cwiseInverse()).cwiseSqrt();
  columns = scale.cwiseInverse().asDiagonal() * columns;
  const Matrix known = orthonormalBasis(scale.cwiseInverse().asDiagonal() * rows.transpose(), 1e-12);
  for (int pass = 0; pass < 2; ++pass) columns -= (known * (known.transpose() * columns)).eval();
  const SingularValues svd = singularValues(columns);
  int count = 0;
  while (count < svd.values.size() && svd.values(count) * svd.values(count) > kStiffOnEntity) ++count;
  if (count == 0) return rows;
  Matrix all(columns.rows(), known.cols() + count);
  all << known, svd.u.leftCols(count);
  return orthonormalBasis(scale.asDiagonal() * all, 1e-12).transpose();
}

}  // namespace

Matrix stiffTraces(const LocalProblem& local) {
  const int n = local.size();
  const Matrix& shear = local.hint(Hint::kShearDiagonal);
  if (shear.cols() == 0 || n == 0) return Matrix(n, 0);
  const Vector scale = shear.col(0).cwiseSqrt();
  for (int block = std::min(8, n);; block = std::min(2 * block, n)) {
    Matrix basis = orthonormalBasis(randomColumns(n, block), 1e-12), image;
    for (int step = 0; step < kMostSteps; ++step) {
      image.resize(n, basis.cols());  // fewer columns than before if S has a kernel
      local.applySchur(scale.cwiseInverse().asDiagonal() * basis, image);
      image = scale.cwiseInverse().asDiagonal() * image;
      const Eigenpairs pairs = symmetricEigenpairs(basis.transpose() * image);
      const int m = static_cast<int>(pairs.values.size());
      int count = 0;
      while (count < m && pairs.values(m - 1 - count) > kStiff) ++count;
      const Vector values = pairs.values.tail(count);
      const Matrix found = basis * pairs.vectors.rightCols(count);
      const Matrix missed = image * pairs.vectors.rightCols(count) - found * values.asDiagonal();
      // The residual couples a direction with the rest: it must be small compared with the stiffness there, which is of order one.
      const bool settled = (missed.colwise().squaredNorm().array() < 1e-2).all() && (count > 0 || step > 2);
      if (count == m && m < n) break;  // there may be more stiff directions
      if (settled || step + 1 == kMostSteps || m == n) return scale.asDiagonal() * found * values.cwiseSqrt().asDiagonal();
      basis = orthonormalBasis(image, 1e-14);
    }
  }
}

PrimalChoice VolumetricPrimalModes::doChoose(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const {
  PrimalChoice choice = plainChoice(*plain_, space, locals, weighting);
  const auto incompressible = [](const auto& local) { return local && local->hint(Hint::kShearDiagonal).cols() > 0; };
  const int mine = std::any_of(locals.begin(), locals.end(), incompressible);
  int any = 0;
  Teuchos::reduceAll(*space.comm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
  if (!any) return choice;
  locals_.resize(locals.size());
  traces_.resize(locals.size());
  collectively(*space.comm(), "stiff traces of nearly incompressible subdomains", [&] {
    for (std::size_t i = 0; i < locals.size(); ++i) {
      if (incompressible(locals[i]) && locals_[i] != locals[i]) traces_[i] = stiffTraces(*locals[i]);
      locals_[i] = locals[i];
    }
  });
  const std::vector<InterfaceEntity> entities = withoutAlone(space, choice.alone);
  const std::vector<EntitySide> sides = entitySides(space, entities);
  const auto all = exchangeSides(space, entities, sides, [&](std::size_t k) {
    const int local = sides[k].local;
    if (!incompressible(locals[local])) return Matrix();
    return sideColumns(sides[k], static_cast<int>(entities[sides[k].entity].sharers.size()), *locals[local], traces_[local], weighting);
  });
  collectively(*space.comm(), "entities of nearly incompressible subdomains", [&] {
    for (std::size_t e = 0; e < entities.size(); ++e) choice.rows[e] = withColumns(choice.rows[e], all[e]);
  });
  return choice;
}

}  // namespace suture
