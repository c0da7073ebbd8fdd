// Axisymmetric bodies against 3D solutions.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/monolithic/Monolithic.hpp>
#include <suture/motion/RigidMotion.hpp>

#include "RoundScenes.hpp"

#include <map>

namespace suture {
namespace {

struct Element {
  Cell cell;
  ElementForm form;
  std::string name() const { return cellInfo(cell).name + (form == ElementForm::Mixed ? " Mixed" : " Displacement"); }
};

std::vector<Element> elements() {
  std::vector<Element> all;
  for (int c = 0; c <= static_cast<int>(Cell::Quadrilateral9); ++c)
    for (const ElementForm form : {ElementForm::Displacement, ElementForm::Mixed})
      if (c > 0 || form == ElementForm::Displacement) all.push_back({static_cast<Cell>(c), form});
  return all;
}

Vector displacementOf(const scenes::Scene& scene) {
  Monitor quiet;
  return solveMonolithic(scene.mesh, scene.constraints, scene.model, {}, quiet).displacement;
}

Matrix stressOf(const scenes::Scene& scene, const Vector& u) {
  return elementStresses(
      scene.mesh, [&](int) -> const Material& { return scene.model.materialOfBody[0]; }, PlaneModel::Strain, u);
}

// A cylinder [r0, 2] x [0, 1] whose inner nodes are displaced; u_r = a r, u_y = b y on its boundary.
scenes::Scene stretchedCylinder(const Element& element, double r0, double a, double b) {
  Box box;
  box.x0 = r0;
  box.x1 = 2;
  box.nx = 5;
  box.ny = 4;
  box.cell = element.cell;
  scenes::Scene scene = scenes::fromBoxes({box}, 7.0, 0.3);
  scene.model.materialOfBody[0].element = element.form;
  const double pi = std::acos(-1.0);
  for (int node = 0; node < scene.mesh.nodes(); ++node) {
    double* x = &scene.mesh.coordinates[2 * node];
    const double bump = std::sin(pi * (x[0] - r0) / (2 - r0)) * std::sin(pi * x[1]);
    x[0] += 0.06 * bump;
    x[1] -= 0.04 * bump;
  }
  makeAxisymmetric(scene.mesh);
  scene.model.axisymmetric = true;
  for (const char* side : {"body_left", "body_right", "body_bottom", "body_top"})
    for (const int node : scene.nodesOf(side)) {
      scene.holdNode(node, 0, a * scene.mesh.point(node)[0]);
      scene.holdNode(node, 1, b * scene.mesh.point(node)[1]);
    }
  return scene;
}

TEUCHOS_UNIT_TEST(Axisymmetric, PassesThePatchTestOnAndOffTheAxis) {
  const double a = 1e-3, b = -2e-3, lambda = 7.0 * 0.3 / (1.3 * 0.4), mu = 7.0 / 2.6, sum = 2 * a + b;
  for (const Element& element : elements())
    for (const double r0 : {0.0, 0.5}) {
      const scenes::Scene scene = stretchedCylinder(element, r0, a, b);
      const Vector u = displacementOf(scene);
      double error = 0;
      for (int node = 0; node < scene.mesh.nodes(); ++node)
        error = std::max(
            {error, std::abs(u(2 * node) - a * scene.mesh.point(node)[0]), std::abs(u(2 * node + 1) - b * scene.mesh.point(node)[1])});
      TEST_COMPARE(error, <, 1e-12 * 2e-3);
      const Matrix stress = stressOf(scene, u);
      for (int e = 0; e < scene.mesh.elements(); ++e) {
        TEST_COMPARE(std::abs(stress(e, 0) - lambda * sum - 2 * mu * a), <, 1e-13);
        TEST_COMPARE(std::abs(stress(e, 1) - lambda * sum - 2 * mu * b), <, 1e-13);
        TEST_COMPARE(std::abs(stress(e, 2) - lambda * sum - 2 * mu * a), <, 1e-13);
      }
    }
}

struct SphereErrors {
  double displacement;  // largest at nodes, relative
  double hoop;          // relative error of the mean hoop stress over the elements, by area
};

// Lame: a hollow sphere under inner pressure p; u = p a^3 / (E (b^3 - a^3)) ((1 - 2 nu) R + (1 + nu) b^3 / (2 R^2)),
// s_RR = p a^3 / (b^3 - a^3) (1 - b^3 / R^3), s_tt = p a^3 / (b^3 - a^3) (1 + b^3 / (2 R^3)).
SphereErrors hollowSphere(const Element& element, double nu, int cells) {
  scenes::Scene scene =
      scenes::quarterRing(element.cell, scenes::kInner, scenes::kOuter, cells, 2 * cells, {"m", scenes::kYoung, nu, element.form}, true);
  scene.pressure("body_left", scenes::kPressure);
  const Vector u = displacementOf(scene);
  const double b3 = scenes::kOuter * scenes::kOuter * scenes::kOuter, factor = scenes::kPressure / (b3 - 1);
  const auto exact = [&](double r) { return factor / scenes::kYoung * ((1 - 2 * nu) * r + (1 + nu) * b3 / (2 * r * r)); };
  const Matrix stress = stressOf(scene, u);
  double found = 0, expected = 0;
  for (int e = 0; e < scene.mesh.elements(); ++e) {
    Point p{0, 0, 0};
    const Span<const int> nodes = scene.mesh.nodesOf(e);
    for (int i = 0; i < cellInfo(element.cell).vertices; ++i)
      for (int k = 0; k < 2; ++k) p[k] += scene.mesh.point(nodes[i])[k] / cellInfo(element.cell).vertices;
    const double r = std::hypot(p[0], p[1]), hoop = factor * (1 + b3 / (2 * r * r * r));
    found += std::abs(stress(e, 2) - hoop);
    expected += hoop;
  }
  return {scenes::radialError(scene, u, exact), found / expected};
}

TEUCHOS_UNIT_TEST(Axisymmetric, HollowSpheresFollowLame) {
  // Orders of the largest nodal error: that of L2, or better; the centres of edges of Triangle6 that cross the shell are not on rays.
  const std::map<Cell, double> least{{Cell::Triangle3, 1.6},
                                     {Cell::Triangle6, 2.6},
                                     {Cell::Quadrilateral4, 1.9},
                                     {Cell::Quadrilateral8, 3.0},
                                     {Cell::Quadrilateral9, 3.0}};
  for (const double nu : {0.3, 0.4999})
    for (const Element& element : elements()) {
      const SphereErrors coarse = hollowSphere(element, nu, 4), fine = hollowSphere(element, nu, 8);
      const double order = std::log2(coarse.displacement / fine.displacement);
      out << element.name() << ", nu " << nu << ": displacement " << fine.displacement << ", order " << order << "; hoop stress "
          << fine.hoop << "\n";
      if (nu > 0.4 && element.form == ElementForm::Displacement) {  // locks, or has no pressure
        TEST_COMPARE(fine.hoop, >, 0.4);
        continue;
      }
      TEST_COMPARE(order, >, least.at(element.cell));
      TEST_COMPARE(fine.displacement, <, element.cell == Cell::Triangle3 ? 0.03 : element.cell == Cell::Quadrilateral4 ? 0.01 : 1e-3);
      TEST_COMPARE(fine.hoop, <, element.cell == Cell::Triangle3 ? 0.05 : 0.01);
    }
}

TEUCHOS_UNIT_TEST(Axisymmetric, ADiscUnderInnerPressureIsLamesDisc) {
  // Free to change its thickness: plane stress, which no axisymmetric law includes. u = p a^2 / (E (b^2 - a^2)) ((1 - nu) r + (1 + nu) b^2
  // / r).
  Box box;
  box.x0 = scenes::kInner;
  box.x1 = scenes::kOuter;
  box.y1 = 0.25;
  box.nx = 32;
  box.ny = 4;
  box.cell = Cell::Quadrilateral9;
  const double nu = 0.3;
  scenes::Scene scene = scenes::fromBoxes({box}, scenes::kYoung, nu);
  makeAxisymmetric(scene.mesh);
  scene.model.axisymmetric = true;
  scene.hold("body_bottom", 1, 0.0);
  scene.pressure("body_left", scenes::kPressure);
  const Vector u = displacementOf(scene);
  const double factor = scenes::kPressure / (scenes::kOuter * scenes::kOuter - 1) / scenes::kYoung;
  for (int node = 0; node < scene.mesh.nodes(); ++node) {
    const double r = scene.mesh.point(node)[0];
    TEST_FLOATING_EQUALITY(u(2 * node), factor * ((1 - nu) * r + (1 + nu) * 4 / r), 1e-6);
    TEST_COMPARE(std::abs(u(2 * node + 1) + 2 * nu * factor * scene.mesh.point(node)[1]), <, 2e-5 * factor);
  }
}

TEUCHOS_UNIT_TEST(Axisymmetric, BodiesMoveAlongTheirAxisOnly) {
  scenes::Scene scene = scenes::quarterRing(Cell::Quadrilateral4, 1, 2, 2, 4, {"m", 1.0, 0.3}, true);
  for (NodeRule& rule : scene.constraints.rules)
    if (rule.fixed[1]) rule.fixed[1] = false;  // only the axis remains
  const RigidParts rigid = freeRigidMotions(scene.mesh, scene.constraints);
  TEST_EQUALITY(rigid.parts[0].free.cols(), 1);
  TEST_FLOATING_EQUALITY(std::abs(rigid.parts[0].free(1, 0)), 1.0, 1e-14);
}

}  // namespace
}  // namespace suture
