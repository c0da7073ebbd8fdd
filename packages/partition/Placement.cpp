#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <suture/partition/Placement.hpp>
#include <utility>

namespace suture {

std::vector<int> placeOnRanks(const std::vector<long long>& weights, int ranks) {
  std::vector<int> order(weights.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return weights[a] > weights[b]; });
  using Loaded = std::pair<long long, int>;  // load, rank
  std::priority_queue<Loaded, std::vector<Loaded>, std::greater<Loaded>> queue;
  for (int rank = 0; rank < ranks; ++rank) queue.emplace(0, rank);
  std::vector<int> rankOf(weights.size());
  for (int unit : order) {
    const auto [load, rank] = queue.top();
    queue.pop();
    rankOf[unit] = rank;
    queue.emplace(load + weights[unit], rank);
  }
  return rankOf;
}

}  // namespace suture
