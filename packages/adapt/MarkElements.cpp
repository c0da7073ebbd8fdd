#include <suture/adapt/MarkElements.hpp>
#include <suture/base/Errors.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>

namespace suture {

namespace {

constexpr double kEqualErrors = 1e-4;

void check(const std::vector<double>& squares, double theta) {
  if (!(theta > 0 && theta <= 1)) throw InternalError("marking with theta = " + std::to_string(theta) + ", expected (0, 1]");
  for (const double square : squares)
    if (!std::isfinite(square) || square < 0) throw InternalError("a squared element error of " + std::to_string(square));
}

}  // namespace

std::vector<char> markElements(const std::vector<double>& squares, double theta) {
  check(squares, theta);
  std::vector<char> marked(squares.size(), 0);
  std::vector<double> sorted = squares;
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  // The sum runs in the same order as the search, so that theta = 1 ends with the last nonzero square.
  const double wanted = theta * std::accumulate(sorted.begin(), sorted.end(), 0.0);
  if (!(wanted > 0)) return marked;
  double sum = 0.0;
  std::size_t last = 0;
  while (last + 1 < sorted.size() && sum + sorted[last] < wanted) sum += sorted[last++];
  const double least = (1 - kEqualErrors) * sorted[last];
  for (std::size_t e = 0; e < squares.size(); ++e) marked[e] = squares[e] > 0 && squares[e] >= least;
  return marked;
}

}  // namespace suture
