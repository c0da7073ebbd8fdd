// Pressures on contact surfaces from forces integrated by hand.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/answer/error/PressureField.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/SideGeometry.hpp>

#include <cmath>
#include <functional>
#include <set>

namespace suture {
namespace pressuresurfaces {

/// The square [0, 1]^2 in a plane through the origin in 3D, n x n quadrilaterals or twice as many triangles. Nodes are numbered on a grid
/// of (2 n + 1)^2 positions.
struct Sheet {
  int n, nodes;
  std::vector<ContactSide> sides;

  Sheet(int n, int nodes) : n(n), nodes(nodes) {
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int x = 2 * i, y = 2 * j;
        const bool isTriangle = nodes == 3 || nodes == 6;
        if (isTriangle) {
          add({{x, y}, {x + 2, y}, {x + 2, y + 2}});
          add({{x, y}, {x + 2, y + 2}, {x, y + 2}});
        } else {
          add({{x, y}, {x + 2, y}, {x + 2, y + 2}, {x, y + 2}});
        }
      }
  }
  Point plane(GlobalId node) const { return {double(node % (2 * n + 1)) / (2 * n), double(node / (2 * n + 1)) / (2 * n), 0}; }
  Point place(GlobalId node) const {
    const Point p = plane(node);
    return plus(scaled(p[0], {0.6, 0, 0.8}), scaled(p[1], {0, 1, 0}));
  }

 private:
  void add(std::vector<std::array<int, 2>> places) {
    const std::size_t vertices = places.size();
    for (std::size_t k = 0; nodes > 4 && k < vertices; ++k) {
      const auto &a = places[k], &b = places[(k + 1) % vertices];
      places.push_back({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2});
    }
    if (nodes == 9) places.push_back({(places[0][0] + places[2][0]) / 2, (places[0][1] + places[2][1]) / 2});
    ContactSide& side = sides.emplace_back();
    side.dimension = 3;
    for (const auto& p : places) {
      side.nodes.push_back(p[1] * (2 * n + 1) + p[0]);
      side.points.push_back(place(side.nodes.back()));
    }
  }
};

/// Integrals of p times the linear functions of the vertices of a side, p linear on triangles, bilinear on rectangles: by hand.
std::vector<double> vertexForces(const ContactSide& side, const std::function<double(GlobalId)>& p) {
  const std::size_t vertices = std::size_t(sideVertices(int(side.nodes.size()), 3));
  std::vector<double> q, forces;
  for (std::size_t v = 0; v < vertices; ++v) q.push_back(p(side.nodes[v]));
  const double area = norm(cross(minus(side.points[1], side.points[0]), minus(side.points[vertices - 1], side.points[0])));
  for (std::size_t v = 0; v < vertices; ++v)
    forces.push_back(vertices == 3 ? area / 24 * (q[0] + q[1] + q[2] + q[v])
                                   : area / 36 * (4 * q[v] + 2 * q[(v + 1) % 4] + q[(v + 2) % 4] + 2 * q[(v + 3) % 4]));
  return forces;
}

/// Closed pairs with these forces.
std::vector<PairResult> pairsWith(const std::map<GlobalId, double>& forces) {
  std::vector<PairResult> pairs;
  for (const auto& [node, force] : forces) {
    PairResult& pair = pairs.emplace_back();
    pair.id = int(pairs.size()) - 1;
    pair.line = 0;
    pair.node = node;
    pair.state = PairStatus::Slip;
    pair.force = force;
  }
  return pairs;
}

/// Closed pairs at the vertices with the forces of a pressure.
std::vector<PairResult> pairsAtVertices(const Sheet& sheet, const std::function<double(GlobalId)>& p) {
  std::map<GlobalId, double> forces;
  for (const ContactSide& side : sheet.sides) {
    const std::vector<double> own = vertexForces(side, p);
    for (std::size_t v = 0; v < own.size(); ++v) forces[side.nodes[v]] += own[v];
  }
  return pairsWith(forces);
}

TEUCHOS_UNIT_TEST(PressureSurfaces, RecoverThePressureFromItsForces) {
  for (const int nodes : {3, 4, 6, 8, 9}) {
    const Sheet sheet(3, nodes);
    const auto p = [&](GlobalId node) {
      const Point x = sheet.plane(node);
      return 2.0 + 3.0 * x[0] - 1.5 * x[1] + (nodes == 3 || nodes == 6 ? 0.0 : x[0] * x[1]);
    };
    const std::vector<PairResult> pairs = pairsAtVertices(sheet, p);
    const auto field = pressureField(sheet.sides, 0, pairs, {});
    std::set<GlobalId> all;
    for (const ContactSide& side : sheet.sides) all.insert(side.nodes.begin(), side.nodes.end());
    TEST_EQUALITY(field.size(), all.size());  // at middles and centres, too: on straight sides
    for (const auto& [node, value] : field) TEST_FLOATING_EQUALITY(value, p(node), 1e-12);
    TEST_ASSERT(pressureField(sheet.sides, 1, pairs, {}).empty());  // another contact has other pairs
  }
}

/// Forces of a linear p at all six or eight nodes of a side with multipliers of positive integrals, alpha = 1/5: integrals of p phi by hand
/// (triangles: of barycentric monomials; rectangles: by Simpson's rule in both directions), then combined.
std::vector<double> multiplierForces(const ContactSide& side, const std::function<double(GlobalId)>& p) {
  const std::size_t nodes = side.nodes.size(), vertices = nodes / 2;
  const double area = norm(cross(minus(side.points[1], side.points[0]), minus(side.points[vertices - 1], side.points[0])));
  std::vector<double> q, forces(nodes);
  for (const GlobalId node : side.nodes) q.push_back(p(node));
  const double sum = q[0] + q[1] + q[2] + (vertices == 4 ? q[3] : 0.0);
  for (std::size_t v = 0; v < vertices; ++v) {
    forces[v] = vertices == 3 ? area / 2 * (3 * q[v] - sum) / 60 : area / 36 * (q[v] - sum);
    forces[vertices + v] = vertices == 3 ? area / 2 * (sum + q[v] + q[(v + 1) % 3]) / 15 : area / 36 * (4 * q[4 + v] + 2 * sum);
  }
  for (std::size_t v = 0; v < vertices; ++v) forces[v] += 0.2 * (forces[vertices + v] + forces[vertices + (v + vertices - 1) % vertices]);
  for (std::size_t m = vertices; m < nodes; ++m) forces[m] *= 0.6;
  return forces;
}

TEUCHOS_UNIT_TEST(PressureSurfaces, HaveTheMultipliersFunctionsOfPairsAtMiddles) {
  for (const int nodes : {6, 8}) {
    const Sheet sheet(3, nodes);
    const auto p = [&](GlobalId node) { return 2.0 + 3.0 * sheet.plane(node)[0] - 1.5 * sheet.plane(node)[1]; };
    std::map<GlobalId, double> forces;
    for (const ContactSide& side : sheet.sides) {
      const std::vector<double> own = multiplierForces(side, p);
      for (std::size_t i = 0; i < own.size(); ++i) forces[side.nodes[i]] += own[i];
    }
    std::vector<PairResult> pairs = pairsWith(forces);
    const auto field = pressureField(sheet.sides, 0, pairs, {});
    TEST_EQUALITY(field.size(), forces.size());
    for (const auto& [node, value] : field) TEST_FLOATING_EQUALITY(value, p(node), 1e-12);

    // One closed pair at an inner vertex: p_h is its function, with a fifth at the adjacent middle nodes.
    const GlobalId vertex = 2 * 7 + 2;
    for (PairResult& pair : pairs)
      if (pair.node != vertex) pair.state = PairStatus::Open, pair.force = 0.0;
    const auto single = pressureField(sheet.sides, 0, pairs, {});
    TEST_EQUALITY(single.size(), nodes == 6 ? 7u : 5u);
    for (const auto& [node, value] : single) TEST_FLOATING_EQUALITY(value, single.at(vertex) * (node == vertex ? 1.0 : 0.2), 1e-12);
  }
}

/// Pairs at all nodes of the sides: each force belongs to its node's function. 9 nodes by Simpson's rule in both directions.
TEUCHOS_UNIT_TEST(PressureSurfaces, HaveTheFunctionsOfNinePairsOnASide) {
  const Sheet sheet(2, 9);
  const double q = 7.0;
  std::map<GlobalId, double> forces;
  for (const ContactSide& side : sheet.sides)
    for (std::size_t i = 0; i < 9; ++i) forces[side.nodes[i]] += q * 0.25 * (i < 4 ? 1.0 / 36 : i < 8 ? 4.0 / 36 : 16.0 / 36);
  const std::vector<PairResult> pairs = pairsWith(forces);
  const auto field = pressureField(sheet.sides, 0, pairs, {});
  TEST_EQUALITY(field.size(), 25u);
  for (const auto& entry : field) TEST_FLOATING_EQUALITY(entry.second, q, 1e-12);
}

TEUCHOS_UNIT_TEST(PressureSurfaces, AreZeroWhereNoPairIsClosed) {
  const Sheet sheet(4, 4);
  std::vector<PairResult> pairs = pairsAtVertices(sheet, [&](GlobalId node) { return std::max(0.0, 1 - 2 * sheet.plane(node)[0]); });
  for (PairResult& pair : pairs)
    if (sheet.plane(pair.node)[0] > 0.49) pair.state = PairStatus::Open, pair.force = 0.0;
  const auto field = pressureField(sheet.sides, 0, pairs, {});
  for (const PairResult& pair : pairs) {
    const double x = sheet.plane(pair.node)[0];
    TEST_EQUALITY(field.count(pair.node), x < 0.49 ? 1u : 0u);
    if (x < 0.49) TEST_FLOATING_EQUALITY(field.at(pair.node), 1 - 2 * x, 1e-11);
  }
}

}  // namespace pressuresurfaces
}  // namespace suture
