#include <algorithm>
#include <cmath>
#include <suture/quality/PressureOscillation.hpp>

namespace suture {

namespace {

constexpr int kAlternating = 4;  // second differences in a row: a peak at one pair has three

/// Amplitude of what alternates in the pressures of neighbouring closed pairs. [stress]
double oscillation(const std::vector<double>& pressures) {
  double largest = 0.0, before = 0.0;
  std::vector<double> row;  // magnitudes of successive second differences whose signs alternate
  for (std::size_t j = 1; j + 1 < pressures.size(); ++j) {
    const double second = pressures[j - 1] - 2.0 * pressures[j] + pressures[j + 1];
    if (before * second >= 0.0) row.clear();
    row.push_back(std::abs(second));
    before = second;
    if (int(row.size()) >= kAlternating) largest = std::max(largest, *std::min_element(row.end() - kAlternating, row.end()) / 4.0);
  }
  return largest;
}

}  // namespace

std::vector<double> pressureOscillations(const std::vector<PairResult>& pairs, int pieces) {
  std::vector<std::vector<const PairResult*>> ofPiece(static_cast<std::size_t>(pieces));
  for (const PairResult& pair : pairs)
    if (pair.piece >= 0 && pair.piece < pieces) ofPiece[std::size_t(pair.piece)].push_back(&pair);
  std::vector<double> found;
  for (std::vector<const PairResult*>& own : ofPiece) {
    std::stable_sort(own.begin(), own.end(), [](const PairResult* a, const PairResult* b) { return a->arc < b->arc; });
    double largest = 0.0;
    std::vector<double> closed;
    for (const PairResult* pair : own) {
      if (pair->state.closed()) {
        closed.push_back(pair->pressure);
        continue;
      }
      largest = std::max(largest, oscillation(closed));
      closed.clear();
    }
    found.push_back(std::max(largest, oscillation(closed)));
  }
  return found;
}

}  // namespace suture
