#include <suture/subdomain/LocalProblem.hpp>

namespace suture {

Matrix LocalProblem::schurBlock(const std::vector<int>& positions) const {
  Matrix units = Matrix::Zero(size(), static_cast<int>(positions.size()));
  for (std::size_t j = 0; j < positions.size(); ++j) units(positions[j], j) = 1.0;
  Matrix flux(units.rows(), units.cols());
  applySchur(units, flux);
  return rowsAt(flux, positions);
}

}  // namespace suture
