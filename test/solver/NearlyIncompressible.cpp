// Mixed elements as Poisson's ratio tends to 0.5; displacement elements do lock there.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/monolithic/Monolithic.hpp>

#include "RoundScenes.hpp"

#include <map>

namespace suture {
namespace {

struct Cylinder {
  double displacement, stress;  // relative errors; stress: mean stress at centroids
};

// Lame: a tube under inner pressure in plane strain.
Cylinder cylinder(Cell cell, ElementForm form, double nu, int cells) {
  scenes::Scene scene = scenes::quarterRing(cell, scenes::kInner, scenes::kOuter, cells, 2 * cells, {"rubber", scenes::kYoung, nu, form});
  scene.pressure("body_left", scenes::kPressure);
  Monitor quiet;
  const Vector u = solveMonolithic(scene.mesh, scene.constraints, scene.model, {}, quiet).displacement;
  const double a2 = scenes::kInner * scenes::kInner, b2 = scenes::kOuter * scenes::kOuter, factor = scenes::kPressure * a2 / (b2 - a2);
  Cylinder errors;
  errors.displacement =
      scenes::radialError(scene, u, [&](double r) { return (1 + nu) / scenes::kYoung * factor * ((1 - 2 * nu) * r + b2 / r); });
  const Matrix stress = elementStresses(
      scene.mesh, [&](int) -> const Material& { return scene.model.materialOfBody[0]; }, PlaneModel::Strain, u);
  errors.stress = 0;  // s_rr + s_tt = 2 factor, the same everywhere, and s_zz = nu times it
  for (int e = 0; e < scene.mesh.elements(); ++e)
    errors.stress = std::max({errors.stress, std::abs(stress(e, 0) + stress(e, 1) - 2 * factor) / (2 * factor),
                              std::abs(stress(e, 2) - nu * 2 * factor) / (2 * factor)});
  return errors;
}

TEUCHOS_UNIT_TEST(NearlyIncompressible, MixedElementsFollowLame) {
  // 8 x 16 cells; as accurate as at nu = 0.3, however near to 0.5. Pressures at centroids: that of Quadrilateral4 has the order of the
  // geometry.
  const std::map<Cell, std::pair<double, double>> most{{Cell::Quadrilateral4, {4e-3, 4e-3}},
                                                       {Cell::Quadrilateral8, {1e-5, 1e-2}},
                                                       {Cell::Quadrilateral9, {1e-5, 1e-2}},
                                                       {Cell::Triangle6, {2e-4, 5e-3}}};
  for (const auto& [cell, bands] : most)
    for (const double nu : {0.3, 0.49, 0.4999, 0.499999}) {
      const Cylinder mixed = cylinder(cell, ElementForm::Mixed, nu, 8);
      out << cellInfo(cell).name << ", nu " << nu << ": displacement " << mixed.displacement << ", pressure " << mixed.stress << "\n";
      TEST_COMPARE(mixed.displacement, <, bands.first);
      TEST_COMPARE(mixed.stress, <, bands.second);
    }
}

TEUCHOS_UNIT_TEST(NearlyIncompressible, DisplacementElementsLockOrLoseTheirPressure) {
  // Failures of displacement elements. Quadrilateral4 does not deform at all; quadratic ones do, with meaningless pressures.
  TEST_COMPARE(cylinder(Cell::Quadrilateral4, ElementForm::Displacement, 0.3, 8).displacement, <, 4e-3);
  TEST_COMPARE(cylinder(Cell::Quadrilateral4, ElementForm::Displacement, 0.499999, 8).displacement, >, 0.9);
  for (const Cell cell : {Cell::Quadrilateral8, Cell::Quadrilateral9, Cell::Triangle6})
    TEST_COMPARE(cylinder(cell, ElementForm::Displacement, 0.4999, 8).stress, >, 10.0);
}

// Cook's membrane: the trapezoid (0,0), (48,44), (48,60), (0,44), clamped on the left, sheared on the right.
double cook(Cell cell, ElementForm form, int cells, double nu) {
  Box box;
  box.nx = box.ny = cells;
  box.cell = cell;
  scenes::Scene scene = scenes::fromBoxes({box}, 250.0, nu);
  scene.model.materialOfBody[0].element = form;
  for (int node = 0; node < scene.mesh.nodes(); ++node) {
    double* x = &scene.mesh.coordinates[2 * node];
    const double s = x[0], t = x[1];
    x[0] = 48 * s;
    x[1] = 44 * s + (44 - 28 * s) * t;
  }
  scene.hold("body_left", 0, 0.0);
  scene.hold("body_left", 1, 0.0);
  scene.traction("body_right", {0, 6.25, 0});
  Monitor quiet;
  const Vector u = solveMonolithic(scene.mesh, scene.constraints, scene.model, {}, quiet).displacement;
  for (const int node : scene.nodesOf("body_top"))
    if (scene.mesh.point(node)[0] == 48) return u(2 * node + 1);
  return 0;
}

TEUCHOS_UNIT_TEST(NearlyIncompressible, CooksMembraneIsThatOfARefinedMeshOfAnotherElement) {
  // Quadratic triangles without pressure do not lock in the displacement: the reference is free of the tested effect.
  const double reference = cook(Cell::Triangle6, ElementForm::Displacement, 96, 0.4999);
  out << "reference " << reference << "\n";
  const std::map<Cell, int> cells{{Cell::Quadrilateral4, 64}, {Cell::Quadrilateral8, 32}, {Cell::Quadrilateral9, 8}, {Cell::Triangle6, 16}};
  for (const auto& [cell, n] : cells) {
    const double found = cook(cell, ElementForm::Mixed, n, 0.4999);
    out << cellInfo(cell).name << " " << n << ": " << found << "\n";
    TEST_FLOATING_EQUALITY(found, reference, 1e-2);
  }
  TEST_COMPARE(cook(Cell::Quadrilateral4, ElementForm::Displacement, 64, 0.4999), <, 0.6 * reference);
}

}  // namespace
}  // namespace suture
