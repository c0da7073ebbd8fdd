#include <suture/algebra/Blas.hpp>
#include <suture/algebra/UpdatedInverse.hpp>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// The base may be accurate to single precision only: this condition of the inverse loses a factor of a thousand.
constexpr double kLeastEigenvalue = 1e-4;
// Least size of the updated inverse, relative to the base: new rows that stop a soft motion cancel its large compliance, and with a base in
// single precision only four digits are left at this ratio.
constexpr double kCancelled = 1e-3;
constexpr double kBasisAccuracy = 1e-4;  // relative accuracy of the values of the new basis in the new rows

/// B with a^-1 = B B^T; empty if a, with its diagonal scaled to one, has an eigenvalue that is too small.
Matrix inverseRoot(const Matrix& a) {
  const Vector diagonal = a.diagonal();
  if (!(diagonal.minCoeff() > 0.0)) return Matrix();
  const Vector scale = diagonal.cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(scale.asDiagonal() * a * scale.asDiagonal());
  if (eigen.info() != Eigen::Success || !(eigen.eigenvalues()(0) > kLeastEigenvalue)) return Matrix();
  return scale.asDiagonal() * eigen.eigenvectors() * eigen.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal();
}

Matrix columnsAt(const Matrix& matrix, const std::vector<int>& positions) {
  Matrix columns(matrix.rows(), positions.size());
  for (std::size_t k = 0; k < positions.size(); ++k) columns.col(static_cast<int>(k)) = matrix.col(positions[k]);
  return columns;
}

Matrix blockAt(const Matrix& matrix, const std::vector<int>& rows, const std::vector<int>& columns) {
  return rowsAt(columnsAt(matrix, columns), rows);
}

/// Update for the constraints currently held; the inverse is P + plus plus^T - minus minus^T with the base's P.
struct Change {
  Matrix basis, energy;
  Matrix plus, minus;

  /// Removes some rows of the base, keeps the others. \return false: inaccurate
  bool remove(const std::vector<int>& removed, const std::vector<int>& kept) {
    Matrix heldBasis = columnsAt(basis, kept), heldEnergy = blockAt(energy, kept, kept);
    if (!removed.empty()) {
      const Matrix own = blockAt(energy, removed, removed);
      // Without these rows a motion may have no energy.
      if (!(own.diagonal().minCoeff() > kLeastEigenvalue * energy.diagonal().maxCoeff())) return false;
      const Matrix root = inverseRoot(own);
      if (root.size() == 0) return false;
      plus = product(CblasNoTrans, columnsAt(basis, removed), root);
      const Matrix mixed = product(CblasTrans, root, blockAt(energy, removed, kept));
      addProductTo(-1.0, CblasNoTrans, plus, mixed, 1.0, heldBasis);
      addProductTo(-1.0, CblasTrans, mixed, mixed, 1.0, heldEnergy);
    }
    basis = std::move(heldBasis);
    energy = std::move(heldEnergy);
    return true;
  }

  /// Adds rows D after those held. \return false: inaccurate
  bool add(const Matrix& d, const LocalInverse& base) {
    const Matrix across = d.transpose();
    Matrix w(across.rows(), across.cols());
    base.apply(across, w);
    if (plus.size() > 0) addProductTo(1.0, CblasNoTrans, plus, product(CblasTrans, plus, across), 1.0, w);
    const Matrix values = product(CblasNoTrans, d, w), root = inverseRoot(0.5 * (values + values.transpose()));
    if (root.size() == 0) return false;
    minus = product(CblasNoTrans, w, root);
    const Matrix mixed = product(CblasTrans, root, product(CblasNoTrans, d, basis)), between = -(root * mixed).transpose();
    const Eigen::Index before = basis.cols(), more = d.rows(), after = before + more;
    addProductTo(-1.0, CblasNoTrans, minus, mixed, 1.0, basis);
    basis.conservativeResize(Eigen::NoChange, after);
    basis.rightCols(more) = product<double>(CblasNoTrans, minus, root.transpose());
    addProductTo(1.0, CblasTrans, mixed, mixed, 1.0, energy);
    energy.conservativeResize(after, after);
    energy.topRightCorner(before, more) = between;
    energy.bottomLeftCorner(more, before) = between.transpose();
    energy.bottomRightCorner(more, more) = root * root.transpose();
    return true;
  }
};

}  // namespace

std::unique_ptr<UpdatedInverse> UpdatedInverse::make(std::shared_ptr<const LocalInverse> base, const std::vector<int>& from,
                                                     const Matrix& constraints) {
  Change change{base->basis(), base->energy(), {}, {}};
  const Eigen::Index held = change.basis.cols();
  if (change.energy.rows() != held || change.energy.cols() != held) return nullptr;  // a user's strategy need not provide energies
  std::vector<int> kept, keptRows, addedRows;                                        // numbers in the base; new rows
  for (int row = 0; row < static_cast<int>(from.size()); ++row) {
    (from[row] < 0 ? addedRows : keptRows).push_back(row);
    if (from[row] >= 0) kept.push_back(from[row]);
  }
  std::vector<int> sorted = kept;
  std::sort(sorted.begin(), sorted.end());
  const std::vector<int> removed = complement(static_cast<int>(held), sorted);
  if (!change.remove(removed, kept)) return nullptr;
  if (!addedRows.empty() && !change.add(rowsAt(constraints, addedRows), *base)) return nullptr;

  // In the order of the new rows.
  std::vector<int> place(from.size());
  for (std::size_t k = 0; k < keptRows.size(); ++k) place[keptRows[k]] = static_cast<int>(k);
  for (std::size_t k = 0; k < addedRows.size(); ++k) place[addedRows[k]] = static_cast<int>(kept.size() + k);
  const Matrix basis = columnsAt(change.basis, place);
  // A row that depends on others leaves only round-off.
  if (basis.cols() > 0) {
    const Matrix error = product(CblasNoTrans, constraints, basis) - Matrix::Identity(basis.cols(), basis.cols());
    if (!(error.cwiseAbs().maxCoeff() < kBasisAccuracy)) return nullptr;
  }
  std::unique_ptr<UpdatedInverse> made(new UpdatedInverse);
  made->base_ = std::move(base);
  made->plus_ = PackedColumns(change.plus);
  made->minus_ = PackedColumns(change.minus);
  made->basis_ = PackedColumns(basis);
  made->energy_ = blockAt(change.energy, place, place);
  return made->cancels(static_cast<int>(constraints.cols())) ? nullptr : std::move(made);
}

/// True if the update removes nearly all of what the base gives for a flux without a pattern.
bool UpdatedInverse::cancels(int size) const {
  Matrix flux(size, 1), before(size, 1), after(size, 1);
  for (int i = 0; i < size; ++i) flux(i, 0) = 1.0 + std::sin(i);
  base_->apply(flux, before);
  apply(flux, after);
  return !(after.norm() > kCancelled * before.norm());
}

void UpdatedInverse::apply(ConstLocalView flux, LocalView trace) const {
  base_->apply(flux, trace);
  for (Eigen::Index c = 0; c < flux.cols(); ++c) {
    plus_.multiplyTransposed(flux.col(c), gain_);
    plus_.addProduct(gain_, trace.col(c));
    minus_.multiplyTransposed(flux.col(c), loss_);
    loss_ = -loss_;
    minus_.addProduct(loss_, trace.col(c));
  }
}

double UpdatedInverse::bytesRead() const {
  const double own = base_->bytesRead();
  return own > 0.0 ? own + 2.0 * (plus_.bytes() + minus_.bytes()) : 0.0;
}

std::shared_ptr<const LocalInverse> inverseUnder(const std::shared_ptr<const LocalInverse>& base, int rows, const std::vector<int>& from,
                                                 const Matrix& constraints) {
  bool isSame = static_cast<int>(from.size()) == rows;
  for (std::size_t k = 0; k < from.size(); ++k) isSame = isSame && from[k] == static_cast<int>(k);
  if (isSame) return base;
  return UpdatedInverse::make(base, from, constraints);
}

}  // namespace suture
