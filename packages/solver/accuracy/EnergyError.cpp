#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/solver/accuracy/EnergyError.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

RitzValues ritzValues(const std::vector<double>& norms, const std::vector<double>& steps) {
  if (steps.empty()) return {};
  std::vector<double> diagonal, offDiagonal;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const double ratio = k > 0 ? norms[k] / norms[k - 1] : 0.0;
    if (k > 0) offDiagonal.push_back(ratio / steps[k - 1]);
    diagonal.push_back(1.0 / steps[k] + (k > 0 ? ratio * ratio / steps[k - 1] : 0.0));
  }
  const std::vector<double> values = tridiagonalEigenvalues(diagonal, offDiagonal);
  return {values.front(), values.back()};
}

std::vector<double> energyErrors(const std::vector<double>& norms, const std::vector<double>& steps, double lowest) {
  double radau = 1.0 / lowest;  // step of an iteration with the eigenvalue `lowest`
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const double ratio = norms[k + 1] / norms[k], excess = radau - steps[k];
    // At most 1 / lowest; by round-off the excess may be zero or negative.
    radau = excess > 0.0 ? excess / (lowest * excess + ratio * ratio) : 1.0 / lowest;
  }
  std::vector<double> errors(norms.size());
  double square = radau * norms.back() * norms.back();
  errors.back() = std::sqrt(square);
  for (std::size_t k = steps.size(); k-- > 0;) {
    square += steps[k] * norms[k] * norms[k];
    errors[k] = std::sqrt(square);
  }
  return errors;
}

}  // namespace suture
