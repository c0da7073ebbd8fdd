#include <Teuchos_UnitTestHarness.hpp>
#include <suture/elasticity/ElementForces.hpp>
#include <suture/mesh/Generators.hpp>

#include <random>

namespace suture {
namespace {

struct ForcesCase {
  Mesh mesh;
  Material material;
  PlaneModel plane;
  Vector u;
  std::function<const Material&(int)> materialOf = [this](int) -> const Material& { return material; };

  ForcesCase(Cell cell, ElementForm form, PlaneModel model, bool revolved, bool enhanced = false) : plane(model) {
    Box box;
    box.x1 = 2;
    box.nx = dimensionOf(cell) == 2 ? 5 : 3;
    box.ny = dimensionOf(cell) == 2 ? 3 : 2;
    box.nz = 2;
    box.cell = cell;
    mesh = boxes({box});
    mesh.axisymmetric = revolved;
    material = {"rubber", 3.0, form == ElementForm::Mixed ? 0.4999 : 0.3, form};
    material.enhanced = enhanced;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-0.02, 0.02);
    const int d = mesh.dimension;
    u = Vector::Zero(d * mesh.nodes());
    for (int node = 0; node < mesh.nodes(); ++node)
      for (int k = 0; k < d; ++k) {
        if (mesh.coordinates[d * node] > 0.0) mesh.coordinates[d * node + k] += any(random);
        u[d * node + k] = any(random);
      }
  }
  Vector byMatrices(const Vector& u, Vector* diagonal = nullptr) const {
    Vector f = Vector::Zero(u.size());
    if (diagonal) *diagonal = f;
    elementStiffnesses(mesh, materialOf, plane, [&](int element, ConstLocalView k) {
      const Span<const int> nodes = mesh.nodesOf(element);
      const int d = mesh.dimension;
      for (int i = 0; i < k.rows(); ++i) {
        const int row = d * nodes[i / d] + i % d;
        for (int j = 0; j < k.cols(); ++j) f[row] += k(i, j) * u[d * nodes[j / d] + j % d];
        if (diagonal) (*diagonal)[row] += k(i, i);
      }
    });
    return f;
  }
};

void forAllCases(const std::function<void(ForcesCase&)>& each) {
  for (int number = 0; number < kCells; ++number)
    for (const ElementForm form : {ElementForm::Displacement, ElementForm::Mixed})
      for (const bool revolved : {false, true}) {
        const auto cell = static_cast<Cell>(number);
        if (form == ElementForm::Mixed && (cell == Cell::Triangle3 || cell == Cell::Tetrahedron4)) continue;
        if (revolved && dimensionOf(cell) == 3) continue;
        ForcesCase one(cell, form, PlaneModel::Strain, revolved);
        each(one);
        if (!mayBeEnhanced(cell)) continue;
        ForcesCase enhanced(cell, form, PlaneModel::Strain, revolved, true);
        each(enhanced);
      }
  for (const bool enhanced : {false, true}) {
    ForcesCase sheet(Cell::Quadrilateral4, ElementForm::Displacement, PlaneModel::Stress, false, enhanced);
    each(sheet);
  }
}

TEUCHOS_UNIT_TEST(ElementForces, AreThoseOfTheElementMatrices) {
  forAllCases([&](ForcesCase& one) {
    Vector diagonal;
    const Vector expected = one.byMatrices(one.u, &diagonal);
    const ElementForces forces = elementForces(one.mesh, one.materialOf, one.plane, one.u);
    TEST_COMPARE((forces.internal - expected).norm(), <, 1e-12 * expected.norm());
    for (int node = 0; node < one.mesh.nodes(); ++node) {
      const double mean = diagonal.segment(one.mesh.dimension * node, one.mesh.dimension).mean();
      TEST_COMPARE(forces.stiffness[node], <, 4 * mean);
      TEST_COMPARE(forces.stiffness[node], >, mean / 4);
    }
  });
}

TEUCHOS_UNIT_TEST(ElementForces, ATranslationCostsNothing) {
  forAllCases([&](ForcesCase& one) {
    const ElementForces still = elementForces(one.mesh, one.materialOf, one.plane, one.u);
    // integers times a power of two: no round-off
    Vector u = (one.u * 1024).array().round().matrix(), moved = u;
    for (int node = 0; node < one.mesh.nodes(); ++node)
      for (int k = one.mesh.axisymmetric ? 1 : 0; k < one.mesh.dimension; ++k)
        moved[one.mesh.dimension * node + k] += k == 1 ? -std::ldexp(1.0, 40) : std::ldexp(1.0, 40);
    const ElementForces there = elementForces(one.mesh, one.materialOf, one.plane, moved);
    const Vector here = elementForces(one.mesh, one.materialOf, one.plane, u).internal;
    TEST_COMPARE((there.internal - here).norm(), <=, 1e-11 * here.norm());
    TEST_COMPARE(there.rounding.minCoeff(), >, 1e6 * still.rounding.maxCoeff() * 1e-3);
  });
}

TEUCHOS_UNIT_TEST(ElementForces, BoundsTheEffectOfRoundedDisplacements) {
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
      worst = std::max(worst,
                       (rounded.internal - exact).segment(one.mesh.dimension * node, one.mesh.dimension).norm() / rounded.rounding[node]);
    TEST_COMPARE(worst, <, 1.5);
    TEST_COMPARE(worst, >, 1e-3);  // and the bound is not trivial
  });
}

}  // namespace
}  // namespace suture
