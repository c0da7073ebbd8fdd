#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Collective.hpp>
#include <suture/precond/AdaptiveConstraints.hpp>
#include <suture/precond/EntitySides.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <numeric>
#include <sstream>

namespace suture {

namespace {

constexpr double kMostOfInterface = 0.5;  // with more constraints a direct solver would be better

/// matrix^+ rhs for a right-hand side orthogonal to the kernel, by a shift at round-off level. The shift is increased until the
/// factorisation succeeds, as round-off of the matrix itself may be larger: a Schur complement of a nearly incompressible body is a small
/// difference of large terms.
Matrix solveSemidefinite(const Matrix& matrix, const Matrix& rhs) {
  for (double shift = 1e-12; shift < 1e-4; shift *= 10) {
    Matrix shifted = matrix, lower;
    shifted.diagonal() *= 1.0 + shift;
    if (!choleskyFactor(shifted, lower)) continue;
    Matrix solution = lower.triangularView<Eigen::Lower>().solve(rhs);
    lower.transpose().triangularView<Eigen::Upper>().solveInPlace(solution);
    return solution;
  }
  throw NumericalError("the stiffness of an edge of the interface is not positive semidefinite");
}

/// One sharer's part of the eigenproblem of an entity: first the n unknowns of the entity, then the c unknowns that are primal alone.
struct Part {
  Matrix stored;   ///< Schur complement of the sharer onto both groups
  Matrix block;    ///< the entity's block of S
  Matrix weights;  ///< the entity's block of D
};

/// One side of an entity in a sharer: rows of its trace.
struct SideOfLocal {
  const EntitySide* side;
  const AloneRows* points;
  Matrix* part;  ///< output

  std::vector<int> kept() const {
    std::vector<int> all = side->rows;
    all.insert(all.end(), points->rows.begin(), points->rows.end());
    return all;
  }
};

/// Schur complement of a semidefinite matrix onto some of its unknowns, in their order.
Matrix reducedTo(const Matrix& matrix, const std::vector<int>& kept) {
  std::vector<int> sorted = kept;
  std::sort(sorted.begin(), sorted.end());
  const std::vector<int> others = complement(static_cast<int>(matrix.rows()), sorted);
  Matrix reduced = pick(matrix, kept, kept);
  if (others.empty()) return reduced;
  const Matrix across = pick(matrix, others, kept);
  // Contact edges fix only one component: the free motions are a kernel, to which `across` is orthogonal.
  reduced -= across.transpose() * solveSemidefinite(pick(matrix, others, others), across);
  return reduced;
}

/// The parts of one local problem. Unknowns not needed by any of `sides` are eliminated, then recursively for each half of the sides; a
/// separate elimination for each side would cost more by half their number. \param schur  of the unknowns at `positions` of the trace,
/// ascending
void makeParts(const std::vector<SideOfLocal>& sides, const Matrix& whole, const Matrix& schur, const std::vector<int>& positions,
               const Weighting& weighting) {
  const auto placesOf = [&positions](const std::vector<int>& rows) {
    std::vector<int> places;
    for (const int row : rows)
      places.push_back(static_cast<int>(std::lower_bound(positions.begin(), positions.end(), row) - positions.begin()));
    return places;
  };
  if (sides.size() == 1) {
    const EntitySide& side = *sides[0].side;
    const int n = static_cast<int>(side.rows.size()), c = static_cast<int>(sides[0].points->rows.size());
    Vector coefficients(n + c);
    coefficients << side.coefficients, sides[0].points->coefficients;
    Matrix weights = Matrix::Zero(whole.rows(), n);
    for (int k = 0; k < n; ++k) weights(side.rows[k], k) = 1.0;
    weighting.apply(side.local, weights);
    Matrix& all = *sides[0].part;  // stored, block and weights side by side, the last two in the upper rows
    all = Matrix::Zero(n + c, 3 * n + c);
    const auto t = side.coefficients.asDiagonal();
    all.leftCols(n + c) = coefficients.asDiagonal() * reducedTo(schur, placesOf(sides[0].kept())) * coefficients.asDiagonal();
    all.block(0, n + c, n, n) = t * pick(whole, side.rows, side.rows) * t;
    all.block(0, 2 * n + c, n, n) = t * rowsAt(weights, side.rows) * t;
    return;
  }
  std::size_t count = 0, most = 0, middle = 0;
  for (const SideOfLocal& side : sides) most += side.side->rows.size();
  while (middle + 1 < sides.size() && (middle == 0 || 2 * count < most)) count += sides[middle++].side->rows.size();
  const std::vector<SideOfLocal> halves[2] = {{sides.begin(), sides.begin() + static_cast<std::ptrdiff_t>(middle)},
                                              {sides.begin() + static_cast<std::ptrdiff_t>(middle), sides.end()}};
  for (const std::vector<SideOfLocal>& half : halves) {
    std::vector<int> kept;
    for (const SideOfLocal& side : half) {
      const std::vector<int> own = side.kept();
      kept.insert(kept.end(), own.begin(), own.end());
    }
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    makeParts(half, whole, half.size() == 1 ? schur : reducedTo(schur, placesOf(kept)), half.size() == 1 ? positions : kept, weighting);
  }
}

Part split(const Matrix& all, int n) {
  const int both = static_cast<int>(all.rows());
  return {all.leftCols(both), all.block(0, both, n, n), all.block(0, both + n, n, n)};
}

Matrix symmetric(const Matrix& matrix) { return 0.5 * (matrix + matrix.transpose()); }

/// For a jump between two traces that vanishes at the points: its cost J after averaging, and its minimal energy E. Common rigid motions
/// are free.
void jumpOfTwo(const std::vector<Part>& parts, int n, Matrix& cost, Matrix& least) {
  const Part &a = parts[0], &b = parts[1];
  cost = b.weights.transpose() * a.block * b.weights + a.weights.transpose() * b.block * a.weights;
  least = (a.stored * solveSemidefinite(a.stored + b.stored, b.stored)).topLeftCorner(n, n);
}

/// The same for k traces, with stacked jumps y_i = w_i - w_k, i < k, where w_k is the trace of the stiffest sharer (this avoids differences
/// of large numbers in the energy of the softer ones). Averaging leaves P_i y = y_i - sum D_j y_j on sharer i; the energy is minimised over
/// the common motion.
void jumpOfSeveral(const std::vector<Part>& parts, int n, Matrix& cost, Matrix& least) {
  const int k = static_cast<int>(parts.size()), all = (k - 1) * n, common = static_cast<int>(parts[0].stored.rows());
  Matrix averaged(n, all);
  for (int i = 0; i + 1 < k; ++i) averaged.middleCols(i * n, n) = parts[i].weights;
  cost = Matrix::Zero(all, all);
  Matrix across = Matrix::Zero(all, common), together = Matrix::Zero(common, common);
  least = Matrix::Zero(all, all);
  for (int i = 0; i < k; ++i) {
    Matrix left = -averaged;
    if (i + 1 < k) {
      left.middleCols(i * n, n) += Matrix::Identity(n, n);
      across.middleRows(i * n, n) = parts[i].stored.topRows(n);
      least.block(i * n, i * n, n, n) = parts[i].stored.topLeftCorner(n, n);
    }
    cost += left.transpose() * parts[i].block * left;
    together += parts[i].stored;
  }
  least -= across * solveSemidefinite(together, across.transpose());
}

/// Orthonormal constraint rows of an entity with n unknowns. Sharers that do not take part are ignored; a single sharer has no jump.
Matrix chosenRows(const std::vector<Matrix>& sides, int n, double threshold) {
  std::vector<Part> parts;
  for (const Matrix& side : sides) {
    if (side.size() == 0) continue;
    if (side.rows() != sides[0].rows() && sides[0].size() > 0)
      throw InternalError("the sides of an interface entity have different shared points");
    parts.push_back(split(side, n));
  }
  if (parts.size() < 2) return Matrix(0, n);
  const auto softer = [](const Part& a, const Part& b) { return a.stored.trace() < b.stored.trace(); };
  if (parts.size() > 2) std::iter_swap(std::max_element(parts.begin(), parts.end(), softer), parts.end() - 1);
  Matrix cost, least, lower;
  if (parts.size() == 2)
    jumpOfTwo(parts, n, cost, least);
  else
    jumpOfSeveral(parts, n, cost, least);
  if (!choleskyFactor(symmetric(cost), lower)) throw NumericalError("an entity of the interface has no stiffness");
  // Solve the inverse eigenproblem: the stored energy may vanish, the cost of a jump does not.
  least = symmetric(least);
  lower.triangularView<Eigen::Lower>().solveInPlace(least);
  least = least.transpose().eval();
  lower.triangularView<Eigen::Lower>().solveInPlace(least);
  const Eigenpairs pairs = symmetricEigenpairs(symmetric(least));
  int count = 0;
  while (count < pairs.values.size() && pairs.values(count) * threshold < 1.0) ++count;
  // Each eigenvector constrains every jump: one column for two sharers, k - 1 for k.
  const Matrix demanded = lower * pairs.vectors.leftCols(count);
  const int jumps = static_cast<int>(parts.size()) - 1;
  Matrix columns(n, count * jumps);
  for (int i = 0; i < jumps; ++i) columns.middleCols(i * count, count) = demanded.middleRows(i * n, n);
  return orthonormalBasis(columns, 1e-12).transpose();
}

}  // namespace

Schema AdaptiveConstraints::schema() {
  Schema schema("Eigenvectors of a generalised eigenproblem on each edge and face, for coefficient jumps not aligned with the partition.");
  schema.real("Threshold", 5.0,
              "Eigenvectors with larger eigenvalues become constraints; the condition number stays below a multiple of it.",
              {1.0, 1e12, true, false, {}});
  return schema;
}

PrimalChoice AdaptiveConstraints::doChoose(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const {
  PrimalChoice choice{verticesAndEnds(space), {}};
  const std::vector<InterfaceEntity> entities = withoutAlone(space, choice.alone);
  const std::vector<EntitySide> sides = entitySides(space, entities);
  const std::vector<AloneRows> points = aloneRows(space, entities, sides, choice.alone);
  std::vector<Matrix> own(sides.size());
  collectively(*space.comm(), "adaptive constraints", [&] {
    std::vector<std::vector<SideOfLocal>> sidesOf(locals.size());
    for (std::size_t k = 0; k < sides.size(); ++k) sidesOf[sides[k].local].push_back({&sides[k], &points[k], &own[k]});
    for (std::size_t i = 0; i < locals.size(); ++i) {
      if (!locals[i] || sidesOf[i].empty()) continue;  // does not take part
      const Matrix schur = locals[i]->schur();
      std::vector<int> positions(schur.rows());
      std::iota(positions.begin(), positions.end(), 0);
      makeParts(sidesOf[i], schur, schur, positions, weighting);
    }
  });
  const auto all = exchangeSides(space, entities, sides, [&](std::size_t k) { return own[k]; });
  collectively(*space.comm(), "adaptive constraints", [&] {
    for (std::size_t e = 0; e < all.size(); ++e) {
      const auto n = static_cast<int>(entities[e].unknowns.size());
      choice.rows.push_back(n > 0 ? chosenRows(all[e], n, threshold_) : Matrix(0, 0));
    }
  });
  refuseTooMany(space, sides, choice);
  return choice;
}

/// An entity is counted on the rank of its first sharer.
void AdaptiveConstraints::refuseTooMany(const InterfaceSpace& space, const std::vector<EntitySide>& sides,
                                        const PrimalChoice& choice) const {
  double mine[2] = {0.0, 0.0}, sums[2];
  for (const EntitySide& side : sides)
    if (side.side == 0) {
      mine[0] += static_cast<double>(choice.rows[side.entity].rows());
      mine[1] += static_cast<double>(choice.rows[side.entity].cols());
    }
  Teuchos::reduceAll(*space.comm(), Teuchos::REDUCE_SUM, 2, mine, sums);
  if (sums[1] < 100.0 || sums[0] <= kMostOfInterface * sums[1]) return;
  std::ostringstream text;
  text << "a threshold of " << threshold_ << " selects " << sums[0] << " constraints for " << sums[1]
       << " unknowns on edges: the coarse problem would be as large as the interface. Use a threshold of 3 to 100";
  throw InputError("Preconditioner/BDDC/Adaptive/Threshold", text.str());
}

}  // namespace suture
