#include "PressedLines.hpp"

#include <cmath>
#include <map>

namespace suture {
namespace {

double uniform(std::mt19937& random) { return std::uniform_real_distribution<double>(0, 1)(random); }

/// Adds a side with these vertices; `middles` are the mid-edge nodes made so far.
void addSide(PressedSides& sides, const std::vector<int>& vertices, double size, std::map<std::pair<int, int>, int>& middles) {
  sides.nodes.insert(sides.nodes.end(), vertices.begin(), vertices.end());
  sides.sizes.push_back(size);
  if (sides.degree == 1) return;
  for (std::size_t edge = 0; edge < (vertices.size() == 2 ? 1u : 3u); ++edge) {
    const std::size_t from = edge == 2 ? 0 : edge, to = edge == 0 ? 1 : 2;
    const auto [place, isNew] = middles.emplace(std::minmax(vertices[from], vertices[to]), sides.count());
    sides.nodes.push_back(place->second);
    const Point a = sides.places[std::size_t(vertices[from])], b = sides.places[std::size_t(vertices[to])];
    if (isNew) sides.places.push_back({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, 0});
  }
}

}  // namespace

PressedSides pressedLine(const std::vector<double>& x, int degree) {
  PressedSides sides;
  sides.degree = degree;
  for (const double at : x) sides.places.push_back({at, 0, 0});
  std::map<std::pair<int, int>, int> middles;
  for (int i = 0; i + 1 < int(x.size()); ++i) addSide(sides, {i, i + 1}, x[std::size_t(i) + 1] - x[std::size_t(i)], middles);
  sides.forces.assign(sides.places.size(), 0.0);
  return sides;
}

PressedSides pressedSquare(int cells, int degree, double shift) {
  PressedSides sides;
  sides.dimension = 3;
  sides.degree = degree;
  std::mt19937 random(7);
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i)
      sides.places.push_back({(i + shift * (2 * uniform(random) - 1)) / cells, (j + shift * (2 * uniform(random) - 1)) / cells, 0});
  std::map<std::pair<int, int>, int> middles;
  const auto add = [&](int a, int b, int c) {
    const Point &p = sides.places[std::size_t(a)], &q = sides.places[std::size_t(b)], &r = sides.places[std::size_t(c)];
    addSide(sides, {a, b, c}, 0.5 * ((q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1])), middles);
  };
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const int a = j * (cells + 1) + i, b = a + 1, c = b + cells + 1, d = c - 1;
      if (uniform(random) < 0.5)
        add(a, b, c), add(a, c, d);
      else
        add(a, b, d), add(b, c, d);
    }
  sides.forces.assign(sides.places.size(), 0.0);
  return sides;
}

std::vector<double> steps(int count, double shift, std::mt19937& random) {
  std::vector<double> x;
  for (int i = 0; i <= count; ++i) x.push_back((i + (i > 0 && i < count ? shift * (uniform(random) - 0.5) : 0.0)) / count);
  return x;
}

std::vector<SidePoint> quadrature(int dimension) {
  const double half = std::sqrt(0.15);
  const double points[3] = {0.5 - half, 0.5, 0.5 + half}, weights[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  std::vector<SidePoint> all;
  for (int i = 0; i < 3; ++i) {
    if (dimension == 2) all.push_back({{1 - points[i], points[i]}, weights[i]});
    // The collapsed square: its Jacobian 2 (1 - y) raises the degree in y to 5.
    for (int j = 0; j < 3 && dimension == 3; ++j) {
      const double y = points[j], x = points[i] * (1 - y);
      all.push_back({{1 - x - y, x, y}, 2 * weights[i] * weights[j] * (1 - y)});
    }
  }
  return all;
}

std::vector<double> bernstein(const PressedSides& sides, const std::vector<double>& at) {
  if (sides.degree == 1) return at;
  std::vector<double> values;
  for (const double l : at) values.push_back(l * l);
  values.push_back(2 * at[0] * at[1]);
  if (sides.dimension == 3) values.push_back(2 * at[1] * at[2]), values.push_back(2 * at[0] * at[2]);
  return values;
}

std::vector<double> lagrange(const PressedSides& sides, const std::vector<double>& at) {
  if (sides.degree == 1) return at;
  std::vector<double> values;
  for (const double l : at) values.push_back(l * (2 * l - 1));
  values.push_back(4 * at[0] * at[1]);
  if (sides.dimension == 3) values.push_back(4 * at[1] * at[2]), values.push_back(4 * at[0] * at[2]);
  return values;
}

void press(PressedSides& sides, const std::function<double(int, int)>& p) {
  std::vector<double> coefficients(std::size_t(sides.sideNodes()));
  for (int side = 0; side < sides.sides(); ++side) {
    for (std::size_t i = 0; i < coefficients.size(); ++i) coefficients[i] = p(side, int(i));
    for (const SidePoint& point : quadrature(sides.dimension)) {
      const std::vector<double> phi = lagrange(sides, point.at), basis = bernstein(sides, point.at);
      double pressure = 0;
      for (std::size_t i = 0; i < phi.size(); ++i) pressure += coefficients[i] * basis[i];
      for (std::size_t i = 0; i < phi.size(); ++i)
        sides.forces[std::size_t(sides.nodesOf(side)[i])] += sides.sizes[std::size_t(side)] * point.weight * pressure * phi[i];
    }
  }
}

Point placeOf(const PressedSides& sides, int side, int node) { return sides.places[std::size_t(sides.nodesOf(side)[node])]; }

}  // namespace suture
