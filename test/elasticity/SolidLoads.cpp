// 3D loads on sides, volumes and mass, elastic supports and initial states: against closed forms, resultants and each other.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/elasticity/loads/ElasticSupports.hpp>
#include <suture/elasticity/loads/NodalLoads.hpp>
#include <suture/elasticity/loads/ResolveLoads.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/mesh/ShapeFunctions.hpp>

#include <cmath>
#include <map>

#include "SampleCells.hpp"

using namespace suture;

namespace solidloads {

Eigen::Vector3d vectorOf(const Point& p) { return {p[0], p[1], p[2]}; }

// Force, and moment about a point.
struct Resultant {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
};

Resultant resultant(const CellBlock& block, const Vector& forces, const Eigen::Vector3d& about = Eigen::Vector3d::Zero()) {
  Resultant sum;
  for (int i = 0; i < block.nodes(); ++i) {
    sum.force += forces.segment<3>(3 * i);
    sum.moment += (vectorOf(block.point(i)) - about).cross(Eigen::Vector3d(forces.segment<3>(3 * i)));
  }
  return sum;
}

Vector sideForces(const CellBlock& block, const std::vector<Side>& sides, const Load& load) {
  Vector forces = Vector::Zero(3 * block.nodes());
  addSideLoad(block, sides, load, forces);
  return forces;
}

Vector bodyForces(const CellBlock& block, const Load& load) {
  std::vector<int> elements;
  for (int e = 0; e < block.elements(); ++e) elements.push_back(e);
  Vector forces = Vector::Zero(3 * block.nodes());
  addBodyForce(block, elements, load, forces, [](int) { return 7.0; });
  return forces;
}

// A function of x, y and z.
Expression function(const std::string& text) {
  Constants constants;
  constants.dimension = 3;
  return Expression(text, constants);
}

Load pressure(double value) { return Load::pressure("", value); }

Mesh bar(Cell cell) {  // [0, 4] x [0, 1] x [0, 2]
  Box box{"bar", 0, 4, 0, 1};
  box.z1 = 2;
  box.nx = 3;
  box.ny = box.nz = 2;
  box.cell = cell;
  Mesh mesh = boxes({box});
  assignBodies(mesh, {"bar"});
  return mesh;
}

ElasticModel modelOf(std::vector<Load> loads) {
  ElasticModel model;
  model.dimension = 3;
  model.bodies = {"bar"};
  Material material{"steel", 2e5, 0.3};
  material.density = 7.0;
  model.materialOfBody = {material};
  model.loads = std::move(loads);
  return model;
}

Resultant resolved(const Mesh& mesh, const Load& load, const Eigen::Vector3d& about = Eigen::Vector3d::Zero()) {
  ElasticModel model = modelOf({load});
  resolveLoads(mesh, model);
  return resultant(mesh, nodalLoads(mesh, model), about);
}

void turn(CellBlock& block, const Eigen::Matrix3d& by) {
  for (int i = 0; i < block.nodes(); ++i) {
    Eigen::Map<Eigen::Vector3d> place(block.coordinates.data() + 3 * i);
    place = (by * place).eval();
  }
}

Eigen::Matrix3d rotation() { return Eigen::AngleAxisd(1.1, Eigen::Vector3d(2, 1, -1).normalized()).toRotationMatrix(); }

TEUCHOS_UNIT_TEST(SolidLoads, PressureAroundAClosedBodyBalances) {
  for (const Cell cell : sample::solids())
    for (const CellBlock& block : {sample::distortedSolid(cell), sample::curvedSolid(cell)}) {
      const Vector forces = sideForces(block, sample::sidesOfElement(block), pressure(3.0));
      TEST_COMPARE(forces.norm(), >, 1.0);
      TEST_COMPARE(resultant(block, forces).force.norm(), <, 1e-13 * forces.norm());
      TEST_COMPARE(resultant(block, forces).moment.norm(), <, 1e-13 * forces.norm());
    }
}

TEUCHOS_UNIT_TEST(SolidLoads, PressureThatGrowsWithDepthLiftsByTheVolume) {  // Archimedes
  Load depth = pressure(0.0);
  depth.expressions = {function("5 - 2*z")};
  for (const Cell cell : sample::solids())
    for (const CellBlock& block : {sample::distortedSolid(cell), sample::curvedSolid(cell)}) {
      const Vector lift = sideForces(block, sample::sidesOfElement(block), depth);
      const Vector weight = bodyForces(block, Load::bodyForce({0, 0, -2}));
      const Resultant sum = resultant(block, lift + weight);
      TEST_COMPARE(sum.force.norm(), <, 1e-12 * weight.norm());
      TEST_COMPARE(sum.moment.norm(), <, 1e-12 * weight.norm());
    }
}

TEUCHOS_UNIT_TEST(SolidLoads, WeighAnElementByItsVolume) {
  const auto weightOf = [](const CellBlock& block) { return -resultant(block, bodyForces(block, Load::bodyForce({0, 0, -1}))).force[2]; };
  // Integrals of the determinants of the maps, by hand.
  for (const Cell cell : {Cell::Hexahedron8, Cell::Hexahedron20, Cell::Hexahedron27})
    TEST_FLOATING_EQUALITY(
        weightOf(sample::mapped(cell,
                                [](const Point& p) -> Point {
                                  return {2 * p[0] + 0.3 * p[1] * p[2], 1.5 * p[1] + 0.2 * p[0] * p[2], p[2] + 0.1 * p[0] * p[1]};
                                })),
        24.0 - 0.145 * 8.0 / 3.0, 1e-13);
  TEST_FLOATING_EQUALITY(weightOf(sample::mapped(Cell::Tetrahedron10,
                                                 [](const Point& p) -> Point {
                                                   return {p[0] + 0.2 * p[1] * p[1], p[1] + 0.1 * p[0] * p[2], p[2]};
                                                 })),
                         1.0 / 6 - 0.04 / 120, 1e-13);
  TEST_FLOATING_EQUALITY(weightOf(sample::mapped(Cell::Wedge6,
                                                 [](const Point& p) -> Point {
                                                   return {p[0] + 0.2 * p[1] * p[2], p[1] + 0.1 * p[0] * p[2], p[2] + 0.1 * p[0]};
                                                 })),
                         1.0 - 0.04 / 3, 1e-13);
  TEST_FLOATING_EQUALITY(weightOf(sample::brick(Cell::Pyramid5, 3, 2, 4)), 8.0, 1e-13);
  TEST_FLOATING_EQUALITY(weightOf(sample::brick(Cell::Tetrahedron4, 3, 2, 4)), 4.0, 1e-13);
}

TEUCHOS_UNIT_TEST(SolidLoads, SpreadBodyForceByTheIntegralsOfShapeFunctions) {
  // Fractions of the volume of an affine cell: of vertices, middles of edges, centres of sides, the centre.
  const std::map<Cell, std::vector<double>> shares{{Cell::Tetrahedron4, {0.25}},
                                                   {Cell::Tetrahedron10, {-0.05, 0.2}},
                                                   {Cell::Hexahedron8, {0.125}},
                                                   {Cell::Hexahedron20, {-0.125, 1.0 / 6}},
                                                   {Cell::Hexahedron27, {1.0 / 216, 1.0 / 54, 2.0 / 27, 8.0 / 27}},
                                                   {Cell::Wedge6, {1.0 / 6}}};
  for (const auto& [cell, share] : shares) {
    const CellBlock block = sample::brick(cell, 3, 2, 4);
    const double volume = isSimplex(cell) ? 4.0 : cell == Cell::Wedge6 ? 12.0 : 24.0;
    const Vector forces = bodyForces(block, Load::bodyForce({1.5, 0, -9.81}));
    const CellInfo& info = cellInfo(cell);
    for (int i = 0; i < block.nodes(); ++i) {
      const int middles = info.vertices + static_cast<int>(info.edges.size());
      const double own = share[i < info.vertices ? 0 : i < middles ? 1 : i < 26 ? 2 : 3];
      TEST_COMPARE((forces.segment<3>(3 * i) - volume * own * Eigen::Vector3d(1.5, 0, -9.81)).norm(), <, 1e-12);
    }
  }
  const CellBlock block = sample::brick(Cell::Pyramid5, 3, 2, 4);
  const Vector forces = bodyForces(block, Load::bodyForce({1, 0, 0}));
  for (int i = 0; i < 5; ++i) TEST_FLOATING_EQUALITY(forces[3 * i], 8.0 * (i < 4 ? 3.0 / 16 : 0.25), 1e-13);
}

TEUCHOS_UNIT_TEST(SolidLoads, SpreadTractionOverAFlatSide) {
  const std::map<int, std::vector<double>> shares{
      {3, {1.0 / 3}}, {4, {0.25}}, {6, {0, 1.0 / 3}}, {8, {-1.0 / 12, 1.0 / 3}}, {9, {1.0 / 36, 1.0 / 9, 4.0 / 9}}};
  for (const Cell cell : sample::solids()) {
    const CellBlock block = sample::brick(cell, 3, 2, 4);
    for (const Side& side : sample::sidesOfElement(block)) {
      const std::vector<int> nodes = block.nodesOf(side);
      if (std::any_of(nodes.begin(), nodes.end(), [&](int node) { return block.point(node)[2] != 0.0; })) continue;  // z = 0 alone
      const bool triangle = nodes.size() == 3 || nodes.size() == 6;
      const double area = triangle ? 3.0 : 6.0;
      const Vector forces = sideForces(block, {side}, Load::traction("", {2, -5, 1})), pushed = sideForces(block, {side}, pressure(2.0));
      const std::vector<double>& share = shares.at(static_cast<int>(nodes.size()));
      const std::size_t vertices = triangle ? 3 : 4;
      for (std::size_t a = 0; a < nodes.size(); ++a) {
        const double own = area * share[a < vertices ? 0 : a < 2 * vertices ? 1 : 2];
        TEST_COMPARE((forces.segment<3>(3 * nodes[a]) - own * Eigen::Vector3d(2, -5, 1)).norm(), <, 1e-13);
        TEST_COMPARE((pushed.segment<3>(3 * nodes[a]) - own * Eigen::Vector3d(0, 0, 2)).norm(), <, 1e-13);  // upwards, from below
      }
      TEST_COMPARE(std::abs(forces.norm() -
                            [&] {
                              Vector own = Vector::Zero(forces.size());
                              for (const int node : nodes) own.segment<3>(3 * node) = forces.segment<3>(3 * node);
                              return own.norm();
                            }()),
                   <, 1e-14);  // on no other node
    }
  }
}

TEUCHOS_UNIT_TEST(SolidLoads, ThatDependOnThePlaceAreIntegratedAgainstTheShapeFunctions) {
  for (const Cell cell : sample::solids()) {
    const Mesh mesh = bar(cell);
    Load force;
    force.kind = Load::Kind::BodyForce;
    force.expressions = {function("x*y*z"), function("x^2"), function("z")};
    const Resultant b = resultant(mesh, bodyForces(mesh, force));  // over [0, 4] x [0, 1] x [0, 2]
    TEST_FLOATING_EQUALITY(b.force[0], 8.0 * 0.5 * 2.0, 1e-12);
    TEST_FLOATING_EQUALITY(b.force[1], 64.0 / 3 * 2, 1e-12);
    TEST_FLOATING_EQUALITY(b.force[2], 4.0 * 2.0, 1e-12);
    TEST_FLOATING_EQUALITY(b.moment[2], 64.0 * 2 - 8.0 / 3 * 2.0, 1e-12);  // x b_y - y b_x
    Load traction;
    traction.expressions = {function("y*z"), function("x*z"), function("y^2")};
    const Resultant t = resultant(mesh, sideForces(mesh, mesh.sideGroups.at("bar_right"), traction));  // x = 4
    TEST_FLOATING_EQUALITY(t.force[0], 0.5 * 2, 1e-12);
    TEST_FLOATING_EQUALITY(t.force[1], 4.0 * 2, 1e-12);
    TEST_FLOATING_EQUALITY(t.force[2], 2.0 / 3, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(SolidLoads, PullATurningBodyAwayFromItsAxis) {
  const Eigen::Vector3d velocity(1.0, 2.0, -2.0), about(0.5, -3.0, 1.0), centre(2.0, 0.5, 1.0);
  const double mass = 7.0 * 8.0;
  const Eigen::Vector3d arm = centre - about, axis = velocity.normalized(), outwards = arm - axis.dot(arm) * axis;
  for (const Cell cell : sample::solids()) {
    const Mesh mesh = bar(cell);
    const Resultant found = resolved(mesh, Load::rotation({1.0, 2.0, -2.0}, {0.5, -3.0, 1.0}));
    TEST_COMPARE((found.force - mass * 9.0 * outwards).norm(), <, 1e-11 * mass);
    const Resultant fallen = resolved(mesh, Load::gravity({0, 3.0, -9.81}), centre);
    TEST_COMPARE((fallen.force - mass * Eigen::Vector3d(0, 3.0, -9.81)).norm(), <, 1e-11 * mass);
    TEST_COMPARE(fallen.moment.norm(), <, 1e-11 * mass);
  }
}

TEUCHOS_UNIT_TEST(SolidLoads, GiveTotalForcesAndMomentsToTheirGroups) {
  const Eigen::Vector3d far(-70.0, 11.0, 5.0), force(3.0, -8.0, 2.0), moment(6.0, -1.0, 4.0);
  for (const Cell cell : sample::solids()) {
    const Mesh mesh = bar(cell);
    const Resultant pulled = resolved(mesh, Load::force("bar_right", {3.0, -8.0, 2.0}), {4.0, 0.5, 1.0});
    TEST_COMPARE((pulled.force - force).norm(), <, 1e-12);
    TEST_COMPARE(pulled.moment.norm(), <, 1e-12);  // at the centroid
    Load both = Load::moment("bar_right", Point{6.0, -1.0, 4.0});
    both.groups.push_back("bar_top");  // an angle at which no principal axis of inertia is a scene axis
    const Resultant twisted = resolved(mesh, both, far);
    TEST_COMPARE(twisted.force.norm(), <, 1e-12);
    TEST_COMPARE((twisted.moment - moment).norm(), <, 1e-11);
  }
}

TEUCHOS_UNIT_TEST(SolidLoads, MakeTheLinearStressOfBendingAndTwistAMoment) {
  const Mesh mesh = bar(Cell::Hexahedron20);
  ElasticModel model = modelOf({Load::moment("bar_right", Point{3.0, 6.0, 0.0})});
  resolveLoads(mesh, model);
  // The side is 1 x 2: about y (bending) I = 1 * 2^3 / 12, sigma = M (z - 1) / I; about x (twist) t = M / I_p r, I_p = (1 + 4) * 2 / 12.
  for (const double z : {0.0, 0.7, 2.0})
    for (const double y : {0.0, 0.2, 1.0}) {
      const Point traction = model.loads[0].at({4.0, y, z});
      TEST_COMPARE(std::abs(traction[0] - 6.0 * (z - 1.0) * 12.0 / 8.0), <, 1e-12);
      TEST_COMPARE(std::abs(traction[1] + 3.0 * (z - 1.0) * 1.2), <, 1e-12);
      TEST_COMPARE(std::abs(traction[2] - 3.0 * (y - 0.5) * 1.2), <, 1e-12);
    }
}

TEUCHOS_UNIT_TEST(SolidLoads, PutAPointForceOnItsNode) {
  const Mesh mesh = bar(Cell::Tetrahedron10);
  const Resultant found = resolved(mesh, Load::pointForce({4.0, 1.0, 2.0}, {1.0, -2.0, 3.0}));
  TEST_COMPARE((found.force - Eigen::Vector3d(1, -2, 3)).norm(), <, 1e-15);
  TEST_COMPARE((found.moment - Eigen::Vector3d(4, 1, 2).cross(Eigen::Vector3d(1, -2, 3))).norm(), <, 1e-14);
  ElasticModel model = modelOf({Load::pointForce({4.1, 1.0, 2.0}, {1, 0, 0})});
  try {
    resolveLoads(mesh, model);
    TEST_ASSERT(false);
  } catch (const InputError& error) {
    TEST_ASSERT(std::string(error.what()).find("the nearest one is (4, 1, 2) of the body 'bar', 0.1 away") != std::string::npos);
  }
}

TEUCHOS_UNIT_TEST(SolidLoads, ElasticSupportsAnswerTranslationsByTheirNormalAndTangentialStiffness) {
  const double normal = 50.0, tangential = 3.0;
  const Eigen::Matrix3d by = rotation();
  const Eigen::Vector3d moved(0.2, -0.1, 0.3), n = by.col(2);  // normal of the bottom, an area of 4
  const Eigen::Vector3d expected = 4.0 * (normal * n.dot(moved) * n + tangential * (moved - n.dot(moved) * n));
  for (const Cell cell : sample::solids()) {
    Mesh mesh = bar(cell);
    turn(mesh, by);
    ElasticModel model = modelOf({});
    model.supports = {{{"bar_bottom"}, normal, tangential}};
    Vector u(3 * mesh.nodes());
    for (int i = 0; i < mesh.nodes(); ++i) u.segment<3>(3 * i) = moved;
    const ElasticSupports supports(mesh, mesh.sideGroups, model);
    const ElasticSupports::Forces forces = supports.forces(u);
    TEST_COMPARE((resultant(mesh, forces.nodal).force - expected).norm(), <, 1e-12 * expected.norm());
    TEST_COMPARE(forces.rounding.minCoeff(), >=, 0.0);
    supports.forEachSupport(u, [&](int, const Vector& own) { TEST_COMPARE((own + forces.nodal).norm(), <=, 1e-14 * own.norm()); });
    // The stiffness added to the elements agrees.
    const Material& material = model.materialOfBody[0];
    const auto materialOf = [&](int) -> const Material& { return material; };
    Vector sum = Vector::Zero(u.size());
    supportedStiffnesses(mesh, mesh.sideGroups, materialOf, model, [&](int e, ConstLocalView k) {
      const Span<const int> nodes = mesh.nodesOf(e);
      for (std::size_t a = 0; a < nodes.size(); ++a)
        for (std::size_t b = 0; b < nodes.size(); ++b)
          sum.segment<3>(3 * nodes[a]) += k.block<3, 3>(3 * a, 3 * b) * u.segment<3>(3 * nodes[b]);
    });
    TEST_COMPARE((sum - forces.nodal).norm(), <, 1e-12 * material.young);  // elements do not resist a translation
  }
}

namespace {

struct Case {
  CellBlock block;
  Material material;
};

// Every cell, straight and curved, each element form.
std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Cell cell : sample::solids())
    for (const CellBlock& block : {sample::distortedSolid(cell), sample::curvedSolid(cell)})
      for (const std::string form : {"displacement", "mixed", "enhanced", "enhanced nearly incompressible"}) {
        const bool mixed = form == "mixed", enhanced = form.find("enhanced") == 0;
        if ((mixed && cell == Cell::Tetrahedron4) || (enhanced && !mayBeEnhanced(cell))) continue;
        Case one{block, {"steel", 2e5, mixed || form == "enhanced nearly incompressible" ? 0.4999 : 0.3}};
        one.material.enhanced = enhanced;
        one.material.expansion = 1e-3;
        if (mixed) one.material.element = ElementForm::Mixed;
        all.push_back(one);
      }
  return all;
}

// Stresses and unbalanced forces of u = gradient x under an initial state.
void stateOf(const Case& one, const Load& load, const Eigen::Matrix3d& gradient, Vector& stress, double& unbalanced) {
  ElasticModel model;
  model.dimension = 3;
  model.bodies = {"body"};
  model.loads = {load};
  const InitialState initial(model, 0);
  const auto materialOf = [&](int) -> const Material& { return one.material; };
  Vector u(3 * one.block.nodes());
  for (int i = 0; i < one.block.nodes(); ++i) u.segment<3>(3 * i) = gradient * vectorOf(one.block.point(i));
  stress = elementStresses(one.block, materialOf, PlaneModel::Strain, u, initial).row(0).transpose();
  const Vector force = initialForces(one.block, materialOf, PlaneModel::Strain, initial);
  elementStiffnesses(one.block, one.material, PlaneModel::Strain,
                     [&](int, ConstLocalView k) { unbalanced = (k * u - force).norm() / std::max(1.0, force.norm()); });
}

}  // namespace

TEUCHOS_UNIT_TEST(SolidLoads, InitialStatesThatAreFollowedLeaveNoStress) {
  Eigen::Matrix3d strain;
  strain << 1e-3, 3e-4, -2e-4, 3e-4, -2e-3, 4e-4, -2e-4, 4e-4, 5e-4;
  const Load given = Load::initialStrain({1e-3, -2e-3, 5e-4, 6e-4, 8e-4, -4e-4});
  for (const Case& one : cases()) {
    Vector stress;
    double unbalanced = 1.0;
    stateOf(one, Load::temperature(100.0, 20.0), 0.08 * Eigen::Matrix3d::Identity(), stress, unbalanced);
    TEST_COMPARE(unbalanced, <, 1e-10);
    TEST_COMPARE(stress.norm(), <, 1e-8 * one.material.young);
    stateOf(one, given, strain, stress, unbalanced);
    TEST_COMPARE(unbalanced, <, 1e-10);
    TEST_COMPARE(stress.norm(), <, 1e-9 * one.material.young);
  }
}

TEUCHOS_UNIT_TEST(SolidLoads, InitialStressIsThatOfABodyThatDoesNotMove) {
  for (const Case& one : cases()) {
    Vector stress;
    double unbalanced = 0.0;
    stateOf(one, Load::initialStress({-3.0, 5.0, 1.0, 2.0, -1.0, 4.0}), Eigen::Matrix3d::Zero(), stress, unbalanced);
    Vector expected(6);
    expected << -3.0, 5.0, 1.0, 2.0, -1.0, 4.0;
    TEST_COMPARE((stress - expected).norm(), <, 1e-13);
    // Nodal forces: the tractions of the stress on the sides, with opposite sign.
    Vector flux = Vector::Zero(3 * one.block.nodes());
    for (const Side& side : sample::sidesOfElement(one.block)) addSideFlux(one.block, side, 1.0, flux);
    Eigen::Matrix3d s;
    s << -3.0, 2.0, 4.0, 2.0, 5.0, -1.0, 4.0, -1.0, 1.0;
    ElasticModel model;
    model.dimension = 3;
    model.bodies = {"body"};
    model.loads = {Load::initialStress({-3.0, 5.0, 1.0, 2.0, -1.0, 4.0})};
    const Vector force = initialForces(
        one.block, [&](int) -> const Material& { return one.material; }, PlaneModel::Strain, InitialState(model, 0));
    for (int a = 0; a < one.block.nodes(); ++a) TEST_COMPARE((force.segment<3>(3 * a) + s * flux.segment<3>(3 * a)).norm(), <, 1e-12);
  }
}

}  // namespace solidloads
