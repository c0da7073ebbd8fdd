// Every element against an exact solution of plane strain without body force: the order of its errors in the mesh size.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/elasticity/ElementMap.hpp>
#include <suture/monolithic/Monolithic.hpp>

#include "RoundScenes.hpp"

#include <cmath>
#include <complex>
#include <map>

namespace suture {
namespace {

using Complex = std::complex<double>;

// Kolosov and Muskhelishvili with phi = z^3, psi = 0: 2 mu (u + i v) = kappa phi - z conj(phi'), s_xx + s_yy = 4 Re phi',
// s_yy - s_xx + 2 i s_xy = 2 conj(z) phi''.
constexpr double kShear = 1.0;
double youngOf(double poisson) { return 2 * (1 + poisson) * kShear; }

Point exactDisplacement(const Point& p, double poisson) {
  const Complex z(p[0], p[1]);
  const Complex u = ((3 - 4 * poisson) * z * z * z - z * std::conj(3.0 * z * z)) / (2 * kShear);
  return {u.real(), u.imag(), 0};
}

std::array<double, 3> exactStress(const Point& p) {
  const Complex z(p[0], p[1]);
  const double sum = 4 * (3.0 * z * z).real();
  const Complex difference = 2.0 * std::conj(z) * 6.0 * z;
  return {(sum - difference.real()) / 2, (sum + difference.real()) / 2, difference.imag() / 2};
}

// The unit square, its inner lines bent; exact displacements on its boundary.
scenes::Scene bentSquare(Cell cell, int cells, double poisson = 0.3, ElementForm form = ElementForm::Displacement) {
  Box box;
  box.nx = box.ny = cells;
  box.cell = cell;
  scenes::Scene scene = scenes::fromBoxes({box}, youngOf(poisson), poisson);
  scene.model.materialOfBody[0].element = form;
  const double pi = std::acos(-1.0);
  for (int node = 0; node < scene.mesh.nodes(); ++node) {
    double* x = &scene.mesh.coordinates[2 * node];
    const double bump = std::sin(pi * x[0]) * std::sin(pi * x[1]);
    x[0] += 0.06 * bump;
    x[1] -= 0.04 * bump;
  }
  for (const char* side : {"body_left", "body_right", "body_bottom", "body_top"})
    for (const int node : scene.nodesOf(side))
      for (int k = 0; k < 2; ++k) scene.holdNode(node, k, exactDisplacement(scene.mesh.point(node), poisson)[k]);
  return scene;
}

struct BendingErrors {
  double displacement, stress;  // in the norm of L2; stress at centroids, weighted by areas
};

BendingErrors errorsOf(Cell cell, int cells, double poisson = 0.3, ElementForm form = ElementForm::Displacement) {
  const scenes::Scene scene = bentSquare(cell, cells, poisson, form);
  const Mesh& mesh = scene.mesh;
  Monitor quiet;
  const Vector u = solveMonolithic(mesh, scene.constraints, scene.model, {}, quiet).displacement;
  const Matrix stress = elementStresses(
      mesh, [&](int) -> const Material& { return scene.model.materialOfBody[0]; }, PlaneModel::Strain, u);
  const ReferenceElement &rule = referenceElement(cell, Rule::Stiffness), &centroid = referenceElement(cell, Rule::Centroid);
  const auto placeAt = [&](const ReferenceElement& reference, int element, int q) {
    Point p{0, 0, 0};
    for (int a = 0; a < reference.nodes; ++a)
      for (int k = 0; k < 2; ++k) p[k] += reference.valuesAt(q)[a] * mesh.point(mesh.nodesOf(element)[a])[k];
    return p;
  };
  BendingErrors squares{0, 0};
  for (int e = 0; e < mesh.elements(); ++e) {
    ElementMap<2> map(mesh, e, rule);
    double area = 0;
    for (int q = 0; q < rule.points; ++q) {
      map.at(q);
      area += map.measure();
      const Point exact = exactDisplacement(placeAt(rule, e, q), poisson);
      for (int k = 0; k < 2; ++k) {
        double value = -exact[k];
        for (int a = 0; a < rule.nodes; ++a) value += rule.valuesAt(q)[a] * u(2 * mesh.nodesOf(e)[a] + k);
        squares.displacement += map.measure() * value * value;
      }
    }
    const std::array<double, 3> exact = exactStress(placeAt(centroid, e, 0));
    squares.stress +=
        area * (std::pow(stress(e, 0) - exact[0], 2) + std::pow(stress(e, 1) - exact[1], 2) + 2 * std::pow(stress(e, 3) - exact[2], 2));
  }
  return {std::sqrt(squares.displacement), std::sqrt(squares.stress)};
}

TEUCHOS_UNIT_TEST(ElementOrders, AreThoseOfTheoryForEveryCell) {
  // Displacement p + 1. Stress at least p; Quadrilateral4 has second order at the centroid, where its gradients are best.
  const std::map<std::string, std::pair<double, double>> least{
      {"Triangle3", {2, 1}}, {"Quadrilateral4", {2, 2}}, {"Triangle6", {3, 2}}, {"Quadrilateral8", {3, 2}}, {"Quadrilateral9", {3, 2}}};
  for (int c = 0; c <= static_cast<int>(Cell::Quadrilateral9); ++c) {
    const Cell cell = static_cast<Cell>(c);
    const BendingErrors coarse = errorsOf(cell, 8), fine = errorsOf(cell, 16);
    const double displacement = std::log2(coarse.displacement / fine.displacement), stress = std::log2(coarse.stress / fine.stress);
    const auto& [p, q] = least.at(cellInfo(cell).name);
    out << cellInfo(cell).name << ": displacement " << fine.displacement << ", order " << displacement << "; stress " << fine.stress
        << ", order " << stress << "\n";
    TEST_COMPARE(displacement, >, p - 0.1);
    TEST_COMPARE(displacement, <, p + 1.1);
    TEST_COMPARE(stress, >, q - 0.1);
    TEST_COMPARE(fine.displacement, <, 2e-2);  // u is of the order of one: the right solution, not a similar one
  }
}

TEUCHOS_UNIT_TEST(ElementOrders, OfMixedElementsDoNotDependOnPoissonsRatio) {
  // A constant pressure limits quadratic displacements to second order; the linear one of Quadrilateral9 does not.
  const std::map<Cell, std::pair<double, double>> least{
      {Cell::Quadrilateral4, {2, 2}}, {Cell::Triangle6, {2, 1}}, {Cell::Quadrilateral8, {2, 1}}, {Cell::Quadrilateral9, {3, 2}}};
  for (const auto& [cell, orders] : least) {
    const BendingErrors easy = errorsOf(cell, 16, 0.3, ElementForm::Mixed);
    for (const double poisson : {0.4999, 0.49999999}) {
      const BendingErrors coarse = errorsOf(cell, 8, poisson, ElementForm::Mixed), fine = errorsOf(cell, 16, poisson, ElementForm::Mixed);
      const double displacement = std::log2(coarse.displacement / fine.displacement), stress = std::log2(coarse.stress / fine.stress);
      out << cellInfo(cell).name << ", 0.5 - nu = " << 0.5 - poisson << ": displacement " << fine.displacement << ", order " << displacement
          << "; stress " << fine.stress << ", order " << stress << "\n";
      TEST_COMPARE(displacement, >, orders.first - 0.1);
      TEST_COMPARE(stress, >, orders.second - 0.1);
      TEST_COMPARE(fine.displacement, <, 2.2 * easy.displacement);
      TEST_COMPARE(fine.stress, <, 2.5 * easy.stress);
      TEST_COMPARE(errorsOf(cell, 16, poisson).stress, >, 4 * fine.stress);  // stress error of displacement elements
    }
  }
}

// Lame's tube under inner pressure, its nodes' largest error; optionally with the middles of the sides on their chords.
double tube(Cell cell, int cells, bool straight) {
  const double a = 1, b = 2, pressure = 0.1, poisson = 0.3;
  scenes::Scene scene = scenes::quarterRing(cell, a, b, cells, 2 * cells, {"m", youngOf(poisson), poisson});
  if (straight)
    for (int e = 0; e < scene.mesh.elements(); ++e) {
      const CellInfo& info = cellInfo(cell);
      const Span<const int> nodes = scene.mesh.nodesOf(e);
      for (const auto& side : info.sideNodes)
        for (int k = 0; k < 2; ++k)
          scene.mesh.coordinates[2 * nodes[side[2]] + k] = (scene.mesh.point(nodes[side[0]])[k] + scene.mesh.point(nodes[side[1]])[k]) / 2;
    }
  scene.pressure("body_left", pressure);
  Monitor quiet;
  const Vector u = solveMonolithic(scene.mesh, scene.constraints, scene.model, {}, quiet).displacement;
  const double factor = (1 + poisson) / youngOf(poisson) * pressure * a * a / (b * b - a * a);
  return scenes::radialError(scene, u, [&](double r) { return factor * ((1 - 2 * poisson) * r + b * b / r); });
}

TEUCHOS_UNIT_TEST(ElementOrders, CurvedSidesKeepTheOrderThatChordsLose) {
  for (const Cell cell : {Cell::Triangle6, Cell::Quadrilateral8, Cell::Quadrilateral9}) {
    const double curved = std::log2(tube(cell, 6, false) / tube(cell, 12, false)),
                 straight = std::log2(tube(cell, 6, true) / tube(cell, 12, true));
    out << cellInfo(cell).name << ": error " << tube(cell, 12, false) << ", order " << curved << "; on chords " << tube(cell, 12, true)
        << ", order " << straight << "\n";
    TEST_COMPARE(curved, >, 2.8);
    TEST_COMPARE(straight, <, 2.3);
  }
}

TEUCHOS_UNIT_TEST(ElementOrders, MeshesOfTrianglesAndQuadrilateralsPassThePatchTest) {
  // Every third quadrilateral cut in two; linear displacements on the boundary.
  scenes::Scene scene = bentSquare(Cell::Quadrilateral4, 6);
  Mesh cut = scene.mesh;
  cut.cells.clear(), cut.connectivity.clear(), cut.offsets = {0};
  for (int e = 0; e < scene.mesh.elements(); ++e) {
    const Span<const int> n = scene.mesh.nodesOf(e);
    const std::vector<std::vector<int>> parts = e % 3 == 0 ? std::vector<std::vector<int>>{{n[0], n[1], n[2]}, {n[0], n[2], n[3]}}
                                                           : std::vector<std::vector<int>>{{n[0], n[1], n[2], n[3]}};
    for (const auto& nodes : parts) {
      cut.cells.push_back(nodes.size() == 3 ? Cell::Triangle3 : Cell::Quadrilateral4);
      cut.connectivity.insert(cut.connectivity.end(), nodes.begin(), nodes.end());
      cut.offsets.push_back(static_cast<int>(cut.connectivity.size()));
    }
  }
  cut.bodyOfElement.assign(cut.elements(), 0);
  scene.mesh = cut;
  const auto linear = [](const Point& p) { return Point{0.1 + 0.3 * p[0] - 0.2 * p[1], 0.5 * p[0] + 0.7 * p[1], 0}; };
  for (NodeRule& rule : scene.constraints.rules) rule.value = linear(scene.mesh.point(rule.node));
  Monitor quiet;
  const Vector u = solveMonolithic(scene.mesh, scene.constraints, scene.model, {}, quiet).displacement;
  TEST_EQUALITY(cut.elements(), 36 + 12);
  for (int node = 0; node < cut.nodes(); ++node)
    for (int k = 0; k < 2; ++k) TEST_COMPARE(std::abs(u(2 * node + k) - linear(cut.point(node))[k]), <, 1e-13);
}

}  // namespace
}  // namespace suture
