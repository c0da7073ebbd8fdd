#include <suture/algebra/ConstrainedInverse.hpp>
#include <suture/subdomain/LocalProblem.hpp>

namespace suture {

std::unique_ptr<LocalInverse> LocalProblem::inverse(const Matrix& constraints) const {
  return std::make_unique<ConstrainedInverse>(schur(), constraints, name());
}

const Matrix& LocalProblem::hint(const std::string& name) const {
  const auto known = hints_.find(name);
  return known != hints_.end() ? known->second : hints_.emplace(name, doHint(name)).first->second;
}

Matrix LocalProblem::schur() const {
  Matrix flux(size(), size());
  applySchur(Matrix::Identity(size(), size()), flux);
  return 0.5 * (flux + flux.transpose());
}

Matrix LocalProblem::schurBlock(const std::vector<int>& positions) const {
  Matrix units = Matrix::Zero(size(), static_cast<int>(positions.size()));
  for (std::size_t j = 0; j < positions.size(); ++j) units(positions[j], j) = 1.0;
  Matrix flux(units.rows(), units.cols());
  applySchur(units, flux);
  return rowsAt(flux, positions);
}

}  // namespace suture
