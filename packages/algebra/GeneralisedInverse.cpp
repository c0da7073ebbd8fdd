#include <suture/algebra/GeneralisedInverse.hpp>
#include <suture/algebra/dense/Decompositions.hpp>

#include <algorithm>
#include <random>
#include <sstream>

namespace suture {

namespace {

/// Unknowns of a few nodes that determine the kernel well: the first pivots of a QR of its transpose, completed to whole nodes.
std::vector<int> fixingDofs(const Matrix& kernel, const std::vector<int>& nodeOf) {
  std::vector<int> nodes;
  for (const int row : pivotRows(kernel)) nodes.push_back(nodeOf[row]);
  std::sort(nodes.begin(), nodes.end());
  std::vector<int> dofs;
  for (int i = 0; i < static_cast<int>(nodeOf.size()); ++i)
    if (std::binary_search(nodes.begin(), nodes.end(), nodeOf[i])) dofs.push_back(i);
  return dofs;
}

/// K + rho P on the fixing dofs.
SparseMatrix regularised(const SparseMatrix& matrix, const Matrix& kernel, const std::vector<int>& dofs) {
  const int m = static_cast<int>(dofs.size());
  Matrix fixed(m, kernel.cols());
  double rho = 0.0;
  for (int i = 0; i < m; ++i) {
    fixed.row(i) = kernel.row(dofs[i]);
    rho = std::max(rho, matrix.coeff(dofs[i], dofs[i]));
  }
  const Matrix basis = orthonormalBasis(fixed, 1e-14);
  const Matrix projection = basis * basis.transpose();
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j)
      if (std::abs(projection(i, j)) > 1e-15) entries.emplace_back(dofs[i], dofs[j], rho * projection(i, j));
  SparseMatrix springs(matrix.rows(), matrix.cols());
  springs.setFromTriplets(entries.begin(), entries.end());
  return matrix + springs;
}

}  // namespace

GeneralisedInverse::GeneralisedInverse(const SparseMatrix& matrix, const Matrix& kernel, const std::vector<int>& nodeOf,
                                       const LocalSolverMaker& maker, const std::string& what)
    : size_(static_cast<int>(matrix.rows())), kernel_(kernel), solver_(maker()) {
  try {
    if (kernel.cols() == 0)
      solver_->factorise(matrix);
    else
      solver_->factorise(regularised(matrix, kernel, fixingDofs(kernel, nodeOf)));
  } catch (const NumericalError& error) {
    throw NumericalError(what + ": " + error.what() + " (does a part of it have a mechanism that is not a rigid mode?)");
  }
  verify(matrix, what);
}

void GeneralisedInverse::verify(const SparseMatrix& matrix, const std::string& what) const {
  if (size_ == 0) return;
  double largest = 0.0;
  for (int j = 0; j < size_; ++j) largest = std::max(largest, matrix.coeff(j, j));
  for (int k = 0; k < kernel_.cols(); ++k) {
    const Vector mode = kernel_.col(k);
    const double residual = (matrix * mode).lpNorm<Eigen::Infinity>() / (largest * mode.lpNorm<Eigen::Infinity>());
    if (!(residual < 1e-8)) {
      std::ostringstream text;
      text << what << ": rigid mode " << k + 1 << " of " << kernel_.cols()
           << " is not in the kernel of the stiffness matrix (relative residual " << residual << ")";
      throw NumericalError(text.str());
    }
  }
  std::mt19937 random(1);  // the same load in every run
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Vector load(size_);
  for (int i = 0; i < size_; ++i) load(i) = uniform(random);
  const Matrix basis = orthonormalBasis(kernel_, 1e-14);
  load -= basis * (basis.transpose() * load);
  Matrix x = load;
  solver_->solve(x);
  const double residual = (matrix * x.col(0) - load).norm() / std::max(load.norm(), 1e-300);
  // Round-off gives about 1e-16 times the condition number, 1e-10 for 1e6; a missing mode gives order one.
  if (load.norm() > 1e-8 && !(residual < 1e-5)) {
    std::ostringstream text;
    text << what << ": the stiffness matrix has more mechanisms than the " << kernel_.cols() << " known rigid modes (relative residual "
         << residual << " of a balanced load)";
    throw NumericalError(text.str());
  }
}

}  // namespace suture
