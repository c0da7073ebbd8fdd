#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <suture/answer/bound/ContactPressures.hpp>
#include <suture/answer/bound/FrictionTractions.hpp>

namespace suture {
namespace {

// Gauss points of three on [0, 1], exact up to degree 5.
const double kGaussPlace[3] = {0.5 - 0.5 * std::sqrt(0.6), 0.5, 0.5 + 0.5 * std::sqrt(0.6)};
constexpr double kGaussWeight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};

Pressures fitSides(const PressedSides& sides, const std::vector<double>& forces, double limit, bool mayPull) {
  PressedSides own = sides;
  own.forces = forces;
  own.limit = limit;
  own.mayPull = mayPull;
  return admissiblePressures(own);
}

void addClusters(const Pressures& of, FrictionTractions& result) {
  result.clusters.insert(result.clusters.end(), of.clusters.begin(), of.clusters.end());
}

/// Clusters of both fits, joined where they overlap: rests are then counted once.
void joinClusters(std::vector<std::vector<int>>& clusters) {
  for (std::size_t i = 0; i < clusters.size(); ++i)
    for (std::size_t j = i + 1; j < clusters.size();) {
      std::vector<int> both;
      std::set_intersection(clusters[i].begin(), clusters[i].end(), clusters[j].begin(), clusters[j].end(), std::back_inserter(both));
      if (both.empty()) {
        ++j;
        continue;
      }
      std::vector<int> all;
      std::set_union(clusters[i].begin(), clusters[i].end(), clusters[j].begin(), clusters[j].end(), std::back_inserter(all));
      clusters[i] = all;
      clusters.erase(clusters.begin() + std::ptrdiff_t(j));
      j = i + 1;
    }
}

/// Friction with a bound that is the same everywhere.
bool fitGiven(const PressedSides& sides, const FrictionForces& forces, FrictionTractions& result) {
  const double g = *forces.given;
  const Vector integrals = sideMass(sides.dimension, sides.degree).rowwise().sum();
  std::vector<double> targets(sides.places.size(), 0.0);
  for (int side = 0; side < sides.sides(); ++side)
    for (int i = 0; i < sides.sideNodes(); ++i)
      targets[std::size_t(sides.nodesOf(side)[i])] += g * integrals[i] * sides.sizes[std::size_t(side)];
  for (std::size_t node = 0; node < targets.size(); ++node) targets[node] += forces.tangential[node][0];
  const Pressures up = fitSides(sides, targets, 2 * g, false);
  if (!up.feasible) return false;
  result.bounds = Matrix::Constant(sides.sideNodes(), sides.sides(), g);
  result.up = up.values;
  result.down = (2 * g - up.values.array()).cwiseMax(0.0);
  result.values[0] = up.values.array() - g;
  for (std::size_t node = 0; node < up.rest.size(); ++node) result.rest[node] = {up.rest[node], 0.0};
  addClusters(up, result);
  return result.isGiven = result.feasible = true;
}

void fitBoth(const PressedSides& sides, const FrictionForces& forces, FrictionTractions& result) {
  std::array<Pressures, 2> both;
  for (int k = 0; k < 2; ++k) {
    std::vector<double> targets = forces.bounds;
    for (std::size_t node = 0; node < targets.size(); ++node) {
      targets[node] += (k == 0 ? 1 : -1) * forces.tangential[node][0];
      // Cancellation: what remains is round-off of the two forces.
      if (targets[node] <= 1e-13 * forces.bounds[node]) targets[node] = 0.0;
    }
    both[k] = fitSides(sides, targets, std::numeric_limits<double>::infinity(), false);
    addClusters(both[k], result);
  }
  joinClusters(result.clusters);
  result.feasible = both[0].feasible && both[1].feasible;
  result.up = both[0].values;
  result.down = both[1].values;
  result.values[0] = (result.up - result.down) / 2;
  result.bounds = (result.up + result.down) / 2;
  for (std::size_t node = 0; node < result.rest.size(); ++node) result.rest[node] = {(both[0].rest[node] - both[1].rest[node]) / 2, 0.0};
}

Matrix toBernstein(const PressedSides& sides, const Matrix& values) {
  return bernsteinValues(sides.dimension, sides.degree).partialPivLu().solve(values);
}

Matrix lengthsOf(const std::array<Matrix, 2>& vectors) { return (vectors[0].array().square() + vectors[1].array().square()).sqrt(); }

void fitDiscs(const PressedSides& sides, const FrictionForces& forces, FrictionTractions& result) {
  std::array<Matrix, 2> coefficients;
  for (int k = 0; k < 2; ++k) {
    std::vector<double> targets;
    for (const auto& force : forces.tangential) targets.push_back(force[k]);
    const Pressures own = fitSides(sides, targets, std::numeric_limits<double>::infinity(), true);
    if (!own.feasible) return;
    result.values[k] = own.values;
    coefficients[k] = toBernstein(sides, own.values);
  }
  const Matrix needed = lengthsOf(coefficients);
  const double largest = forces.given ? *forces.given : 0.0;
  Matrix bounds = Matrix::Constant(needed.rows(), needed.cols(), largest);
  if (!forces.given) {
    const Pressures own = fitSides(sides, forces.bounds, std::numeric_limits<double>::infinity(), false);
    if (own.feasible) bounds = toBernstein(sides, own.values).cwiseMax(0.0);
  }
  result.isGiven = forces.given && (needed.array() <= largest).all();
  for (int side = 0; side < sides.sides() && !result.isGiven; ++side) {
    const int* nodes = sides.nodesOf(side);
    if (std::all_of(nodes, nodes + sides.sideNodes(), [&](int node) { return forces.slips[std::size_t(node)] != 0; }))
      bounds.col(side).setZero();
  }
  result.bounds = bernsteinValues(sides.dimension, sides.degree) * bounds.cwiseMax(needed);
  result.feasible = true;
}

/// Value at a place of a segment of a polynomial with nodal values.
double valueOnSide(const Matrix& values, int side, double place) {
  const double first = values(0, side), second = values(1, side), line = first + place * (second - first);
  return values.rows() == 2 ? line : line + 4 * place * (1 - place) * (values(2, side) - (first + second) / 2);
}

/// Zeros of such a polynomial inside the segment, with its ends.
std::vector<double> piecesOfSlip(const Matrix& values, int side) {
  std::vector<double> all{0.0};
  const double c = values(0, side), bend = values.rows() == 2 ? 0.0 : 4 * (values(2, side) - (values(0, side) + values(1, side)) / 2);
  const double b = values(1, side) - values(0, side) + bend, a = -bend;
  const double root = b * b - 4 * a * c;
  if (root >= 0.0) {
    const double q = -0.5 * (b + (b < 0 ? -1 : 1) * std::sqrt(root));
    for (const double place : {a != 0.0 ? q / a : -1.0, q != 0.0 ? c / q : -1.0})
      if (place > 0.0 && place < 1.0) all.push_back(place);
  }
  all.push_back(1.0);
  std::sort(all.begin(), all.end());
  return all;
}

/// Integral over all segments of a function of the side and the place, between the zeros of the slip.
template <typename Function>
double integralOfSlip(const PressedSides& sides, const Matrix& slips, const Function& function) {
  double sum = 0.0;
  for (int side = 0; side < sides.sides(); ++side) {
    const std::vector<double> ends = piecesOfSlip(slips, side);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
      for (int q = 0; q < 3; ++q) {
        const double length = ends[i + 1] - ends[i];
        sum += sides.sizes[std::size_t(side)] * length * kGaussWeight[q] * function(side, ends[i] + kGaussPlace[q] * length);
      }
  }
  return sum;
}

/// Integral of the Bernstein polynomials of |slip| times g.
double boundOfDiscs(const PressedSides& sides, const FrictionTractions& friction, const std::array<Matrix, 2>& slips) {
  const Matrix sizes =
      bernsteinValues(sides.dimension, sides.degree) * lengthsOf({toBernstein(sides, slips[0]), toBernstein(sides, slips[1])});
  return gapWork(sides, friction.bounds, sizes);
}

}  // namespace

FrictionTractions frictionTractions(const PressedSides& sides, const FrictionForces& forces) {
  FrictionTractions result;
  for (Matrix& values : result.values) values = Matrix::Zero(sides.sideNodes(), sides.sides());
  result.rest.assign(sides.places.size(), {0.0, 0.0});
  if (sides.dimension == 3)
    fitDiscs(sides, forces, result);
  else if (!forces.given || !fitGiven(sides, forces, result))
    fitBoth(sides, forces, result);
  if (sides.dimension == 3 || result.feasible) return result;
  result.clusters.clear();
  result.rest.assign(sides.places.size(), {0.0, 0.0});
  fitDiscs(sides, forces, result);
  result.up = result.bounds + result.values[0];
  result.down = result.bounds - result.values[0];
  return result;
}

double slipWork(const PressedSides& sides, const FrictionTractions& friction, const std::array<Matrix, 2>& slips) {
  if (sides.dimension == 3)
    return boundOfDiscs(sides, friction, slips) - gapWork(sides, friction.values[0], slips[0]) -
           gapWork(sides, friction.values[1], slips[1]);
  // g |s| - t s is (g - t) s or (g + t) (-s): no cancellation.
  return integralOfSlip(sides, slips[0], [&](int side, double place) {
    const double slip = valueOnSide(slips[0], side, place);
    return slip > 0 ? valueOnSide(friction.down, side, place) * slip : -valueOnSide(friction.up, side, place) * slip;
  });
}

double frictionEnergy(const PressedSides& sides, const FrictionTractions& friction, const std::array<Matrix, 2>& slips) {
  if (sides.dimension == 3) return boundOfDiscs(sides, friction, slips);
  return integralOfSlip(sides, slips[0], [&](int side, double place) {
    return valueOnSide(friction.bounds, side, place) * std::abs(valueOnSide(slips[0], side, place));
  });
}

}  // namespace suture
