// Initial strains and stresses of elements: free expansion without stress, and the stress of a held element.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/elasticity/ElasticModel.hpp>

#include <string>

#include "SampleCells.hpp"

using namespace suture;

namespace {

constexpr double expansion = 1e-3, warmer = 80.0;

struct Case {
  std::string name;
  CellBlock block;
  Material material;
  PlaneModel plane;
  ElasticModel model;
};

// Every cell with straight and with curved sides, each geometry and element form, enhanced ones of each geometry.
std::vector<Case> cases(const Load& load) {
  std::vector<Case> all;
  for (const Cell cell : sample::cells())
    for (const bool curved : {false, true})
      for (const std::string geometry : {"strain", "stress", "revolution", "mixed", "enhanced", "enhanced stress", "enhanced revolution"}) {
        if (geometry == "mixed" && cell == Cell::Triangle3) continue;
        const bool enhanced = geometry.find("enhanced") == 0;
        const auto is = [&](const std::string& what) { return geometry == what || geometry == "enhanced " + what; };
        if (enhanced && !mayBeEnhanced(cell)) continue;
        Case one;
        one.name = std::to_string(int(cell)) + (curved ? " curved " : " straight ") + geometry;
        one.block = curved ? sample::curved(cell) : sample::distorted(cell);
        for (std::size_t i = 0; i < one.block.coordinates.size(); i += 2) one.block.coordinates[i] += 5.0;
        one.block.axisymmetric = is("revolution");
        one.material = {"steel", 2e5, geometry == "mixed" || geometry == "enhanced" ? 0.4999 : 0.3};
        one.material.enhanced = enhanced;
        one.material.expansion = expansion;
        if (geometry == "mixed") one.material.element = ElementForm::Mixed;
        one.plane = is("stress") ? PlaneModel::Stress : PlaneModel::Strain;
        one.model.bodies = {"body"};
        one.model.loads = {load};
        all.push_back(one);
      }
  return all;
}

Vector field(const CellBlock& block, double xx, double xy, double yx, double yy) {
  Vector u(2 * block.nodes());
  for (int i = 0; i < block.nodes(); ++i) {
    const Point p = block.point(i);
    u[2 * i] = xx * p[0] + xy * p[1];
    u[2 * i + 1] = yx * p[0] + yy * p[1];
  }
  return u;
}

Vector stiffnessTimes(const Case& one, const Vector& u) {
  Vector force = Vector::Zero(u.size());
  elementStiffnesses(one.block, one.material, one.plane, [&](int e, ConstLocalView k) {
    const Span<const int> nodes = one.block.nodesOf(e);
    Vector own(2 * nodes.size());
    for (std::size_t a = 0; a < nodes.size(); ++a) own.segment<2>(2 * a) = u.segment<2>(2 * nodes[a]);
    own = (k * own).eval();
    for (std::size_t a = 0; a < nodes.size(); ++a) force.segment<2>(2 * nodes[a]) += own.segment<2>(2 * a);
  });
  return force;
}

}  // namespace

TEUCHOS_UNIT_TEST(InitialState, LetsABodyExpandWithoutStressInItsPlane) {
  for (const Case& one : cases(Load::temperature(warmer + 20.0, 20.0))) {
    out << one.name << "\n";
    const auto materialOf = [&](int) -> const Material& { return one.material; };
    const InitialState initial(one.model, 0);
    // Free in all directions that can move: in plane strain the out-of-plane strain is zero, and the others grow by (1 + nu).
    const bool held = one.plane == PlaneModel::Strain && !one.block.axisymmetric;
    const double e = expansion * warmer * (held ? 1.0 + one.material.poisson : 1.0);
    const Vector u = field(one.block, e, 0.0, 0.0, e), force = initialForces(one.block, materialOf, one.plane, initial);
    TEST_COMPARE((stiffnessTimes(one, u) - force).norm(), <=, 1e-10 * force.norm());
    const Matrix stress = elementStresses(one.block, materialOf, one.plane, u, initial);
    const double size = one.material.young * expansion * warmer;
    for (const int k : {0, 1, 3}) TEST_COMPARE(std::abs(stress(0, k)), <=, 1e-9 * size);
    TEST_COMPARE(std::abs(stress(0, 2) + (held ? size : 0.0)), <=, 1e-9 * size);
  }
}

TEUCHOS_UNIT_TEST(InitialState, LeavesNoStressWhereAnInitialStrainIsFollowed) {
  for (const Case& one : cases(Load::initialStrain({1e-3, -2e-3, 0.0, 6e-4}))) {
    if (one.block.axisymmetric) continue;
    out << one.name << "\n";
    const auto materialOf = [&](int) -> const Material& { return one.material; };
    const InitialState initial(one.model, 0);
    const Vector u = field(one.block, 1e-3, 2e-4, 4e-4, -2e-3), force = initialForces(one.block, materialOf, one.plane, initial);
    TEST_COMPARE((stiffnessTimes(one, u) - force).norm(), <=, 1e-10 * force.norm());
    const Matrix stress = elementStresses(one.block, materialOf, one.plane, u, initial);
    TEST_COMPARE(stress.norm(), <=, 1e-9 * one.material.young * 1e-3 * (one.material.poisson > 0.4 ? 1e3 : 1.0));
  }
}

TEUCHOS_UNIT_TEST(InitialState, IsTheStressOfABodyThatDoesNotMove) {
  for (const Case& one : cases(Load::initialStress({-3.0, 5.0, 0.0, 2.0}))) {
    out << one.name << "\n";
    const auto materialOf = [&](int) -> const Material& { return one.material; };
    const InitialState initial(one.model, 0);
    const Vector still = Vector::Zero(2 * one.block.nodes());
    const Matrix stress = elementStresses(one.block, materialOf, one.plane, still, initial);
    const double expected[] = {-3.0, 5.0, 0.0, 2.0};
    for (int k = 0; k < 4; ++k) TEST_COMPARE(std::abs(stress(0, k) - expected[k]), <=, 1e-13);
    Vector sizes;
    const Vector force = initialForces(one.block, materialOf, one.plane, initial, &sizes);
    TEST_COMPARE((force.cwiseAbs() - sizes).norm(), <=, 1e-14 * sizes.norm());  // one element
  }
}

TEUCHOS_UNIT_TEST(InitialState, IsNothingWithoutALoad) {
  ElasticModel model;
  model.bodies = {"body"};
  TEST_ASSERT(InitialState(model, 0).empty());
  model.loads = {Load::temperature(1.0, 0.0, "another")};
  TEST_ASSERT(!InitialState(model, 0).isIn(0));
}
