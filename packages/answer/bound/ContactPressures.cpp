#include <algorithm>
#include <cmath>
#include <limits>
#include <suture/algebra/DisjointSets.hpp>
#include <suture/answer/bound/BalancedPatterns.hpp>
#include <suture/answer/bound/ContactPressures.hpp>
#include <suture/answer/bound/NonnegativeFit.hpp>
#include <utility>

namespace suture {
namespace {

constexpr double kZeroForce = 1e-13;  // relative to the largest force
// Cost of a self-balanced pattern per unit of force, and of the force of a side that should carry none, relative to the largest pressure. A
// high cost gives patterns where p cannot balance the forces, and only there. Lower ones follow for forces on the boundary of what p >= 0
// can balance, for which the search converges slowly.
constexpr double kRestCosts[] = {100, 10, 1};
constexpr double kNearlyFits = 1e-5;  // misfit below which another search can succeed; above it the resultants do not fit
constexpr double kSpread =
    0.1;  // quadratic part of the cost of a pattern whose amplitude is the largest force, relative to its linear part

/// Sides that are connected by nodes, with their own numbers of nodes.
struct PressedPart {
  PressedSides sides;
  std::vector<int> sideNumbers, nodeNumbers;
  std::vector<char> isFull;       // per side: it can carry a pressure that balances forces exactly
  std::vector<char> isSaturated;  // per side: its pressure must be the limit
  double tiny = 0;                // forces up to it count as zero
};

struct PartPressures {
  Matrix coefficients;       // Bernstein coefficients, sideNodes x sides
  std::vector<double> rest;  // per node
  std::vector<std::vector<int>> clusters;
  bool feasible = false;
  double misfit = 0;  // last search with patterns, relative to the largest force
};

/// Largest force of each node that pressures up to the limit balance, minus its force; meaningless for vertices of degree 2 in 3D.
std::vector<double> roomBelowLimit(const PressedSides& sides) {
  const Vector integrals = sideMass(sides.dimension, sides.degree).rowwise().sum();
  std::vector<double> room(sides.places.size(), 0.0);
  for (int side = 0; side < sides.sides(); ++side)
    for (int i = 0; i < sides.sideNodes(); ++i)
      room[std::size_t(sides.nodesOf(side)[i])] += sides.limit * integrals(i) * sides.sizes[std::size_t(side)];
  for (std::size_t node = 0; node < room.size(); ++node) room[node] -= sides.forces[node];
  return room;
}

bool isFull(const PressedSides& sides, int side, double tiny) {
  if (sides.mayPull) return true;
  const int first = sides.degree == 1 ? 0 : sides.vertices();
  const int* nodes = sides.nodesOf(side);
  return std::all_of(nodes + first, nodes + sides.sideNodes(), [&](int node) { return sides.forces[std::size_t(node)] > tiny; });
}

bool isSaturated(const PressedSides& sides, int side, const std::vector<double>& room, double tiny) {
  if (!std::isfinite(sides.limit)) return false;
  const int first = sides.degree == 1 ? 0 : sides.vertices();
  const int* nodes = sides.nodesOf(side);
  return std::any_of(nodes + first, nodes + sides.sideNodes(), [&](int node) { return room[std::size_t(node)] <= tiny; });
}

bool isLoaded(const PressedSides& sides, int side, double tiny) {
  const int* nodes = sides.nodesOf(side);
  return std::any_of(nodes, nodes + sides.sideNodes(), [&](int node) { return std::abs(sides.forces[std::size_t(node)]) > tiny; });
}

/// Connected parts of the sides with at least one loaded node, in the order of their first sides.
std::vector<PressedPart> loadedParts(const PressedSides& sides, double tiny) {
  DisjointSets sets(sides.count());
  std::vector<int> loaded;
  for (int side = 0; side < sides.sides(); ++side) {
    if (!isLoaded(sides, side, tiny)) continue;
    loaded.push_back(side);
    for (int i = 1; i < sides.sideNodes(); ++i) sets.join(sides.nodesOf(side)[0], sides.nodesOf(side)[i]);
  }
  std::vector<PressedPart> parts;
  const std::vector<double> room = roomBelowLimit(sides);
  std::vector<int> partOf(sides.places.size(), -1), local(sides.places.size(), -1);
  for (const int side : loaded) {
    int& number = partOf[std::size_t(sets.lowest(sides.nodesOf(side)[0]))];
    if (number < 0) {
      number = static_cast<int>(parts.size());
      parts.emplace_back();
      parts.back().sides.dimension = sides.dimension, parts.back().sides.degree = sides.degree;
      parts.back().sides.limit = sides.limit, parts.back().sides.mayPull = sides.mayPull;
      parts.back().tiny = tiny;
    }
    PressedPart& part = parts[std::size_t(number)];
    part.sideNumbers.push_back(side);
    part.isFull.push_back(isFull(sides, side, tiny));
    part.isSaturated.push_back(isSaturated(sides, side, room, tiny));
    part.sides.sizes.push_back(sides.sizes[std::size_t(side)]);
    for (int i = 0; i < sides.sideNodes(); ++i) {
      const int node = sides.nodesOf(side)[i];
      if (local[std::size_t(node)] < 0) {
        local[std::size_t(node)] = part.sides.count();
        part.nodeNumbers.push_back(node);
        part.sides.places.push_back(sides.places[std::size_t(node)]);
        part.sides.forces.push_back(sides.forces[std::size_t(node)]);
      }
      part.sides.nodes.push_back(local[std::size_t(node)]);
    }
  }
  return parts;
}

/// Values at nodes that are weighted means of values of the full sides' nodes.
struct NodalMeans {
  std::vector<double> sum, weight;
  explicit NodalMeans(int count) : sum(std::size_t(count), 0.0), weight(std::size_t(count), 0.0) {}
  void add(int node, double value, double by) { sum[std::size_t(node)] += by * value, weight[std::size_t(node)] += by; }
  double at(int node) const { return weight[std::size_t(node)] > 0 ? sum[std::size_t(node)] / weight[std::size_t(node)] : 0.0; }
};

/// Pressures of the nodes whose functions are nonnegative, force / integral of the function (degree 2: mid-edge nodes), extended to the
/// vertices of degree 2 from the means of their sides.
std::vector<double> smoothPressures(const PressedPart& part) {
  const PressedSides& sides = part.sides;
  const int first = sides.degree == 1 ? 0 : sides.vertices(), functions = sides.sideNodes();
  const Vector integrals = sideMass(sides.dimension, sides.degree).rowwise().sum();
  std::vector<double> areas(sides.places.size(), 0.0), pressures(sides.places.size(), 0.0);
  for (int side = 0; side < sides.sides(); ++side)
    for (int i = first; i < functions && part.isFull[std::size_t(side)]; ++i)
      areas[std::size_t(sides.nodesOf(side)[i])] += integrals(i) * sides.sizes[std::size_t(side)];
  for (std::size_t node = 0; node < areas.size(); ++node)
    if (areas[node] > 0)
      pressures[node] = sides.mayPull ? sides.forces[node] / areas[node] : std::max(0.0, sides.forces[node] / areas[node]);
  if (sides.degree == 1) return pressures;
  NodalMeans means(sides.count());
  for (int side = 0; side < sides.sides(); ++side) {
    if (!part.isFull[std::size_t(side)]) continue;
    const int* nodes = sides.nodesOf(side);
    double mean = 0;
    for (int i = first; i < functions; ++i) mean += pressures[std::size_t(nodes[i])] / (functions - first);
    const double size = sides.sizes[std::size_t(side)];
    // In 2D this interpolates between midpoints.
    for (int i = 0; i < first; ++i) means.add(nodes[i], mean, sides.dimension == 2 ? 1 / size : size);
  }
  for (int side = 0; side < sides.sides(); ++side)
    for (int i = 0; i < first; ++i) pressures[std::size_t(sides.nodesOf(side)[i])] = means.at(sides.nodesOf(side)[i]);
  return pressures;
}

/// Bernstein coefficients of the smooth estimate of the pressure, zero on sides that are not full.
Matrix smoothCoefficients(const PressedPart& part) {
  const PressedSides& sides = part.sides;
  const std::vector<double> pressures = smoothPressures(part);
  Matrix coefficients = Matrix::Zero(sides.sideNodes(), sides.sides());
  for (int side = 0; side < sides.sides(); ++side) {
    if (!part.isFull[std::size_t(side)]) continue;
    const int* nodes = sides.nodesOf(side);
    for (int i = 0; i < sides.sideNodes(); ++i) coefficients(i, side) = pressures[std::size_t(nodes[i])];
    for (int edge = 0; edge < sides.sideNodes() - sides.vertices(); ++edge) {
      const auto [i, j] = edgeVertices(edge);
      double& middle = coefficients(sides.vertices() + edge, side);
      middle = 2 * middle - 0.5 * (coefficients(i, side) + coefficients(j, side));
      if (!sides.mayPull) middle = std::max(0.0, middle);
    }
    for (int i = 0; i < sides.sideNodes(); ++i)
      if (part.isSaturated[std::size_t(side)] || coefficients(i, side) > sides.limit) coefficients(i, side) = sides.limit;
  }
  return coefficients;
}

using Entries = std::vector<Eigen::Triplet<double>>;

/// Moments of the Bernstein coefficients of a side, which are the unknowns `first`, ...
void addMoments(const PressedSides& sides, int side, const std::vector<int>& rows, int first, const Matrix& moments, Entries& entries) {
  for (int i = 0; i < sides.sideNodes(); ++i)
    for (int j = 0; j < sides.sideNodes(); ++j)
      if (moments(i, j) != 0)
        entries.emplace_back(rows[std::size_t(sides.nodesOf(side)[i])], first + j, sides.sizes[std::size_t(side)] * moments(i, j));
}

Matrix bernsteinMoments(const PressedSides& sides) {
  return sideMass(sides.dimension, sides.degree) * bernsteinValues(sides.dimension, sides.degree);
}

/// Force minus moment at each node.
std::vector<double> restOf(const PressedSides& sides, const Matrix& coefficients) {
  std::vector<double> rest = sides.forces;
  const Matrix moments = bernsteinMoments(sides) * coefficients;
  for (int side = 0; side < sides.sides(); ++side)
    for (int i = 0; i < sides.sideNodes(); ++i)
      rest[std::size_t(sides.nodesOf(side)[i])] -= sides.sizes[std::size_t(side)] * moments(i, side);
  return rest;
}

/// Limits of unknowns, the first of which are Bernstein coefficients; those of degree 2 may exceed values between them.
void setLimits(const PressedSides& sides, int coefficients, NonnegativeProblem& problem) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (sides.mayPull) {
    problem.lowest = Vector::Zero(problem.start.size());
    problem.lowest.head(coefficients).setConstant(-infinity);
  }
  if (!std::isfinite(sides.limit)) return;
  problem.highest = Vector::Constant(problem.start.size(), infinity);
  problem.highest.head(coefficients).setConstant(sides.limit);
}

/// Pressures on full sides that balance all forces exactly; false if there are none.
bool fitsExactly(const PressedPart& part, const Matrix& smooth, PartPressures& result) {
  const PressedSides& sides = part.sides;
  const int functions = sides.sideNodes();
  std::vector<int> rows(sides.places.size(), -1), full;
  std::vector<double> targets, forces = sides.forces;
  const Matrix moments = bernsteinMoments(sides);
  for (int side = 0; side < sides.sides(); ++side) {
    if (!part.isSaturated[std::size_t(side)]) continue;
    if (!part.isFull[std::size_t(side)]) return false;
    result.coefficients.col(side).setConstant(sides.limit);
    const Vector carried = sides.sizes[std::size_t(side)] * moments * result.coefficients.col(side);
    for (int i = 0; i < functions; ++i) forces[std::size_t(sides.nodesOf(side)[i])] -= carried[i];
  }
  for (double& force : forces)
    if (std::abs(force) <= part.tiny) force = 0.0;
  for (int side = 0; side < sides.sides(); ++side) {
    if (!part.isFull[std::size_t(side)] || part.isSaturated[std::size_t(side)]) continue;
    full.push_back(side);
    for (int i = 0; i < functions; ++i) {
      const int node = sides.nodesOf(side)[i];
      if (rows[std::size_t(node)] >= 0) continue;
      rows[std::size_t(node)] = static_cast<int>(targets.size());
      targets.push_back(forces[std::size_t(node)]);
    }
  }
  for (std::size_t node = 0; node < rows.size(); ++node)
    if (rows[node] < 0 && std::abs(forces[node]) > part.tiny) return false;
  const int unknowns = functions * static_cast<int>(full.size());
  Entries entries;
  NonnegativeProblem problem{
      {}, Vector(unknowns), Vector(unknowns), Eigen::Map<const Vector>(targets.data(), Eigen::Index(targets.size()))};
  for (std::size_t k = 0; k < full.size(); ++k) {
    const int first = functions * static_cast<int>(k);
    addMoments(sides, full[k], rows, first, moments, entries);
    problem.weights.segment(first, functions).setConstant(sides.sizes[std::size_t(full[k])]);
    problem.start.segment(first, functions) = smooth.col(full[k]);
  }
  setLimits(sides, unknowns, problem);
  problem.columns.resize(problem.targets.size(), unknowns);
  problem.columns.setFromTriplets(entries.begin(), entries.end());
  const NonnegativeSolution solution = nonnegativeFit(problem);
  for (std::size_t k = 0; k < full.size(); ++k)
    result.coefficients.col(full[k]) = solution.values.segment(functions * static_cast<int>(k), functions);
  return solution.converged;
}

/// The scale of the pressure: the largest force of a node per mean size of its nodes' sides.
double largestPressure(const PressedSides& sides) {
  std::vector<double> areas(sides.places.size(), 0.0);
  for (int side = 0; side < sides.sides(); ++side)
    for (int i = 0; i < sides.sideNodes(); ++i)
      areas[std::size_t(sides.nodesOf(side)[i])] += sides.sizes[std::size_t(side)] / sides.sideNodes();
  double largest = 0;
  for (std::size_t node = 0; node < areas.size(); ++node) largest = std::max(largest, std::abs(sides.forces[node]) / areas[node]);
  return largest;
}

/// Sets of nodes that are connected by patterns with amplitudes.
std::vector<std::vector<int>> clustersOf(const std::vector<BalancedPattern>& patterns, const Vector& amplitudes, int nodes, double tiny) {
  DisjointSets sets(nodes);
  std::vector<char> isInside(std::size_t(nodes), 0);
  for (std::size_t k = 0; k < patterns.size(); ++k) {
    if (std::abs(amplitudes(Eigen::Index(k))) <= tiny) continue;
    for (int i = 0; i < patterns[k].size; ++i) {
      isInside[std::size_t(patterns[k].nodes[std::size_t(i)])] = 1;
      sets.join(patterns[k].nodes[0], patterns[k].nodes[std::size_t(i)]);
    }
  }
  std::vector<std::vector<int>> clusters;
  std::vector<int> numbers(std::size_t(nodes), -1);
  for (int node = 0; node < nodes; ++node) {
    if (!isInside[std::size_t(node)]) continue;
    int& number = numbers[std::size_t(sets.lowest(node))];
    if (number < 0) number = static_cast<int>(clusters.size()), clusters.emplace_back();
    clusters[std::size_t(number)].push_back(node);
  }
  return clusters;
}

/// Pressures and self-balanced patterns of least amplitudes that balance all forces together:  A c + D z = f,  c >= 0.
void fitWithPatterns(const PressedPart& part, const Matrix& smooth, double cost, PartPressures& result) {
  const PressedSides& sides = part.sides;
  const int functions = sides.sideNodes(), pressures = functions * sides.sides();
  const std::vector<BalancedPattern> patterns = balancedPatterns(sides);
  const int count = static_cast<int>(patterns.size()), unknowns = pressures + 2 * count;
  NonnegativeProblem problem{{}, Vector(unknowns), Vector(unknowns), Eigen::Map<const Vector>(sides.forces.data(), sides.count())};
  std::vector<int> rows(sides.places.size());
  for (std::size_t node = 0; node < rows.size(); ++node) rows[node] = static_cast<int>(node);
  const Matrix moments = bernsteinMoments(sides);
  Entries entries;
  for (int side = 0; side < sides.sides(); ++side) {
    addMoments(sides, side, rows, functions * side, moments, entries);
    problem.weights.segment(functions * side, functions).setConstant(sides.sizes[std::size_t(side)]);
    problem.start.segment(functions * side, functions) = smooth.col(side);
    if (!part.isFull[std::size_t(side)])
      problem.start.segment(functions * side, functions).setConstant(-cost);
    else if (part.isSaturated[std::size_t(side)])
      problem.start.segment(functions * side, functions).setConstant(sides.limit + cost);
  }
  // Amplitudes z = z+ - z-: the start -s of both with the weight w is the cost w s of their sizes.
  const double largest = problem.targets.cwiseAbs().maxCoeff();
  problem.weights.tail(2 * count).setConstant(kSpread * cost / largest);
  problem.start.tail(2 * count).setConstant(-largest / kSpread);
  for (int k = 0; k < count; ++k)
    for (std::size_t i = 0; i < std::size_t(patterns[std::size_t(k)].size); ++i)
      for (const int sign : {0, 1})
        entries.emplace_back(patterns[std::size_t(k)].nodes[i], pressures + 2 * k + sign,
                             (1 - 2 * sign) * patterns[std::size_t(k)].amplitudes[i]);
  setLimits(sides, pressures, problem);
  problem.columns.resize(sides.count(), unknowns);
  problem.columns.setFromTriplets(entries.begin(), entries.end());
  const NonnegativeSolution solution = nonnegativeFit(problem);
  result.coefficients = Eigen::Map<const Matrix>(solution.values.data(), functions, sides.sides());
  Vector amplitudes(count);
  for (int k = 0; k < count; ++k) amplitudes(k) = solution.values(pressures + 2 * k) - solution.values(pressures + 2 * k + 1);
  result.clusters = clustersOf(patterns, amplitudes, sides.count(), part.tiny);
  result.feasible = solution.converged;
  result.misfit = solution.misfit.cwiseAbs().maxCoeff() / largest;
}

PartPressures pressuresOf(const PressedPart& part) {
  PartPressures result;
  const Matrix smooth = smoothCoefficients(part);
  result.coefficients = Matrix::Zero(part.sides.sideNodes(), part.sides.sides());
  result.feasible = fitsExactly(part, smooth, result);
  const double pressure = largestPressure(part.sides);
  for (const double cost : kRestCosts) {
    if (!result.feasible && result.misfit < kNearlyFits) fitWithPatterns(part, smooth, cost * pressure, result);
  }
  result.rest = restOf(part.sides, result.coefficients);
  return result;
}

}  // namespace

Pressures admissiblePressures(const PressedSides& sides) {
  check(sides);
  Pressures all;
  all.values = Matrix::Zero(sides.sideNodes(), sides.sides());
  all.rest.assign(sides.places.size(), 0.0);
  all.feasible = true;
  double largest = 0;
  for (const double force : sides.forces) largest = std::max(largest, std::abs(force));
  if (largest == 0) return all;
  std::vector<double> missing = sides.forces;  // at nodes outside of clusters
  const Matrix& values = bernsteinValues(sides.dimension, sides.degree);
  for (const PressedPart& part : loadedParts(sides, kZeroForce * largest)) {
    const PartPressures result = pressuresOf(part);
    all.feasible = all.feasible && result.feasible;
    for (std::size_t k = 0; k < part.sideNumbers.size(); ++k)
      all.values.col(part.sideNumbers[k]) = values * result.coefficients.col(Eigen::Index(k));
    for (std::size_t node = 0; node < result.rest.size(); ++node) missing[std::size_t(part.nodeNumbers[node])] = result.rest[node];
    for (const std::vector<int>& cluster : result.clusters) {
      std::vector<int>& numbers = all.clusters.emplace_back();
      for (const int node : cluster) {
        const auto number = std::size_t(part.nodeNumbers[std::size_t(node)]);
        numbers.push_back(static_cast<int>(number));
        all.rest[number] = std::exchange(missing[number], 0.0);
      }
      std::sort(numbers.begin(), numbers.end());
    }
  }
  for (const double force : missing) all.misfit = std::max(all.misfit, std::abs(force) / largest);
  all.feasible = all.feasible && all.misfit <= 10 * kZeroForce;
  return all;
}

}  // namespace suture
