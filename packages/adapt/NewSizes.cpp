#include <suture/adapt/NewSizes.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>

namespace suture {

namespace {

constexpr double kTolerance = 1e-4;  // relative, of the squared error

void check(const Mesh& mesh, const std::vector<double>& squares, int degree, double target) {
  if (static_cast<int>(squares.size()) != mesh.elements()) throw InternalError("element errors of another mesh");
  if (degree < 1) throw InternalError("sizes for elements of degree " + std::to_string(degree));
  if (!(target > 0 && target < 1)) throw InternalError("sizes for " + std::to_string(target) + " of the error, expected (0, 1)");
  for (const double square : squares)
    if (!std::isfinite(square) || square < 0) throw InternalError("a squared element error of " + std::to_string(square));
}

/// Edge of the regular element of this size.
double edgeOf(const Mesh& mesh, int e) {
  const double size = std::abs(signedSize(mesh, e));
  const bool simplex = isSimplex(mesh.cells[e]);
  if (mesh.dimension == 2) return std::sqrt(simplex ? size * 4 / std::sqrt(3.0) : size);
  return std::cbrt(simplex ? size * 6 * std::sqrt(2.0) : size);
}

/// Ratio of new and old size of each element.
class Ratios {
 public:
  Ratios(const std::vector<double>& squares, int degree, int dimension, const SizeLimits& limits)
      : squares_(squares), power_(2 * degree + dimension), decay_(2 * degree), limits_(limits) {
    for (const double square : squares) logs_.push_back(square > 0 ? std::log(square) : -std::numeric_limits<double>::infinity());
  }

  std::vector<double> forError(double target) const {
    const double all = std::accumulate(squares_.begin(), squares_.end(), 0.0), wanted = target * target * all;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double log : logs_)
      if (std::isfinite(log)) low = std::min(low, log), high = std::max(high, log);
    low += power_ * std::log(limits_.least);  // all elements of the least size
    high += power_ * std::log(limits_.most);
    while (all > 0 && high - low > kTolerance) {
      const double middle = (low + high) / 2;
      (error(middle) > wanted ? high : low) = middle;
    }
    std::vector<double> ratios;
    for (const double log : logs_) ratios.push_back(ratio(all > 0 ? low : 0, log));
    return ratios;
  }

 private:
  double ratio(double logC, double log) const {
    return std::isfinite(log) ? std::clamp(std::exp((logC - log) / power_), limits_.least, limits_.most) : limits_.most;
  }
  /// Squared error of the new mesh. An error density eta_T^2 over the element's size falls with the power 2 k of the size.
  double error(double logC) const {
    double sum = 0;
    for (std::size_t e = 0; e < logs_.size(); ++e)
      if (squares_[e] > 0) sum += squares_[e] * std::pow(ratio(logC, logs_[e]), decay_);
    return sum;
  }

  const std::vector<double>& squares_;
  std::vector<double> logs_;
  double power_;
  int decay_;
  SizeLimits limits_;
};

/// Distances between adjacent vertices, and zero between opposite ones.
class Neighbours {
 public:
  Neighbours(const Mesh& mesh, const std::vector<NodePairs>& twins) {
    std::vector<Step> steps;
    for (int e = 0; e < mesh.elements(); ++e) {
      const Span<const int> nodes = mesh.nodesOf(e);
      for (const auto& [i, j] : cellInfo(mesh.cells[e]).edges)
        steps.push_back({nodes[i], nodes[j], norm(minus(mesh.point(nodes[i]), mesh.point(nodes[j])))});
    }
    for (const NodePairs& pairs : twins)
      for (const auto& [a, b] : pairs) steps.push_back({a, b, 0.0});
    start_.assign(static_cast<std::size_t>(mesh.nodes()) + 1, 0);
    for (const Step& step : steps) ++start_[step.from + 1], ++start_[step.to + 1];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    entries_.resize(static_cast<std::size_t>(start_.back()));
    std::vector<int> next(start_.begin(), start_.end() - 1);
    for (const Step& step : steps) {
      entries_[next[step.from]++] = {step.to, step.distance};
      entries_[next[step.to]++] = {step.from, step.distance};
    }
  }

  /// Limits the growth of a field: the largest field below it that grows by at most `slope` times the distance.
  void limitGrowth(std::vector<double>& field, double slope) const {
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (std::size_t node = 0; node < field.size(); ++node)
      if (std::isfinite(field[node])) queue.emplace(field[node], static_cast<int>(node));
    while (!queue.empty()) {
      const auto [value, node] = queue.top();
      queue.pop();
      if (value > field[node]) continue;
      for (int k = start_[node]; k < start_[node + 1]; ++k) {
        const double most = value + slope * entries_[k].second;
        if (most >= field[entries_[k].first]) continue;
        field[entries_[k].first] = most;
        queue.emplace(most, entries_[k].first);
      }
    }
  }

 private:
  struct Step {
    int from, to;
    double distance;
  };
  std::vector<int> start_;
  std::vector<std::pair<int, double>> entries_;
};

/// Sizes at nodes that are no vertices: the mean of the ends of their edge, or of the element's vertices.
void fillMiddles(const Mesh& mesh, std::vector<double>& size) {
  for (int e = 0; e < mesh.elements(); ++e) {
    const CellInfo& cell = cellInfo(mesh.cells[e]);
    const Span<const int> nodes = mesh.nodesOf(e);
    double mean = 0;
    for (int k = 0; k < cell.vertices; ++k) mean += size[nodes[k]] / cell.vertices;
    for (int k = cell.vertices; k < cell.nodes; ++k) {
      const auto edge = static_cast<std::size_t>(k - cell.vertices);
      size[nodes[k]] = edge < cell.edges.size() ? (size[nodes[cell.edges[edge][0]]] + size[nodes[cell.edges[edge][1]]]) / 2 : mean;
    }
  }
}

}  // namespace

NewSizes newSizes(const Mesh& mesh, const std::vector<double>& squares, int degree, double target, const std::vector<NodePairs>& twins,
                  const SizeLimits& limits) {
  check(mesh, squares, degree, target);
  const std::vector<double> ratios = Ratios(squares, degree, mesh.dimension, limits).forError(target);
  NewSizes result;
  result.size.assign(static_cast<std::size_t>(mesh.nodes()), std::numeric_limits<double>::infinity());
  std::vector<double> old;
  for (int e = 0; e < mesh.elements(); ++e) {
    old.push_back(edgeOf(mesh, e));
    for (int k = 0; k < cellInfo(mesh.cells[e]).vertices; ++k) {
      double& size = result.size[mesh.nodesOf(e)[k]];
      size = std::min(size, ratios[e] * old[e]);
    }
  }
  Neighbours(mesh, twins).limitGrowth(result.size, limits.gradation);
  for (int e = 0; e < mesh.elements(); ++e) {
    const int vertices = cellInfo(mesh.cells[e]).vertices;
    for (int k = 0; k < vertices; ++k) result.elements += std::pow(old[e] / result.size[mesh.nodesOf(e)[k]], mesh.dimension) / vertices;
  }
  fillMiddles(mesh, result.size);
  return result;
}

}  // namespace suture
