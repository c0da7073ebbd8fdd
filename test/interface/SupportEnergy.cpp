// Energies of bodies on soft elastic supports, against the same bodies without supports.
#include <Teuchos_UnitTestHarness.hpp>
#include <interface/ContactScenes.hpp>

#include <cmath>

namespace suture {
namespace {

using namespace blocks;

constexpr double kNormal = 1.0, kTangential = 0.25;  // Young's modulus is 2e6

/// Two blocks, the lower one fixed, the upper one on springs or free.
Scene scene(bool springs) {
  Box lower{"lower", -1, 1, -1, 0, 4, 2}, upper{"upper", -1, 1, 0, 1, 4, 3};
  lower.blocksX = upper.blocksX = 2;  // seams hold each subdomain
  Scene scene = scenes::fromBoxes({lower, upper});
  scene.fixLower();
  scene.pairUp();
  if (!springs) return scene;
  scene.model.supports = {{{"upper_top"}, kNormal, kTangential}};
  for (const Side& side : scene.mesh.sideGroups.at("upper_top"))
    for (const int node : scene.mesh.nodesOf(side)) {
      scene.constraints.springs.push_back({side.element, node, {0, 1, 0}});
      scene.constraints.springs.push_back({side.element, node, {1, 0, 0}});
    }
  return scene;
}

/// Twice the energies of both bodies, all pairs open, for rigid motions and a deformation of the upper one.
Vector energiesOf(const Scene& scene, double motion, double deformation) {
  const OnInterface one(scene, world());
  std::vector<Vector> values;
  for (const auto& subdomain : one.all.subdomains) {
    values.emplace_back(Vector::Zero(subdomain->dofs()));
    for (int i = 0; i < subdomain->dofs(); ++i) {
      const Point x = subdomain->mesh().point(subdomain->nodeOf(i)), along = subdomain->direction(i);
      const Point moved{motion * (0.7 - 0.3 * x[1]) + deformation * std::sin(3.0 * x[1]),
                        motion * (0.4 + 0.3 * x[0]) + deformation * std::cos(3.0 * x[0]), 0};
      if (subdomain->mesh().body == 1) values.back()(i) = dot(moved, along);
    }
  }
  std::map<int, ContactState> open;
  for (const ContactPair& pair : scene.constraints.pairs) open[pair.id] = PairStatus::Open;
  return one.problem.contact()->energies(one.problem.stateOf(values, open));
}

TEUCHOS_UNIT_TEST(SupportEnergy, IsNotPartOfTheEnergyOfABody) {
  const Vector with = energiesOf(scene(true), 0.0, 1e-4), without = energiesOf(scene(false), 0.0, 1e-4);
  TEST_COMPARE(without(1), >, 0.0);
  TEST_FLOATING_EQUALITY(with(1), without(1), 1e-5);
  TEST_COMPARE(with(0), <=, 1e-14 * without(1));
}

// The springs store a hundred times the energy of the deformation.
TEUCHOS_UNIT_TEST(SupportEnergy, IsNotPartOfTheEnergyOfABodyFarFromItsPlace) {
  const double motion = 10.0;
  const Vector with = energiesOf(scene(true), motion, 1e-4), without = energiesOf(scene(false), 0.0, 1e-4);
  const double springs = kNormal * 2.0 * 0.4 * 0.4 * motion * motion;
  TEST_COMPARE(springs, >, 100.0 * without(1));
  TEST_FLOATING_EQUALITY(with(1), without(1), 1e-2);
}

}  // namespace
}  // namespace suture
