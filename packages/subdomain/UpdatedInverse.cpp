#include <suture/subdomain/UpdatedInverse.hpp>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// The base may be known to single precision only: what is lost by a condition of this inverse is a thousandth.
constexpr double kLeastEigenvalue = 1e-4;
constexpr double kAccuracy = 1e-4;  // of the values that the new basis has in the new rows

/// B with a^-1 = B B^T; empty if a, its diagonal scaled to one, has an eigenvalue that is too small.
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

}  // namespace

std::unique_ptr<UpdatedInverse> UpdatedInverse::make(std::shared_ptr<const LocalInverse> base, const std::vector<int>& from,
                                                     const Matrix& constraints) {
  const Matrix phi = base->basis(), &energy = base->energy();
  if (energy.rows() != phi.cols() || energy.cols() != phi.cols()) return nullptr;  // a user's, which need not tell
  std::vector<int> kept, added, keptRows;                                          // numbers in the base; new rows
  for (int row = 0; row < static_cast<int>(from.size()); ++row) {
    (from[row] < 0 ? added : keptRows).push_back(row);
    if (from[row] >= 0) kept.push_back(from[row]);
  }
  std::vector<int> sorted = kept;
  std::sort(sorted.begin(), sorted.end());
  const std::vector<int> removed = complement(static_cast<int>(phi.cols()), sorted);

  std::unique_ptr<UpdatedInverse> made(new UpdatedInverse);
  const Matrix rows = rowsAt(constraints, added), across = rows.transpose();
  Matrix w(phi.rows(), across.cols());
  if (!added.empty()) base->apply(across, w);
  Matrix basis = columnsAt(phi, kept), energies = blockAt(energy, kept, kept);
  if (!removed.empty()) {
    const Matrix own = blockAt(energy, removed, removed);
    // Without them a motion may cost nothing.
    if (!(own.diagonal().minCoeff() > kLeastEigenvalue * energy.diagonal().maxCoeff())) return nullptr;
    const Matrix root = inverseRoot(own);
    if (root.size() == 0) return nullptr;
    const Matrix up = columnsAt(phi, removed) * root, mixed = root.transpose() * blockAt(energy, removed, kept);
    w += up * (up.transpose() * across);
    basis -= up * mixed;
    energies -= mixed.transpose() * mixed;
    made->added_ = PackedColumns(up);
  }
  const int before = static_cast<int>(kept.size()), after = before + static_cast<int>(added.size());
  if (!added.empty()) {
    const Matrix product = rows * w, root = inverseRoot(0.5 * (product + product.transpose()));
    if (root.size() == 0) return nullptr;
    const Matrix down = w * root, mixed = root.transpose() * (rows * basis);
    basis -= down * mixed;
    energies += mixed.transpose() * mixed;
    const Matrix between = -mixed.transpose() * root.transpose();
    basis.conservativeResize(Eigen::NoChange, after);
    basis.rightCols(after - before) = down * root.transpose();
    energies.conservativeResize(after, after);
    energies.topRightCorner(before, after - before) = between;
    energies.bottomLeftCorner(after - before, before) = between.transpose();
    energies.bottomRightCorner(after - before, after - before) = root * root.transpose();
    made->removed_ = PackedColumns(down);
  }

  // As the new rows are numbered.
  std::vector<int> place(from.size());
  for (int k = 0; k < before; ++k) place[keptRows[k]] = k;
  for (int k = before; k < after; ++k) place[added[k - before]] = k;
  basis = columnsAt(basis, place);
  // A row that follows from others has left nothing but rounding.
  const double error = after > 0 ? (constraints * basis - Matrix::Identity(after, after)).cwiseAbs().maxCoeff() : 0.0;
  if (!(error < kAccuracy)) return nullptr;
  made->energy_ = blockAt(energies, place, place);
  made->basis_ = PackedColumns(basis);
  made->base_ = std::move(base);
  return made;
}

void UpdatedInverse::apply(ConstLocalView flux, LocalView trace) const {
  base_->apply(flux, trace);
  for (Eigen::Index c = 0; c < flux.cols(); ++c) {
    added_.multiplyTransposed(flux.col(c), up_);
    added_.addProduct(up_, trace.col(c));
    removed_.multiplyTransposed(flux.col(c), down_);
    down_ = -down_;
    removed_.addProduct(down_, trace.col(c));
  }
}

double UpdatedInverse::bytesRead() const {
  const double own = base_->bytesRead();  // with the basis of the base, which is not read
  return own > 0.0 ? own + 2.0 * (added_.bytes() + removed_.bytes() + basis_.bytes()) : 0.0;
}

}  // namespace suture
