#include <suture/algebra/SparseConstrainedInverse.hpp>
#include <suture/algebra/WorkSpace.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Errors.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kZeroEntry = 1e-14;  // entry of a constraint that counts as none
constexpr double kFollows = 1e-10;    // part of a constraint's stiffness that others leave, below which it follows from them

/// Entry of a row that has one only, or -1.
int singleEntry(const Matrix& rows, int row) {
  int found = -1, count = 0;
  for (int j = 0; j < rows.cols() && count < 2; ++j)
    if (std::abs(rows(row, j)) > kZeroEntry) found = j, ++count;
  return count == 1 ? found : -1;
}

}  // namespace

std::unique_ptr<SparseConstrainedInverse> SparseConstrainedInverse::make(const SparseMatrix& stiffness, const std::vector<int>& boundary,
                                                                         const Matrix& constraints, const LocalSolverMaker& solver,
                                                                         const std::string& what) {
  const auto refuse = [&] { return NumericalError(what + ": a primal constraint follows from the others"); };
  const int n = static_cast<int>(stiffness.rows()), m = static_cast<int>(constraints.rows()), size = static_cast<int>(boundary.size());
  std::vector<int> held, heldRows, otherRows;  // positions in the trace that constraints hold alone, and these constraints
  for (int row = 0; row < m; ++row) {
    const int single = singleEntry(constraints, row);
    if (single >= 0 && std::count(held.begin(), held.end(), single) > 0) throw refuse();
    (single >= 0 ? heldRows : otherRows).push_back(row);
    if (single >= 0) held.push_back(single);
  }
  std::vector<int> heldUnknowns;
  for (const int position : held) heldUnknowns.push_back(boundary[position]);
  std::vector<int> sorted = heldUnknowns;
  std::sort(sorted.begin(), sorted.end());
  const std::vector<int> free = complement(n, sorted);
  std::vector<int> placeOf(n, -1);
  for (std::size_t i = 0; i < free.size(); ++i) placeOf[free[i]] = static_cast<int>(i);

  std::unique_ptr<SparseConstrainedInverse> made(new SparseConstrainedInverse);
  made->unknowns_ = static_cast<int>(free.size());
  for (int k = 0; k < size; ++k)
    if (placeOf[boundary[k]] >= 0) made->places_.emplace_back(k, placeOf[boundary[k]]);
  made->factor_ = solver();
  try {
    made->factor_->factorise(block(stiffness, free, free));
  } catch (const NumericalError&) {
    return nullptr;
  }

  // Other constraints, in the free unknowns and in the held ones.
  const int others = static_cast<int>(otherRows.size()), fixed = static_cast<int>(held.size());
  Matrix onFree = Matrix::Zero(made->unknowns_, others), onHeld(others, fixed);
  for (int k = 0; k < others; ++k) {
    for (const auto& [position, place] : made->places_) onFree(place, k) = constraints(otherRows[k], position);
    for (int j = 0; j < fixed; ++j) onHeld(k, j) = constraints(otherRows[k], held[j]);
  }
  made->images_ = onFree;
  if (others > 0) made->factor_->solve(made->images_);
  const Matrix gram = onFree.transpose() * made->images_;
  Matrix lower;
  if (others > 0 && !choleskyFactor(gram, lower)) throw refuse();
  for (int k = 0; k < others; ++k)
    if (!(lower(k, k) * lower(k, k) > kFollows * gram(k, k))) throw refuse();
  made->shares_ = others > 0 ? solvePositive(gram, Matrix::Identity(others, others)) : Matrix(0, 0);

  // Traces of least energy: values of the constraints in, all unknowns out.
  Matrix values = Matrix::Zero(fixed, m), wanted = Matrix::Zero(others, m);
  for (int j = 0; j < fixed; ++j) values(j, heldRows[j]) = 1.0 / constraints(heldRows[j], held[j]);
  for (int k = 0; k < others; ++k) wanted(k, otherRows[k]) = 1.0;
  Matrix inside = -(block(stiffness, free, heldUnknowns) * values);
  if (m > 0 && made->unknowns_ > 0) made->factor_->solve(inside);
  if (others > 0) inside += made->images_ * (made->shares_ * (wanted - onHeld * values - onFree.transpose() * inside));
  Matrix all = Matrix::Zero(n, m), basis(size, m);
  for (std::size_t i = 0; i < free.size(); ++i) all.row(free[i]) = inside.row(static_cast<Eigen::Index>(i));
  for (int j = 0; j < fixed; ++j) all.row(heldUnknowns[j]) = values.row(j);
  for (int k = 0; k < size; ++k) basis.row(k) = all.row(boundary[k]);
  const Matrix energy = all.transpose() * (stiffness * all);
  made->energy_ = 0.5 * (energy + energy.transpose());
  made->basis_ = PackedColumns(basis);
  return made;
}

void SparseConstrainedInverse::apply(ConstLocalView flux, LocalView trace) const {
  thread_local std::vector<double> kept;
  WorkSpace space(unknowns_, flux.cols(), kept);
  Eigen::Map<Matrix>& inside = space.values;
  inside.setZero();
  for (const auto& [position, place] : places_) inside.row(place) = flux.row(position);
  if (images_.cols() > 0) {
    const Matrix part = shares_ * (images_.transpose() * inside);
    factor_->solve(inside);
    inside.noalias() -= images_ * part;
  } else if (unknowns_ > 0) {
    factor_->solve(inside);
  }
  trace.setZero();
  for (const auto& [position, place] : places_) trace.row(position) = inside.row(place);
}

}  // namespace suture
