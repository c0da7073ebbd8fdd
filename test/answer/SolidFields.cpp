// 3D fields known in closed form: extremes, controlled loads, points, errors.
#include <Teuchos_UnitTestHarness.hpp>
#include <answer/SolidScenes.hpp>
#include <suture/answer/error/ErrorNorms.hpp>
#include <suture/answer/values/ControlledLoads.hpp>
#include <suture/answer/values/Extremes.hpp>
#include <suture/answer/values/PointSearch.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>

#include <random>

namespace suture {
namespace solidfields {

using solids::operator*;

const Eigen::Matrix3d kFrame = solids::rotation({1, 2, -0.5}, 0.9);
const Point kOrigin{3, -2, 5};
constexpr double kYoung = 10.0, kPoisson = 0.3;

/// A cube in a rotated frame, with the displacement of uniform strains (1e-3, -2e-3, 5e-4) along its axes: its principal stresses by hand.
struct StrainedCube {
  scenes::Scene scene;
  std::vector<SubdomainMesh> meshes;
  std::vector<Vector> displacement;
  Point strain{1e-3, -2e-3, 5e-4}, stress{0, 0, 0};

  explicit StrainedCube(Cell cell)
      : scene(solids::turned(solids::fromBoxes({solids::cube(cell, 4, 2)}, kYoung, kPoisson), kFrame, kOrigin)),
        meshes(solids::distributed(scene)) {
    const double lambda = kYoung * kPoisson / ((1 + kPoisson) * (1 - 2 * kPoisson)), mu = kYoung / (2 * (1 + kPoisson));
    for (std::size_t k = 0; k < 3; ++k) stress[k] = lambda * (strain[0] + strain[1] + strain[2]) + 2 * mu * strain[k];
    displacement = solids::atNodes(meshes, [&](const Point& x) {
      const Point local = kFrame.transpose() * minus(x, kOrigin);
      return kFrame * Point{strain[0] * local[0], strain[1] * local[1], strain[2] * local[2]};
    });
  }
};

TEUCHOS_UNIT_TEST(Extremes, In3DAreThePrincipalStressesInAnyFrame) {
  for (const Cell cell : solids::cells()) {
    const StrainedCube cube(cell);
    const Extremes found = findExtremes(*solids::world(), {cube.meshes, cube.scene.model, cube.displacement, {}, {}});
    const Point& s = cube.stress;
    const double vonMises =
        std::sqrt(0.5 * ((s[0] - s[1]) * (s[0] - s[1]) + (s[1] - s[2]) * (s[1] - s[2]) + (s[2] - s[0]) * (s[2] - s[0])));
    TEST_FLOATING_EQUALITY(found.tension.value, s[0], 1e-10);
    TEST_FLOATING_EQUALITY(found.compression.value, s[1], 1e-10);
    TEST_FLOATING_EQUALITY(found.vonMises.value, vonMises, 1e-10);
    TEST_FLOATING_EQUALITY(found.displacement.value, norm(cube.strain), 1e-12);  // displacement of the corner (1, 1, 1)
    TEST_COMPARE(norm(minus(found.displacement.place, plus(kFrame * Point{1, 1, 1}, kOrigin))), <, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(Extremes, OfUniaxialStressIn3DHaveNoTension) {
  StrainedCube cube(Cell::Hexahedron8);
  cube.displacement = solids::atNodes(cube.meshes, [&](const Point& x) {
    const Point local = kFrame.transpose() * minus(x, kOrigin);
    return kFrame * Point{kPoisson * local[0], kPoisson * local[1], -local[2]};
  });
  const Extremes found = findExtremes(*solids::world(), {cube.meshes, cube.scene.model, cube.displacement, {}, {}});
  TEST_FLOATING_EQUALITY(found.compression.value, -kYoung, 1e-12);
  TEST_FLOATING_EQUALITY(found.vonMises.value, kYoung, 1e-12);
  TEST_ASSERT(!found.tension.exists());
  TEST_EQUALITY(found.tension.value, 0.0);
}

TEUCHOS_UNIT_TEST(ControlledLoads, In3DMeasureMeansOfFacesAndSections) {
  for (const Cell cell : solids::cells()) {
    const StrainedCube cube(cell);
    Load mean;
    mean.kind = Load::Kind::Force;
    mean.control = Load::Control::MeanDisplacement;
    mean.groups = {"body_top"};
    mean.axis = kFrame * Point{0, 0.6, 0.8};
    // Over the face z = 1 of the cube: the mean of y is a half.
    TEST_FLOATING_EQUALITY(controlledValue(*solids::world(), cube.meshes, cube.scene.model, cube.displacement, mean),
                           0.6 * cube.strain[1] / 2 + 0.8 * cube.strain[2], 1e-11);
    // For a cube as large as the scene along its longest axis: E times that length.
    const double extent = (kFrame.cwiseAbs() * Eigen::Vector3d::Ones()).maxCoeff();
    TEST_FLOATING_EQUALITY(1.0 / controlledSlope(*solids::world(), cube.meshes, cube.scene.model, mean), kYoung * extent, 1e-12);
    Load section;
    section.kind = Load::Kind::InitialStrain;
    section.control = Load::Control::SectionForce;
    section.body = "body";
    section.axis = kFrame * Point{0, 1, 0};
    section.length = 1.0;
    TEST_FLOATING_EQUALITY(controlledValue(*solids::world(), cube.meshes, cube.scene.model, cube.displacement, section), cube.stress[1],
                           1e-11);
  }
}

TEUCHOS_UNIT_TEST(PointSearch, In3DFindsEachPointOnOneRank) {
  std::mt19937 random(4);
  const auto uniform = [&] { return random() / 4294967296.0; };
  for (const Cell cell : solids::cells()) {
    const StrainedCube cube(cell);
    std::vector<SoughtPoint> points;
    for (int k = 0; k < 100; ++k) points.push_back({plus(kFrame * Point{uniform(), uniform(), uniform()}, kOrigin), k % 2 - 1});
    for (const Point& node : {Point{0, 0, 0}, Point{0.5, 0.5, 0.5}, Point{0.25, 1, 0.5}})
      points.push_back({plus(kFrame * node, kOrigin), -1});
    const FoundPoints found = findPoints(*solids::world(), cube.meshes, {"body"}, points);
    TEST_ASSERT(found.outside.empty());
    std::vector<int> here;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (found.here[k].mesh < 0) continue;
      here.push_back(int(k));
      const SubdomainMesh& mesh = cube.meshes[found.here[k].mesh];
      Point place{0, 0, 0}, u{0, 0, 0};
      const Span<const int> nodes = mesh.nodesOf(found.here[k].element);
      ShapeJet jets[kMostCellNodes];
      shapeJets(mesh.cells[found.here[k].element], found.here[k].at, jets);
      for (std::size_t a = 0; a < nodes.size(); ++a) {
        const double weight = jets[a].value;
        place = plus(place, scaled(weight, mesh.point(nodes[a])));
        for (int c = 0; c < 3; ++c) u[c] += weight * cube.displacement[found.here[k].mesh][3 * nodes[a] + c];
      }
      TEST_COMPARE(norm(minus(place, points[k].place)), <, 1e-11);
      const Point local = kFrame.transpose() * minus(points[k].place, kOrigin);
      TEST_COMPARE(norm(minus(u, kFrame * Point{cube.strain[0] * local[0], cube.strain[1] * local[1], cube.strain[2] * local[2]})), <,
                   1e-13);
    }
    int count = int(here.size()), all = 0;
    Teuchos::reduceAll(*solids::world(), Teuchos::REDUCE_SUM, count, Teuchos::outArg(all));
    TEST_EQUALITY(all, int(points.size()));
  }
}

TEUCHOS_UNIT_TEST(PointSearch, In3DNamesTheNearestBodyAndItsDistance) {
  const StrainedCube cube(Cell::Tetrahedron4);
  const FoundPoints found =
      findPoints(*solids::world(), cube.meshes, {"body"}, {{kOrigin, -1}, {plus(kFrame * Point{0.3, 0.4, 3}, kOrigin), -1}});
  TEST_EQUALITY(found.outside.size(), 1u);
  TEST_EQUALITY(found.outside.at(0), 1);
  const std::string foot = placeText(plus(kFrame * Point{0.3, 0.4, 1}, kOrigin), 3);
  TEST_EQUALITY(found.nearest.at(0), "'body' is nearest, 2 away at " + foot);
}

TEUCHOS_UNIT_TEST(SolidErrors, In3DOfAZeroFieldAreThoseOfTheExactOne) {
  // u = (x y, y z^2, 2): integrals over the unit cube 1/9 + 1/15 + 4; s = (x, 0, 0, 0, y, 0): by Hooke's law x^2 / E + y^2 / mu.
  ExactFields exact;
  exact.displacement = {Expression("x*y"), Expression([](const Point& x) { return x[1] * x[2] * x[2]; }), Expression("2")};
  for (const char* component : {"x", "0", "0", "0", "y", "0"}) exact.stress.emplace_back(component);
  const Material material{"m", kYoung, kPoisson};
  for (const Cell cell : solids::cells()) {
    const Mesh mesh = boxes({solids::cube(cell, 2)});
    const BodyErrors errors = bodyErrors(
        mesh, exact, [&](int) -> const Material& { return material; }, PlaneModel::Strain, Vector::Zero(3 * mesh.nodes()));
    TEST_FLOATING_EQUALITY(errors.displacement.error, 1.0 / 9 + 1.0 / 15 + 4, 1e-12);
    TEST_FLOATING_EQUALITY(errors.displacement.exact, errors.displacement.error, 1e-13);
    TEST_FLOATING_EQUALITY(errors.energy.error, (1.0 / kYoung + 2 * (1 + kPoisson) / kYoung) / 3, 1e-12);
    TEST_FLOATING_EQUALITY(errors.energy.exact, errors.energy.error, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(SolidErrors, In3DVanishForTheFieldItself) {
  for (const Cell cell : solids::cells()) {
    Mesh mesh = boxes({solids::cube(cell, 3)});
    solids::distort(mesh, 0.03, true);
    const double lambda = kYoung * kPoisson / ((1 + kPoisson) * (1 - 2 * kPoisson)), mu = kYoung / (2 * (1 + kPoisson));
    ExactFields exact;
    exact.displacement = {Expression("0.1*x + 0.2*y"), Expression([](const Point& x) { return 0.3 * x[2]; }),
                          Expression([](const Point& x) { return 0.1 * x[0] - 0.2 * x[2]; })};
    const double trace = 0.1 - 0.2;
    const double s[6] = {lambda * trace + 2 * mu * 0.1, lambda * trace, lambda * trace - 2 * mu * 0.2, mu * 0.2, mu * 0.3, mu * 0.1};
    for (const double value : s) exact.stress.emplace_back("s", Constants{{"s", value}});
    const Material material{"m", kYoung, kPoisson};
    const Vector u = solids::atNodes(mesh, [](const Point& x) {
      return Point{0.1 * x[0] + 0.2 * x[1], 0.3 * x[2], 0.1 * x[0] - 0.2 * x[2]};
    });
    const BodyErrors errors = bodyErrors(
        mesh, exact, [&](int) -> const Material& { return material; }, PlaneModel::Strain, u);
    TEST_COMPARE(errors.displacement.error, <, 1e-28);
    TEST_COMPARE(errors.energy.error, <, 1e-25);
    TEST_COMPARE(errors.energy.exact, >, 0.1);
  }
}

}  // namespace solidfields
}  // namespace suture
