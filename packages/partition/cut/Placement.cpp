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

// First unit after the run that begins at each unit and does not exceed the limit; `limit` is at least the largest weight.
std::vector<int> endsOfRuns(const std::vector<long long>& weights, long long limit) {
  std::vector<int> ends(weights.size());
  long long load = 0;
  for (int begin = 0, end = 0; begin < static_cast<int>(weights.size()); load -= weights[begin++]) {
    while (end < static_cast<int>(weights.size()) && load + weights[end] <= limit) load += weights[end++];
    ends[begin] = end;
  }
  return ends;
}

// Runs needed for the units from each one on; 0 after the last.
std::vector<int> runsNeeded(const std::vector<long long>& weights, long long limit) {
  const std::vector<int> ends = endsOfRuns(weights, limit);
  std::vector<int> needed(weights.size() + 1, 0);
  for (std::size_t i = weights.size(); i-- > 0;) needed[i] = needed[ends[i]] + 1;
  return needed;
}

}  // namespace

std::vector<int> placeInRuns(const std::vector<long long>& weights, int ranks) {
  if (weights.empty()) return {};
  const int units = static_cast<int>(weights.size());
  const long long largest = *std::max_element(weights.begin(), weights.end());
  long long total = std::accumulate(weights.begin(), weights.end(), 0LL);
  long long limit = total, tooSmall = std::max(largest, (total + ranks - 1) / ranks) - 1;  // bounds of the least largest load
  while (limit - tooSmall > 1) {
    const long long middle = tooSmall + (limit - tooSmall) / 2;
    (runsNeeded(weights, middle)[0] <= ranks ? limit : tooSmall) = middle;
  }
  const std::vector<int> needed = runsNeeded(weights, limit);
  std::vector<int> rankOf(weights.size());
  int rank = 0, first = 0;  // first unit of this rank
  long long load = 0;       // cost of this rank; `total`: with the units that are not placed
  for (int unit = 0; unit < units; ++unit) {
    const int left = ranks - rank;  // with this rank
    const bool isEnough = 2 * static_cast<double>(load) + static_cast<double>(weights[unit]) > 2.0 * static_cast<double>(total) / left;
    if (unit > first && (load + weights[unit] > limit || units - unit < left || (isEnough && needed[unit] < left))) {
      ++rank;
      first = unit;
      total -= load;
      load = 0;
    }
    load += weights[unit];
    rankOf[unit] = rank;
  }
  return rankOf;
}

std::vector<int> placeOnRanks(const std::vector<long long>& weights, int ranks) {
  constexpr double worthIt = 1.01;  // the weights are estimates and no more accurate than this
  if (weights.empty()) return {};
  const std::vector<int> balanced = heaviestFirst(weights, ranks), near = inOrder(weights, ranks);
  return largestLoad(weights, near, ranks) <= worthIt * largestLoad(weights, balanced, ranks) ? near : balanced;
}

}  // namespace suture
