#include <suture/algebra/DisjointSets.hpp>
#include <suture/answer/error/PressureOscillation.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr int kAlternating = 4;  // number of pairs with alternating second differences; a peak at one pair has three

/// Second difference of the pressures at each pair of a piece; zero if the pair or a neighbour is open, or if it has no neighbours on two
/// sides.
std::vector<double> secondDifferences(const std::vector<const PairResult*>& pairs, const std::vector<std::vector<int>>& beside) {
  std::vector<double> second(pairs.size(), 0.0);
  const auto isOpen = [&](int i) { return !pairs[std::size_t(i)]->state.closed(); };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::vector<int>& others = beside[i];
    if (others.size() < 2 || isOpen(int(i)) || std::any_of(others.begin(), others.end(), isOpen)) continue;
    double sum = pairs[std::size_t(others[0])]->pressure - double(others.size()) * pairs[i]->pressure;
    for (std::size_t k = 1; k < others.size(); ++k) sum += pairs[std::size_t(others[k])]->pressure;
    second[i] = 2.0 * sum / double(others.size());
  }
  return second;
}

/// Amplitude of the alternating part of the pressures of a piece: a quarter of the largest value that is reached by the second differences
/// of kAlternating neighbours with alternating signs. [stress]
double oscillation(const std::vector<double>& second, const std::vector<std::vector<int>>& beside) {
  std::vector<int> order;  // by descending magnitude
  for (std::size_t i = 0; i < second.size(); ++i)
    if (second[i] != 0.0) order.push_back(int(i));
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const double x = std::abs(second[std::size_t(a)]), y = std::abs(second[std::size_t(b)]);
    return x > y || (x == y && a < b);
  });
  DisjointSets sets(int(second.size()));
  std::vector<int> members(second.size(), 0);  // size of the set with this pair as its lowest
  for (const int i : order) {
    members[std::size_t(i)] = 1;
    for (const int other : beside[std::size_t(i)]) {
      const int a = sets.lowest(i), b = sets.lowest(other);
      if (a == b || members[std::size_t(b)] == 0 || second[std::size_t(i)] * second[std::size_t(other)] > 0.0) continue;
      const int together = members[std::size_t(a)] + members[std::size_t(b)];
      members[std::size_t(sets.join(a, b))] = together;
    }
    if (members[std::size_t(sets.lowest(i))] >= kAlternating) return std::abs(second[std::size_t(i)]) / 4.0;
  }
  return 0.0;
}

/// Neighbours of each pair of a piece in the cells, by indices within the piece.
std::vector<std::vector<int>> neighboursIn(const ContactPiece& piece) {
  std::vector<std::vector<int>> cells = piece.cells;
  for (std::vector<int>& cell : cells)
    for (int& id : cell) id = int(std::lower_bound(piece.pairs.begin(), piece.pairs.end(), id) - piece.pairs.begin());
  return neighbourPairs(cells, int(piece.pairs.size()));
}

}  // namespace

std::vector<double> pressureOscillations(const std::vector<PairResult>& pairs, const std::vector<ContactPiece>& pieces) {
  std::vector<double> found;
  for (const ContactPiece& piece : pieces) {
    std::vector<const PairResult*> own;
    for (const int id : piece.pairs) own.push_back(&pairs.at(std::size_t(id)));
    const std::vector<std::vector<int>> beside = neighboursIn(piece);
    found.push_back(oscillation(secondDifferences(own, beside), beside));
  }
  return found;
}

}  // namespace suture
