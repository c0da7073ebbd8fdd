#include <suture/algebra/Blas.hpp>
#include <suture/algebra/SparseConstrainedInverse.hpp>
#include <suture/algebra/Trial.hpp>
#include <suture/algebra/WorkSpace.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/algebra/elimination/SingleFactor.hpp>
#include <suture/base/Errors.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kZeroEntry = 1e-14;     // entries of a constraint below this are treated as zero
constexpr double kMostCondition = 1e13;  // condition of the small matrix: beyond it a constraint depends linearly on the others
constexpr double kHeld = 1e-6;           // smallest size at the held unknowns of a motion of length one
// Largest relative change of an image by single precision that is accepted: conjugate gradients do not notice it.
constexpr double kSingleAccuracy = 1e-3;
constexpr double kMostJumpForSingle = 1e3;  // largest by smallest diagonal: beyond it, soft cells would lose all digits

/// The only entry of a row with one entry, or -1.
int singleEntry(const Matrix& rows, int row) {
  int found = -1, count = 0;
  for (int j = 0; j < rows.cols() && count < 2; ++j)
    if (std::abs(rows(row, j)) > kZeroEntry) found = j, ++count;
  return count == 1 ? found : -1;
}

Matrix rowsOf(const Matrix& matrix, const std::vector<int>& rows) {
  Matrix some(static_cast<Eigen::Index>(rows.size()), matrix.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) some.row(static_cast<Eigen::Index>(i)) = matrix.row(rows[i]);
  return some;
}

/// Unknowns that best determine the motions left by the held ones; inside, where there are no constraints, if possible.
std::vector<int> fixing(const Matrix& kernel, const std::vector<int>& held, const std::vector<int>& inside, const std::vector<int>& free) {
  if (kernel.cols() == 0) return {};
  const Matrix motions = orthonormalBasis(kernel, 1e-12);
  const double size = std::sqrt(static_cast<double>(motions.rows()));  // a motion of the order of one at each unknown
  const Matrix left = motions * nullSpace(size * rowsOf(motions, held), kHeld);
  if (left.cols() == 0) return {};
  for (const std::vector<int>* among : {&inside, &free}) {
    const Matrix here = rowsOf(left, *among);
    if (here.rows() < here.cols()) continue;
    std::vector<int> found;
    for (const int row : pivotRows(here)) found.push_back((*among)[row]);
    const Matrix told = size * rowsOf(left, found);
    if (nullSpace(told, kHeld).cols() > 0) continue;
    std::sort(found.begin(), found.end());
    return found;
  }
  return {};
}

}  // namespace

/// Kinds of unknowns and constraints: numbers in the stiffness matrix, and positions in these lists.
struct SparseConstrainedInverse::Unknowns {
  std::vector<int> held, heldRows, otherRows;  // positions in the trace held by a single constraint, these constraints, the others
  std::vector<int> heldUnknowns, apart, free;  // H, E and F, as numbers in the matrix
  Matrix onApart, onHeld;                      // C_2 on E and on H: constraints x unknowns
};

SparseConstrainedInverse::SparseConstrainedInverse(const SparseMatrix& stiffness, const Matrix& kernel, const std::vector<int>& boundary,
                                                   const Matrix& constraints, const LocalSolverMaker& solver, const std::string& what)
    : constraints_(constraints.transpose().sparseView(1.0, kZeroEntry)) {
  const int n = static_cast<int>(stiffness.rows()), m = static_cast<int>(constraints.rows()), size = static_cast<int>(boundary.size());
  Unknowns all;
  for (int row = 0; row < m; ++row) {
    const int single = singleEntry(constraints, row);
    if (single >= 0 && std::count(all.held.begin(), all.held.end(), single) > 0)
      throw NumericalError(what + ": a primal constraint depends linearly on the others");
    (single >= 0 ? all.heldRows : all.otherRows).push_back(row);
    if (single >= 0) all.held.push_back(single);
  }
  std::vector<char> kind(n, 'i');  // inside, on the trace, held, apart
  for (const int unknown : boundary) kind[unknown] = 't';
  for (const int position : all.held) {
    all.heldUnknowns.push_back(boundary[position]);
    kind[boundary[position]] = 'h';
  }
  std::vector<int> inside, candidates;
  for (int unknown = 0; unknown < n; ++unknown) {
    if (kind[unknown] == 'i') inside.push_back(unknown);
    if (kind[unknown] != 'h') candidates.push_back(unknown);
  }
  all.apart = fixing(kernel, all.heldUnknowns, inside, candidates);
  for (const int unknown : all.apart) kind[unknown] = 'e';
  for (const int unknown : candidates)
    if (kind[unknown] != 'e') all.free.push_back(unknown);

  unknowns_ = static_cast<int>(all.free.size());
  const int motions = static_cast<int>(all.apart.size());
  std::vector<int> placeOf(n, -1);
  for (std::size_t i = 0; i < all.free.size(); ++i) placeOf[all.free[i]] = static_cast<int>(i);
  for (std::size_t i = 0; i < all.apart.size(); ++i) placeOf[all.apart[i]] = static_cast<int>(i);
  std::vector<std::pair<int, int>> apart;  // E on the trace: position in the trace, among E
  for (int k = 0; k < size; ++k) {
    const int unknown = boundary[k];
    if (kind[unknown] == 't') places_.emplace_back(k, placeOf[unknown]);
    if (kind[unknown] == 'e') apart.emplace_back(k, placeOf[unknown]);
  }
  factor_ = solver();
  factor_->factorise(principalBlock(stiffness, all.free));

  const int others = static_cast<int>(all.otherRows.size()), fixed = static_cast<int>(all.held.size()), more = motions + others;
  all.onApart = Matrix::Zero(others, motions);
  all.onHeld = Matrix(others, fixed);
  for (int k = 0; k < others; ++k) {
    for (const auto& [position, place] : apart) all.onApart(k, place) = constraints(all.otherRows[k], position);
    for (int j = 0; j < fixed; ++j) all.onHeld(k, j) = constraints(all.otherRows[k], all.held[j]);
  }
  // Right-hand sides of all solves: K_FE, C_F^T, and K_FH.
  const SparseMatrix columns = columnsOf(block(stiffness, all.free, all.apart), all.otherRows);
  const SparseMatrix toHeld = block(stiffness, all.free, all.heldUnknowns);
  Matrix solved(unknowns_, more + fixed);
  solved << Matrix(columns), Matrix(toHeld);
  if (solved.size() > 0) factor_->solve(solved);
  const auto images = solved.leftCols(more), fromHeld = solved.rightCols(fixed);
  const Matrix small = invertedSmall(stiffness, all, columns.transpose() * images, what);

  // Traces of least energy: x_H given, K_FF x_F + K_FE x_E + C_F^T m = -K_FH x_H and so on; -m are the energies. A constraint that holds a
  // single unknown gives one column of x_H: that unknown, scaled.
  Vector scale(fixed);
  for (int j = 0; j < fixed; ++j) scale(j) = 1.0 / constraints(all.heldRows[j], all.held[j]);
  const SparseMatrix apartHeld = block(stiffness, all.apart, all.heldUnknowns);
  Matrix ofHeld = columns.transpose() * fromHeld;
  ofHeld.topRows(motions) -= Matrix(apartHeld);
  ofHeld.bottomRows(others) -= all.onHeld;
  Matrix right = Matrix::Zero(more, m);
  for (int k = 0; k < others; ++k) right(motions + k, all.otherRows[k]) = 1.0;
  for (int j = 0; j < fixed; ++j) right.col(all.heldRows[j]) += scale(j) * ofHeld.col(j);
  const Matrix reduced = product(CblasNoTrans, small, right);
  Matrix onTrace = Matrix::Zero(size, more), basis = Matrix::Zero(size, m);
  for (const auto& [position, place] : places_) {
    onTrace.row(position) = images.row(place);
    for (int j = 0; j < fixed; ++j) basis(position, all.heldRows[j]) = -scale(j) * fromHeld(place, j);
  }
  addProductTo(-1.0, CblasNoTrans, onTrace, reduced, 1.0, basis);
  for (const auto& [position, place] : apart) basis.row(position) = reduced.row(place);
  for (int j = 0; j < fixed; ++j) basis(all.held[j], all.heldRows[j]) = scale(j);

  Matrix energy(m, m);
  for (int k = 0; k < others; ++k) energy.row(all.otherRows[k]) = -reduced.row(motions + k);
  const Matrix heldImages = toHeld.transpose() * images;
  Matrix onHeld = apartHeld.transpose() * reduced.topRows(motions) + all.onHeld.transpose() * reduced.bottomRows(others);
  addProductTo(-1.0, CblasNoTrans, heldImages, reduced, 1.0, onHeld);
  const Matrix heldHeld = Matrix(block(stiffness, all.heldUnknowns, all.heldUnknowns)) - toHeld.transpose() * fromHeld;
  for (int j = 0; j < fixed; ++j) onHeld.col(all.heldRows[j]) += scale(j) * heldHeld.col(j);
  for (int j = 0; j < fixed; ++j) energy.row(all.heldRows[j]) = scale(j) * onHeld.row(j);
  energy_ = 0.5 * (energy + energy.transpose());

  const Vector diagonal = stiffness.diagonal();
  const bool isEven = diagonal.maxCoeff() <= kMostJumpForSingle * diagonal.minCoeff();
  basis_ = PackedColumns(basis, isEven ? PackedSymmetric::Precision::Single : PackedSymmetric::Precision::Double);
  if (isEven && !tryInSinglePrecision()) basis_ = PackedColumns(basis);
}

SparseConstrainedInverse::~SparseConstrainedInverse() = default;

/// [K_FE, C_F^T]
SparseMatrix SparseConstrainedInverse::columnsOf(const SparseMatrix& toApart, const std::vector<int>& rows) const {
  std::vector<int> placeAt(constraints_.rows(), -1);
  for (const auto& [position, place] : places_) placeAt[position] = place;
  std::vector<Eigen::Triplet<double>> entries;
  const int motions = static_cast<int>(toApart.cols());
  for (int j = 0; j < motions; ++j)
    for (SparseMatrix::InnerIterator it(toApart, j); it; ++it) entries.emplace_back(static_cast<int>(it.row()), j, it.value());
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (SparseMatrix::InnerIterator it(constraints_, rows[k]); it; ++it)
      if (placeAt[it.row()] >= 0) entries.emplace_back(placeAt[it.row()], motions + static_cast<int>(k), it.value());
  SparseMatrix columns(unknowns_, motions + static_cast<int>(rows.size()));
  columns.setFromTriplets(entries.begin(), entries.end());
  return columns;
}

bool SparseConstrainedInverse::tryInSinglePrecision() {
  if (unknowns_ == 0) return false;
  std::unique_ptr<SingleFactor> made = factor_->inSinglePrecision();
  if (!made) return false;
  const auto applied = [this](ConstLocalView flux, LocalView trace) { apply(flux, trace); };
  if (effectOf(static_cast<int>(basis_.rows()), applied, [&] { single_ = std::move(made); }) <= kSingleAccuracy) {
    factor_.reset();
    return true;
  }
  single_.reset();
  return false;
}

double SparseConstrainedInverse::bytesRead() const {
  return single_ ? 2.0 * (single_->bytes() + static_cast<double>(constraints_.nonZeros() * (sizeof(double) + sizeof(int)))) : 0.0;
}

/// The inverse of the small matrix. The third argument is [K_FE, C_F^T]^T W.
Matrix SparseConstrainedInverse::invertedSmall(const SparseMatrix& stiffness, const Unknowns& all, const Matrix& told,
                                               const std::string& what) const {
  const int others = static_cast<int>(all.otherRows.size()), motions = static_cast<int>(all.apart.size());
  Matrix small = -0.5 * (told + told.transpose());
  if (small.rows() == 0) return small;
  small.topLeftCorner(motions, motions) += Matrix(block(stiffness, all.apart, all.apart));
  small.bottomLeftCorner(others, motions) += all.onApart;
  small.topRightCorner(motions, others) += all.onApart.transpose();
  // Scales displacements and forces to the same units: the matrix is then of order one, except for jumps of the stiffness.
  double stiff = 0.0;
  for (const int unknown : all.free) stiff += stiffness.coeff(unknown, unknown) / unknowns_;
  Vector scale(small.rows());
  scale << Vector::Constant(motions, 1.0 / std::sqrt(stiff)), Vector::Constant(others, std::sqrt(stiff));
  double condition = 0.0;
  const Matrix inverse = generalInverse(scale.asDiagonal() * small * scale.asDiagonal(), condition);
  if (!(condition < kMostCondition))
    throw NumericalError(what + ": a primal constraint depends linearly on the others, or the constraints leave a motion");
  small = scale.asDiagonal() * inverse * scale.asDiagonal();
  return 0.5 * (small + small.transpose());
}

void SparseConstrainedInverse::apply(ConstLocalView flux, LocalView trace) const {
  Matrix told(basis_.columns(), flux.cols());
  Vector one;
  for (Eigen::Index column = 0; column < flux.cols(); ++column) {
    basis_.multiplyTransposed(flux.col(column), one);
    told.col(column) = one;
  }
  const Vector none = Vector::Zero(basis_.columns());
  applyTo(flux, told, none, trace);
}

void SparseConstrainedInverse::applyWithBasis(ConstLocalView flux, const Vector& told, const Vector& values, LocalView trace) const {
  applyTo(flux, told, values, trace);
}

void SparseConstrainedInverse::applyTo(ConstLocalView flux, const Eigen::Ref<const Matrix>& told, const Vector& values,
                                       LocalView trace) const {
  thread_local std::vector<double> kept;
  WorkSpace space(unknowns_, flux.cols(), kept);
  Eigen::Map<Matrix>& inside = space.values;
  inside.setZero();
  trace.noalias() = flux - constraints_ * told;
  for (const auto& [position, place] : places_) inside.row(place) = trace.row(position);
  if (single_)
    single_->apply(inside, inside);
  else if (unknowns_ > 0)
    factor_->solve(inside);
  trace.setZero();
  for (const auto& [position, place] : places_) trace.row(position) = inside.row(place);
  if (basis_.columns() == 0) return;
  Vector missing;
  for (Eigen::Index column = 0; column < flux.cols(); ++column) {
    missing = values;
    missing.noalias() -= constraints_.transpose() * trace.col(column);
    basis_.addProduct(missing, trace.col(column));
  }
}

}  // namespace suture
