#include <suture/algebra/ConstrainedInverse.hpp>
#include <suture/subdomain/LocalProblem.hpp>

namespace suture {

std::unique_ptr<LocalInverse> LocalProblem::inverse(const Matrix& constraints) const {
  return std::make_unique<ConstrainedInverse>(schur(), constraints, name());
}

const Matrix& LocalProblem::hint(const std::string& name) const {
  for (const auto& [known, values] : hints_)
    if (known == name) return values;
  Matrix made = doHint(name);
  if (made.cols() > 0) return hints_.emplace_front(name, std::move(made)).second;
  none_.resize(size(), 0);
  return none_;
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
