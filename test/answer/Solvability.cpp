#include <Teuchos_UnitTestHarness.hpp>
#include <suture/algebra/dense/NonnegativeLeastSquares.hpp>
#include <suture/answer/solvability/Solvability.hpp>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/loads/NodalLoads.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/monolithic/MonolithicSystem.hpp>
#include <suture/pairs/FrictionLaws.hpp>

#include <support/DryLaw.hpp>
#include <support/SmallScenes.hpp>

#include <cmath>
#include <functional>
#include <memory>
#include <random>

namespace suture {
namespace {

using scenes::dry;
using scenes::Scene;
using LawPtr = std::shared_ptr<const ContactLaw>;

// Message of the check, or "" if the scene passes.
std::string verdict(const Scene& scene) {
  try {
    checkSolvability(scene.mesh, scene.constraints, scene.model);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEUCHOS_UNIT_TEST(Solvability, FindsTheMotionsThatPrescribedComponentsLeave) {
  Scene scene = scenes::twoBlocks(4, 2, 2);
  const auto freeOf = [&](int part) { return freeRigidMotions(scene.mesh, scene.constraints).parts[part].free; };
  TEST_EQUALITY(freeOf(0).cols(), 3);
  scene.hold("upper_left", 0, 0.0);  // a vertical side held in x: only the vertical translation remains
  const Matrix left = freeOf(1);
  TEST_EQUALITY(left.cols(), 1);
  TEST_COMPARE(std::abs(std::abs(left(1, 0)) - 1), <, 1e-14);
  scene.hold("lower_bottom", 0, 0.0);
  scene.hold("lower_bottom", 1, 0.0);
  TEST_EQUALITY(freeOf(0).cols(), 0);
}

TEUCHOS_UNIT_TEST(Solvability, DescribesTheMotionsOfTwentyBodiesAndNamesTheOthers) {
  std::vector<Box> many(25);
  for (std::size_t i = 0; i < many.size(); ++i) {
    many[i].name = "b" + std::to_string(i);
    many[i].x0 = 2.0 * static_cast<double>(i);
    many[i].x1 = many[i].x0 + 1.0;
  }
  const std::string text = verdict(scenes::fromBoxes(many, 1.0, 0.3));
  out << text << "\n";
  TEST_ASSERT(says(text, "body 'b19' is not held"));
  TEST_ASSERT(!says(text, "body 'b20'"));
  TEST_ASSERT(says(text, "5 more bodies are not held: b20, b21, b22, b23, b24"));
}

TEUCHOS_UNIT_TEST(Solvability, PartsOfABodyThatDoNotTouchAreLooseOneByOne) {
  Scene scene = scenes::twoBlocks(2, 2, 2);
  scene.mesh.bodyOfElement.assign(scene.mesh.elements(), 0);  // two separate parts, one body
  scene.mesh.bodyOfNode.assign(scene.mesh.nodes(), 0);
  const RigidParts rigid = freeRigidMotions(scene.mesh, scene.constraints);
  TEST_EQUALITY(rigid.parts.size(), 2u);
  TEST_EQUALITY(rigid.parts[0].free.cols() + rigid.parts[1].free.cols(), 6);
}

TEUCHOS_UNIT_TEST(Solvability, PartsAreTheBodiesWhereThoseAreConnected) {
  Scene scene = scenes::twoBlocks(4, 2, 2);
  scene.hold("upper_left", 0, 0.0);
  const RigidParts found = freeRigidMotions(scene.mesh, scene.constraints), known = freeRigidMotions(scene.mesh, scene.constraints, true);
  TEST_ASSERT(found.partOfNode == known.partOfNode);
  TEST_EQUALITY(known.parts.size(), 2u);
  for (std::size_t part = 0; part < known.parts.size(); ++part) {
    TEST_EQUALITY(known.parts[part].body, found.parts[part].body);
    TEST_ASSERT(known.parts[part].centre == found.parts[part].centre);
    TEST_EQUALITY(known.parts[part].radius, found.parts[part].radius);
    TEST_ASSERT(known.parts[part].free == found.parts[part].free);
  }
}

TEUCHOS_UNIT_TEST(Solvability, LetsAPressedBlockWithAGuidePass) {
  Scene scene = scenes::twoBlocks(4, 2, 2);
  scene.fixLower();
  scene.hold("upper_left", 0, 0.0);
  scene.pressure("upper_top", 3.0);
  TEST_EQUALITY(verdict(scene), "");
}

TEUCHOS_UNIT_TEST(Solvability, ABodyPulledOffItsSeatMovesUpwards) {
  Scene scene = scenes::twoBlocks(4, 2, 2);
  scene.fixLower();
  scene.hold("upper_left", 0, 0.0);
  scene.pressure("upper_top", -3.0);
  const std::string text = verdict(scene);
  TEST_ASSERT(says(text, "Bodies/upper"));
  TEST_ASSERT(says(text, "body 'upper' can move upwards (0, 1): the loads push it there"));
  TEST_ASSERT(!says(text, "lower"));
}

TEUCHOS_UNIT_TEST(Solvability, ABodyPushedSidewaysMovesToTheRight) {
  Scene scene = scenes::twoBlocks(4, 2, 2);
  scene.fixLower();
  scene.pressure("upper_top", 3.0);
  scene.pressure("upper_left", 1e-3);  // presses to the right; nothing holds it in that direction
  TEST_ASSERT(says(verdict(scene), "body 'upper' can"));
  TEST_ASSERT(says(verdict(scene), "the loads push it there"));
}

TEUCHOS_UNIT_TEST(Solvability, ABlockThatOnlyRestsMaySlide) {
  Scene scene = scenes::twoBlocks(4, 2, 2);
  scene.fixLower();
  scene.pressure("upper_top", 3.0);
  const std::string text = verdict(scene);
  TEST_ASSERT(says(text, "body 'upper' can move to the "));
  TEST_ASSERT(says(text, "its place is not determined"));
}

TEUCHOS_UNIT_TEST(Solvability, ABodyLoadedBesideItsSeatTurnsOver) {
  // the seat is the left half of the bottom; the load is to its right
  Scene scene = scenes::overhang();
  scene.traction("upper_right", {0, -1, 0});
  const std::string text = verdict(scene);
  TEST_ASSERT(says(text, "body 'upper' can turn about ("));
  TEST_ASSERT(says(text, ", clockwise"));
  Scene safe = scenes::overhang();
  safe.traction("upper_left", {0, -1, 0});
  TEST_ASSERT(!says(verdict(safe), "the loads push it there"));
}

TEUCHOS_UNIT_TEST(Solvability, NamesABodyThatNothingHolds) {
  Scene scene = scenes::twoBlocks(4, 2, 2);
  scene.fixLower();
  scene.constraints.pairs.clear();
  TEST_ASSERT(says(verdict(scene), "body 'upper' is not held: it has no prescribed displacement, no Elastic Support and no contact"));
}

TEUCHOS_UNIT_TEST(Solvability, RestWithoutLoadIsLegitimate) {
  Scene scene = scenes::twoBlocks(4, 2, 2);
  scene.fixLower();
  scene.hold("upper_left", 0, 0.0);
  TEST_EQUALITY(verdict(scene), "");
}

TEUCHOS_UNIT_TEST(Solvability, DoesNotDependOnUnits) {
  for (const double length : {1e-6, 1.0, 1e6})
    for (const double force : {1e-9, 1.0, 1e12})
      for (const double sign : {1.0, -1.0}) {
        Scene scene = scenes::twoBlocks(4, 2, 2);
        for (double& x : scene.mesh.coordinates) x *= length;
        scene.pairUp();
        scene.fixLower();
        scene.hold("upper_left", 0, 0.0);
        scene.pressure("upper_top", sign * force);
        TEST_EQUALITY(verdict(scene).empty(), sign > 0);
      }
}

TEUCHOS_UNIT_TEST(Solvability, RefusesPrescribedPenetration) {
  Scene scene = scenes::twoBlocks(4, 2, 2);
  scene.fixLower();
  scene.hold("lower_top", 1, 0.1);
  scene.hold("upper_bottom", 1, 0.0);
  scene.hold("upper_left", 0, 0.0);
  TEST_ASSERT(says(verdict(scene), "overlap by 0.1"));
}

TEUCHOS_UNIT_TEST(Solvability, NonnegativeLeastSquaresMeetsItsOptimalityConditions) {
  std::mt19937 random(4);
  std::normal_distribution<double> value;
  for (int trial = 0; trial < 50; ++trial) {
    const int m = 1 + trial % 7, n = 1 + trial % 23;
    Matrix a(m, n);
    Vector b(m);
    for (double& x : a.reshaped()) x = value(random);
    for (double& x : b) x = value(random);
    const Vector p = nonnegativeLeastSquares(a, b), pull = a.transpose() * (b - a * p);
    TEST_COMPARE(p.minCoeff(), >=, 0.0);
    TEST_COMPARE(pull.maxCoeff(), <, 1e-10);
    TEST_COMPARE(std::abs(pull.dot(p)), <, 1e-10 * (1 + p.norm()));
  }
}

// The lower block is fixed, the upper one lies on it and is pulled to the right by the given fraction of its weight.
std::string verdictOfPull(double pull, const LawPtr& law, double weight = 1e4) {
  Scene scene = scenes::twoBlocks(4, 2, 2);
  scene.fixLower();
  scene.pressure("upper_top", weight);
  scene.traction("upper_top", {pull * std::abs(weight), 0, 0});
  scene.constraints.laws = ContactLaws({law});
  return verdict(scene);
}

/// Blocks side by side in one row on a fixed floor, each pair of neighbours in contact: so many that sparse methods are used.
Scene rowOfBlocks(int count) {
  std::vector<Box> all;
  Box floor{"floor", 0, double(count), -1, 0, count, 1};
  all.push_back(floor);
  for (int i = 0; i < count; ++i) all.push_back({"b" + std::to_string(i), double(i), double(i + 1), 0, 1, 1, 1});
  Scene scene = scenes::fromBoxes(all);
  scene.hold("floor_bottom", 0, 0.0);
  scene.hold("floor_bottom", 1, 0.0);
  const auto add = [&](int a, int b, Point normal) {
    ContactPair pair;
    pair.id = int(scene.constraints.pairs.size());
    pair.ends = {{a, 1.0}, {b, -1.0}};
    pair.normal = normal;
    pair.position = scene.mesh.point(a);
    pair.length = 1.0;
    scene.constraints.pairs.push_back(pair);
  };
  const auto at = [&](const std::string& group, double x, double y) {
    for (const int node : scene.nodesOf(group))
      if (std::abs(scene.mesh.point(node)[0] - x) + std::abs(scene.mesh.point(node)[1] - y) < 1e-9) return node;
    return -1;
  };
  for (int i = 0; i < count; ++i) {
    const std::string own = "b" + std::to_string(i), next = "b" + std::to_string(i + 1);
    for (const double x : {i + 0.0, i + 1.0}) add(at("floor_top", x, 0), at(own + "_bottom", x, 0), {0, 1, 0});
    for (const double y : {0.0, 1.0})
      if (i + 1 < count) add(at(own + "_right", i + 1.0, y), at(next + "_left", i + 1.0, y), {1, 0, 0});
    scene.pressure(own + "_top", 1.0);
  }
  return scene;
}

// The loads of many blocks are balanced by sparse pads. Refusals must agree with statics, as those of few blocks do.
TEUCHOS_UNIT_TEST(Solvability, FindsTheMotionsOfManyBlocks) {
  const int count = 40;
  const auto bodies = [&](const std::string& text) {
    int named = 0;
    for (int i = 0; i < count; ++i) named += says(text, "body 'b" + std::to_string(i) + "'");
    for (int more = 1; more < count; ++more)
      if (says(text, " " + std::to_string(more) + " more bodies are not held")) named += more;
    return named;
  };
  const auto push = [&](Scene& scene, double x) {
    for (int i = 0; i < count; ++i) scene.traction("b" + std::to_string(i) + "_top", {x, 0, 0});
  };
  Scene held = rowOfBlocks(count);  // against a stop at the right end
  held.hold("b" + std::to_string(count - 1) + "_right", 0, 0.0);
  push(held, 0.1);
  TEST_EQUALITY(verdict(held), "");

  Scene pulled = rowOfBlocks(count);  // away from it
  pulled.hold("b" + std::to_string(count - 1) + "_right", 0, 0.0);
  push(pulled, -0.1);
  const std::string away = verdict(pulled);
  TEST_EQUALITY(bodies(away), count - 1);
  TEST_ASSERT(says(away, "body 'b0' can move to the left (-1, 0): the loads push it there"));

  Scene sliding = rowOfBlocks(count);  // no stop: the whole row slides
  push(sliding, 0.1);
  const std::string together = verdict(sliding);
  TEST_EQUALITY(bodies(together), count);
  TEST_ASSERT(says(together, "body 'b7' can move to the right (1, 0): the loads push it there"));

  Scene lifted = rowOfBlocks(count);  // one block is lifted
  lifted.hold("b" + std::to_string(count - 1) + "_right", 0, 0.0);
  push(lifted, 0.1);
  lifted.pressure("b5_top", -3.0);
  const std::string up = verdict(lifted);
  TEST_EQUALITY(bodies(up), 1);
  TEST_ASSERT(says(up, "body 'b5' can"));
}

TEUCHOS_UNIT_TEST(Solvability, FrictionHoldsUpToItsConeAndCohesionUpToTheSolversLimit) {
  TEST_ASSERT(says(verdictOfPull(0.3, std::make_shared<Frictionless>()), "move to the right"));
  TEST_ASSERT(says(verdictOfPull(0.3, dry(0.0, 0.0)), "move to the right"));
  TEST_EQUALITY(verdictOfPull(0.3, dry(0.0, 0.31)), "");
  TEST_ASSERT(says(verdictOfPull(0.3, dry(0.0, 0.29)), "the loads push it there"));
  TEST_EQUALITY(verdictOfPull(-0.3, dry(0.0, 0.31)), "");
  TEST_EQUALITY(verdictOfPull(0.0, dry(0.0, 0.1)), "");  // its place along the seat is that of the beginning
  TEST_EQUALITY(verdictOfPull(0.3, dry(1.0, 0.0)), "");
  // pulled off: only glue, or sides that never separate, hold it
  TEST_ASSERT(says(verdictOfPull(0.0, dry(1.0, 0.5), -1e4), "move upwards"));
  TEST_EQUALITY(verdictOfPull(0.3, std::make_shared<Tied>(), -1e4), "");
  TEST_ASSERT(says(verdictOfPull(0.0, std::make_shared<NoSeparation>(), -1e4), "without opening its contacts"));
  TEST_ASSERT(says(verdictOfPull(0.3, std::make_shared<NoSeparation>(), -1e4), "move to the right"));
}

TEUCHOS_UNIT_TEST(Solvability, FrictionIn3DHoldsInEveryDirection) {
  Box box;
  box.nx = box.ny = box.nz = 2;
  box.cell = Cell::Hexahedron8;
  const Scene block = scenes::fromBoxes({box});
  for (const double mu : {0.29, 0.307}) {  // sixteen planes about the cone exceed it by 2 % between two of its edges
    for (int direction = 0; direction < 32; ++direction) {
      Scene scene = block;
      scene.model.dimension = 3;
      for (const int node : scene.nodesOf("body_bottom")) {
        ContactPair pair;
        pair.id = int(scene.constraints.pairs.size());
        pair.line = 0;
        pair.ends = {{node, 1.0}};
        pair.normal = {0, 0, -1};
        pair.length = 1.0 / 9.0;
        pair.position = scene.mesh.point(node);
        scene.constraints.pairs.push_back(pair);
      }
      const double angle = M_PI * direction / 16.0;
      scene.model.loads.push_back(Load::bodyForce({0.3 * std::cos(angle), 0.3 * std::sin(angle), -1.0}));
      scene.constraints.laws = ContactLaws({dry(0.0, mu)});
      TEST_EQUALITY(verdict(scene).empty(), mu > 0.3);
    }
  }
}

}  // namespace
}  // namespace suture
