#include <suture/base/Point.hpp>
#include <suture/pairs/ContactPair.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

std::vector<std::vector<int>> neighbourPairs(const std::vector<std::vector<int>>& cells, int pairs) {
  std::vector<std::vector<int>> beside(pairs);
  for (const std::vector<int>& cell : cells)
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const int a = cell[i], b = cell[(i + 1) % cell.size()];
      beside[a].push_back(b);
      beside[b].push_back(a);
    }
  for (std::vector<int>& own : beside) {
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
  }
  return beside;
}

Point slidingPart(const ContactPair& pair, const Point& jump) {
  Point along = minus(jump, scaled(dot(jump, pair.normal), pair.normal));
  for (const Point& across : pair.still) along = minus(along, scaled(dot(along, across), across));
  return along;
}

std::vector<PairEnd> matchingEnds(int nodeA, int nodeB) { return {{nodeA, 1.0}, {nodeB, -1.0}}; }

Point obstacleForce(const ContactPair& pair, const Point& onB) {
  double sum = 0.0, size = 0.0;
  for (const PairEnd& end : pair.ends) sum += end.weight, size += std::abs(end.weight);
  if (std::abs(sum) < 1e-9 * size) return {0, 0, 0};
  return scaled(-sum, onB);
}

}  // namespace suture
