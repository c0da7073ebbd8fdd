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

constexpr double kZeroEntry = 1e-14;     // entry of a constraint that counts as none
constexpr double kMostCondition = 1e13;  // condition of the small matrix: beyond it a constraint follows from the others
constexpr double kHeld = 1e-6;           // least that held unknowns tell of a motion of length one
// Largest relative change of an image that single precision may make: conjugate gradients do not notice it.
constexpr double kSingleAccuracy = 1e-3;
constexpr double kMostJumpForSingle = 1e3;  // largest by smallest diagonal: soft cells would have no digits

/// Entry of a row that has one only, or -1.
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

/// Unknowns on which the motions that the held ones leave are determined best; inside, where no constraint is, if they are there.
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

/// Kinds of unknowns and constraints: numbers in the stiffness matrix, and places in these lists.
struct SparseConstrainedInverse::Unknowns {
  std::vector<int> held, heldRows, otherRows;  // positions in the trace that constraints hold alone, these constraints, the others
  std::vector<int> heldUnknowns, apart, free;  // H, E and F, in the numbers of the matrix
  Matrix onFree, onApart, onHeld;              // C_2 on F (unknowns x constraints), on E and on H (constraints x unknowns)
};

SparseConstrainedInverse::SparseConstrainedInverse(const SparseMatrix& stiffness, const Matrix& kernel, const std::vector<int>& boundary,
                                                   const Matrix& constraints, const LocalSolverMaker& solver, const std::string& what) {
  const int n = static_cast<int>(stiffness.rows()), m = static_cast<int>(constraints.rows()), size = static_cast<int>(boundary.size());
  Unknowns all;
  for (int row = 0; row < m; ++row) {
    const int single = singleEntry(constraints, row);
    if (single >= 0 && std::count(all.held.begin(), all.held.end(), single) > 0)
      throw NumericalError(what + ": a primal constraint follows from the others");
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
  motions_ = static_cast<int>(all.apart.size());
  std::vector<int> placeOf(n, -1);
  for (std::size_t i = 0; i < all.free.size(); ++i) placeOf[all.free[i]] = static_cast<int>(i);
  for (std::size_t i = 0; i < all.apart.size(); ++i) placeOf[all.apart[i]] = static_cast<int>(i);
  for (int k = 0; k < size; ++k) {
    const int unknown = boundary[k];
    if (kind[unknown] == 't') places_.emplace_back(k, placeOf[unknown]);
    if (kind[unknown] == 'e') apart_.emplace_back(k, placeOf[unknown]);
  }
  factor_ = solver();
  factor_->factorise(principalBlock(stiffness, all.free));

  const int others = static_cast<int>(all.otherRows.size()), fixed = static_cast<int>(all.held.size());
  all.onFree = Matrix::Zero(unknowns_, others);
  all.onApart = Matrix::Zero(others, motions_);
  all.onHeld = Matrix(others, fixed);
  for (int k = 0; k < others; ++k) {
    for (const auto& [position, place] : places_) all.onFree(place, k) = constraints(all.otherRows[k], position);
    for (const auto& [position, place] : apart_) all.onApart(k, place) = constraints(all.otherRows[k], position);
    for (int j = 0; j < fixed; ++j) all.onHeld(k, j) = constraints(all.otherRows[k], all.held[j]);
  }
  // Right-hand sides of all that is needed: K_FE, C_F^T, and K_FH times the values of what is held.
  Matrix values = Matrix::Zero(fixed, m);
  for (int j = 0; j < fixed; ++j) values(j, all.heldRows[j]) = 1.0 / constraints(all.heldRows[j], all.held[j]);
  Matrix columns(unknowns_, motions_ + others);
  columns << Matrix(block(stiffness, all.free, all.apart)), all.onFree;
  Matrix solved(unknowns_, columns.cols() + fixed);
  const SparseMatrix toHeld = block(stiffness, all.free, all.heldUnknowns);
  solved << columns, Matrix(toHeld);
  if (solved.size() > 0) factor_->solve(solved);
  const Matrix images = solved.leftCols(columns.cols());
  const Matrix small = smallMatrix(stiffness, all, columns, images);
  // Displacements and forces in the same units: then the matrix is of the order of one, but for jumps of the stiffness.
  double stiff = 0.0;
  for (const int unknown : all.free) stiff += stiffness.coeff(unknown, unknown) / unknowns_;
  Vector scale(small.rows());
  scale << Vector::Constant(motions_, 1.0 / std::sqrt(stiff)), Vector::Constant(others, std::sqrt(stiff));
  if (small.rows() > 0) {
    double condition = 0.0;
    small_ = generalInverse(scale.asDiagonal() * small * scale.asDiagonal(), condition);
    if (!(condition < kMostCondition)) throw NumericalError(what + ": a primal constraint follows from the others, or they leave a motion");
    small_ = (scale.asDiagonal() * small_ * scale.asDiagonal()).eval();
    small_ = 0.5 * (small_ + small_.transpose()).eval();
  }

  // Traces of least energy: x_H given, K_FF x_F + K_FE x_E + C_F^T m = -K_FH x_H and so on; -m are the energies.
  const Matrix fromHeld = product<double>(CblasNoTrans, solved.rightCols(fixed), values);  // K_FF^-1 K_FH x_H
  Matrix right(motions_ + others, m);
  const SparseMatrix apartHeld = block(stiffness, all.apart, all.heldUnknowns);
  const Matrix energies = product(CblasTrans, columns, fromHeld);
  right.topRows(motions_) = energies.topRows(motions_) - apartHeld * values;
  Matrix wanted = Matrix::Zero(others, m);
  for (int k = 0; k < others; ++k) wanted(k, all.otherRows[k]) = 1.0;
  right.bottomRows(others) = wanted - product(CblasNoTrans, all.onHeld, values) + energies.bottomRows(others);
  const Matrix reduced = product(CblasNoTrans, small_, right);
  Matrix onFree = -fromHeld;
  addProductTo(-1.0, CblasNoTrans, images, reduced, 1.0, onFree);
  Matrix basis = Matrix::Zero(size, m);
  for (const auto& [position, place] : places_) basis.row(position) = onFree.row(place);
  for (const auto& [position, place] : apart_) basis.row(position) = reduced.row(place);
  for (int j = 0; j < fixed; ++j) basis.row(all.held[j]) = values.row(j);

  Matrix energy(m, m);
  for (int k = 0; k < others; ++k) energy.row(all.otherRows[k]) = -reduced.row(motions_ + k);
  const SparseMatrix heldHeld = block(stiffness, all.heldUnknowns, all.heldUnknowns);
  const Matrix onHeld = toHeld.transpose() * onFree + apartHeld.transpose() * reduced.topRows(motions_) + heldHeld * values +
                        all.onHeld.transpose() * reduced.bottomRows(others);
  for (int j = 0; j < fixed; ++j) energy.row(all.heldRows[j]) = values(j, all.heldRows[j]) * onHeld.row(j);
  energy_ = 0.5 * (energy + energy.transpose());

  Matrix onTrace = Matrix::Zero(size, images.cols());
  for (const auto& [position, place] : places_) onTrace.row(position) = images.row(place);
  images_ = PackedColumns(onTrace);
  const Vector diagonal = stiffness.diagonal();
  tryInSinglePrecision(diagonal.maxCoeff() / diagonal.minCoeff());
  const auto precision = single_ ? PackedSymmetric::Precision::Single : PackedSymmetric::Precision::Double;
  basis_ = PackedColumns(basis, precision);
  if (single_) images_ = PackedColumns(onTrace, precision);
}

SparseConstrainedInverse::~SparseConstrainedInverse() = default;

void SparseConstrainedInverse::tryInSinglePrecision(double jump) {
  if (unknowns_ == 0 || jump > kMostJumpForSingle) return;
  std::unique_ptr<SingleFactor> made = factor_->inSinglePrecision();
  if (!made) return;
  const auto applied = [this](ConstLocalView flux, LocalView trace) { apply(flux, trace); };
  if (effectOf(static_cast<int>(images_.rows()), applied, [&] { single_ = std::move(made); }) <= kSingleAccuracy)
    factor_.reset();
  else
    single_.reset();
}

double SparseConstrainedInverse::bytesRead() const { return single_ ? 2.0 * (single_->bytes() + images_.bytes()) : 0.0; }

Matrix SparseConstrainedInverse::smallMatrix(const SparseMatrix& stiffness, const Unknowns& all, const Matrix& columns,
                                             const Matrix& images) const {
  Matrix small = -product(CblasTrans, columns, images);
  const int others = static_cast<int>(all.otherRows.size());
  small.topLeftCorner(motions_, motions_) += Matrix(block(stiffness, all.apart, all.apart));
  small.bottomLeftCorner(others, motions_) += all.onApart;
  small.topRightCorner(motions_, others) += all.onApart.transpose();
  return 0.5 * (small + small.transpose());
}

void SparseConstrainedInverse::apply(ConstLocalView flux, LocalView trace) const {
  thread_local std::vector<double> kept;
  WorkSpace space(unknowns_, flux.cols(), kept);
  Eigen::Map<Matrix>& inside = space.values;
  inside.setZero();
  for (const auto& [position, place] : places_) inside.row(place) = flux.row(position);
  if (single_)
    single_->apply(inside, inside);
  else if (unknowns_ > 0)
    factor_->solve(inside);
  trace.setZero();
  for (const auto& [position, place] : places_) trace.row(position) = inside.row(place);
  if (small_.rows() == 0) return;
  Vector part;
  for (Eigen::Index column = 0; column < flux.cols(); ++column) {
    images_.multiplyTransposed(flux.col(column), part);
    part = -part;
    for (const auto& [position, place] : apart_) part(place) += flux(position, column);
    const Vector reduced = small_ * part;
    images_.addProduct(-reduced, trace.col(column));
    for (const auto& [position, place] : apart_) trace(position, column) = reduced(place);
  }
}

}  // namespace suture
