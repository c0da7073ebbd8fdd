#pragma once
#include <vector>

namespace suture {

// The error of conjugate gradients in the energy norm, |x - x_k|_S, from the coefficients of the iteration. `norms`: sqrt(r.M^-1 r) before
// the first iteration and after each; `steps`: step length gamma of each iteration. Local.

/// Extreme eigenvalues of the Lanczos matrix: estimates for M^-1 S, the smallest one an upper bound. Both 0 before the first iteration.
struct RitzValues {
  double smallest = 0.0, largest = 0.0;
};
RitzValues ritzValues(const std::vector<double>& norms, const std::vector<double>& steps);

/// Estimates of |x - x_j|_S for all j = 0 .. k. The gain of iterations j .. k - 1 is known exactly (Hestenes and Stiefel 1952; Strakos and
/// Tichy, ETNA 13, 2002): |x - x_j|^2 = sum of gamma_i (r.M^-1 r)_i + |x - x_k|^2. The rest is the Gauss-Radau bound of Meurant and Tichy
/// (Numer. Algorithms 62, 2013), an upper bound if `lowest` is below the smallest eigenvalue of M^-1 S.
/// \param lowest  > 0, below the smallest Ritz value
std::vector<double> energyErrors(const std::vector<double>& norms, const std::vector<double>& steps, double lowest);

}  // namespace suture
