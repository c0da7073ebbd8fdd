#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <suture/partition/cut/Placement.hpp>
#include <utility>

namespace suture {

namespace {

std::vector<int> heaviestFirst(const std::vector<long long>& weights, int ranks) {
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

// Places each unit on the rank whose share of the total contains the unit's midpoint. Empty ranks come last.
std::vector<int> inOrder(const std::vector<long long>& weights, int ranks) {
  const double total = static_cast<double>(std::accumulate(weights.begin(), weights.end(), 0LL));
  std::vector<int> rankOf;
  double before = 0.0;
  int current = -1, used = -1;
  for (const long long weight : weights) {
    const int rank = std::min(static_cast<int>((before + 0.5 * static_cast<double>(weight)) / total * ranks), ranks - 1);
    if (rank != current) ++used;
    current = rank;
    rankOf.push_back(used);
    before += static_cast<double>(weight);
  }
  return rankOf;
}

long long largestLoad(const std::vector<long long>& weights, const std::vector<int>& rankOf, int ranks) {
  std::vector<long long> load(ranks, 0);
  for (std::size_t i = 0; i < weights.size(); ++i) load[rankOf[i]] += weights[i];
  return *std::max_element(load.begin(), load.end());
}

}  // namespace

std::vector<int> placeOnRanks(const std::vector<long long>& weights, int ranks) {
  constexpr double worthIt = 1.01;  // the weights are estimates and no more accurate than this
  if (weights.empty()) return {};
  const std::vector<int> balanced = heaviestFirst(weights, ranks), near = inOrder(weights, ranks);
  return largestLoad(weights, near, ranks) <= worthIt * largestLoad(weights, balanced, ranks) ? near : balanced;
}

}  // namespace suture
