#include <Teuchos_UnitTestHarness.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/quality/ElementForces.hpp>

#include <random>

namespace suture {
namespace {

struct ForcesCase {
  Mesh mesh;
  Material material;
  PlaneModel plane;
  Vector u;
  std::function<const Material&(int)> materialOf = [this](int) -> const Material& { return material; };

  ForcesCase(Cell cell, ElementForm form, PlaneModel model, bool revolved) : plane(model) {
    Box box;
    box.x1 = 2;
    box.nx = 5;
    box.ny = 3;
    box.cell = cell;
    mesh = boxes({box});
    mesh.axisymmetric = revolved;
    material = {"rubber", 3.0, form == ElementForm::Mixed ? 0.4999 : 0.3, form};
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-0.02, 0.02);
    u = Vector::Zero(2 * mesh.nodes());
    for (int node = 0; node < mesh.nodes(); ++node)
      for (int k = 0; k < 2; ++k) {
        if (mesh.coordinates[2 * node] > 0.0) mesh.coordinates[2 * node + k] += any(random);
        u[2 * node + k] = any(random);
      }
  }
  Vector byMatrices(const Vector& u, Vector* diagonal = nullptr) const {
    Vector f = Vector::Zero(u.size());
    if (diagonal) *diagonal = f;
    elementStiffnesses(mesh, materialOf, plane, [&](int element, ConstLocalView k) {
      const Span<const int> nodes = mesh.nodesOf(element);
      for (int i = 0; i < k.rows(); ++i) {
        const int row = 2 * nodes[i / 2] + i % 2;
        for (int j = 0; j < k.cols(); ++j) f[row] += k(i, j) * u[2 * nodes[j / 2] + j % 2];
        if (diagonal) (*diagonal)[row] += k(i, i);
      }
    });
    return f;
  }
};

void forAllCases(const std::function<void(ForcesCase&)>& each) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Quadrilateral8, Cell::Quadrilateral9})
    for (const ElementForm form : {ElementForm::Displacement, ElementForm::Mixed})
      for (const bool revolved : {false, true}) {
        if (form == ElementForm::Mixed && cell == Cell::Triangle3) continue;
        ForcesCase one(cell, form, PlaneModel::Strain, revolved);
        each(one);
      }
  ForcesCase sheet(Cell::Quadrilateral4, ElementForm::Displacement, PlaneModel::Stress, false);
  each(sheet);
}

TEUCHOS_UNIT_TEST(ElementForces, AreThoseOfTheElementMatrices) {
  forAllCases([&](ForcesCase& one) {
    Vector diagonal;
    const Vector expected = one.byMatrices(one.u, &diagonal);
    const ElementForces forces = elementForces(one.mesh, one.materialOf, one.plane, one.u);
    TEST_COMPARE((forces.internal - expected).norm(), <, 1e-12 * expected.norm());
    for (int node = 0; node < one.mesh.nodes(); ++node) {
      const double mean = 0.5 * (diagonal[2 * node] + diagonal[2 * node + 1]);
      TEST_COMPARE(forces.stiffness[node], <, 4 * mean);
      TEST_COMPARE(forces.stiffness[node], >, mean / 4);
    }
  });
}

TEUCHOS_UNIT_TEST(ElementForces, ATranslationCostsNothing) {
  forAllCases([&](ForcesCase& one) {
    const ElementForces still = elementForces(one.mesh, one.materialOf, one.plane, one.u);
    // whole numbers carried by a power of two: nothing is rounded
    Vector u = (one.u * 1024).array().round().matrix(), moved = u;
    for (int node = 0; node < one.mesh.nodes(); ++node) {
      if (!one.mesh.axisymmetric) moved[2 * node] += std::ldexp(1.0, 40);
      moved[2 * node + 1] -= std::ldexp(1.0, 40);
    }
    const ElementForces there = elementForces(one.mesh, one.materialOf, one.plane, moved);
    const Vector here = elementForces(one.mesh, one.materialOf, one.plane, u).internal;
    TEST_COMPARE((there.internal - here).norm(), <=, 1e-11 * here.norm());
    TEST_COMPARE(there.rounding.minCoeff(), >, 1e6 * still.rounding.maxCoeff() * 1e-3);
  });
}

TEUCHOS_UNIT_TEST(ElementForces, RoundingBoundsWhatRoundedDisplacementsDo) {
  forAllCases([&](ForcesCase& one) {
    Vector far = one.u, near = one.u;
    for (Eigen::Index i = 0; i < far.size(); ++i) {
      if (one.mesh.axisymmetric && i % 2 == 0) continue;
      far[i] += 1e6;
      near[i] = one.u[i];
    }
    const Vector exact = elementForces(one.mesh, one.materialOf, one.plane, near).internal;
    const ElementForces rounded = elementForces(one.mesh, one.materialOf, one.plane, far);
    double worst = 0.0;
    for (int node = 0; node < one.mesh.nodes(); ++node)
      worst = std::max(worst, (rounded.internal - exact).segment<2>(2 * node).norm() / rounded.rounding[node]);
    TEST_COMPARE(worst, <, 1.5);
    TEST_COMPARE(worst, >, 1e-3);  // nor is it a bound that says nothing
  });
}

}  // namespace
}  // namespace suture
