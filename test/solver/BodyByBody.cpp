// Accuracy per body: answers of all methods, with their defaults, against the same scene solved in extended precision.
#include <Teuchos_UnitTestHarness.hpp>
#include <answer/Judged.hpp>
#include <solver/SolveWays.hpp>
#include <support/Cases.hpp>
#include <suture/answer/verdict/Findings.hpp>

namespace suture {
namespace {

using namespace blocks;
using scenes::ExtendedReference;

constexpr double kDigits = 1e-6;

/// True for a right answer, however far it moves: loads here have any size, and soft bodies slide by many elements.
bool holdsBesideSlides(const Verification& verdict) {
  return std::all_of(verdict.checks.begin(), verdict.checks.end(),
                     [](const Check& check) { return check.holds() || check.name == nameOf(Quantity::Slide); });
}

/// All methods against the reference.
void agrees(const Scene& scene, const ExtendedReference& reference, bool& success, Teuchos::FancyOStream& out, const std::string& name,
            double digits = kDigits) {
  for (const std::string& way : ways()) {
    const Solved found = solveAs(way, scene);
    const BodyByBody apart = found.pairs.empty() ? BodyByBody() : compare(scene, found, reference);
    out << name << ", " << way << ": " << found.pcg << " PCG, forces " << apart.force << ", displacements " << apart.displacement << ", "
        << apart.otherwise << " statuses, verdict " << (found.verdict.holds() ? "holds" : found.verdict.failure()) << " " << found.failure
        << "\n";
    TEST_ASSERT(found.converged);
    TEST_ASSERT(holdsBesideSlides(found.verdict));
    TEST_COMPARE(apart.force, <=, digits);
    TEST_COMPARE(apart.displacement, <=, digits);
    TEST_EQUALITY(apart.otherwise, 0);
  }
}

/// The scene with all prescribed values moved by a rigid motion of the given number of body sizes.
struct Moved {
  Scene scene;
  double x, y, turn;
  Moved(Scene given, double byX, double byY, double byTurn) : scene(std::move(given)), x(byX), y(byY), turn(byTurn) {
    for (NodeRule& rule : scene.constraints.rules) {
      const Point at = scene.mesh.point(rule.node);
      for (int k = 0; k < 2; ++k)
        if (rule.fixed[k]) rule.value[k] += rule.axes[k][0] * (x - turn * at[1]) + rule.axes[k][1] * (y + turn * at[0]);
    }
  }
  ExtendedReference reference() const {
    return ExtendedReference(scene, {}, [this](int, const Point& at) {
      return std::array<long double, 2>{x - (long double)turn * at[1], y + (long double)turn * at[0]};
    });
  }
};

TEUCHOS_UNIT_TEST(BodyByBody, AllBodiesMovedRigidly) {
  for (const double size : casesOf({1e6, 1e3, 1.0}))
    for (const double turn : {0.0, 1.0})
      for (const bool loose : {false, true}) {
        const Moved moved(loose ? looseBlock() : pressedBlocks(), 0.6 * size, 0.8 * size, turn * size);
        agrees(moved.scene, moved.reference(), success, out, "by " + std::to_string(size) + (loose ? " loose" : " held"));
      }
}

TEUCHOS_UNIT_TEST(BodyByBody, InitialGaps) {
  for (const double size : casesOf({1e6, 1e3, 1.0})) {
    Scene scene = looseBlock();
    for (ContactPair& pair : scene.constraints.pairs) pair.gap += size;
    const ExtendedReference reference(scene, {}, [&](int body, const Point&) {
      return std::array<long double, 2>{0, body == 1 ? -size : 0.0};
    });
    agrees(scene, reference, success, out, "gap " + std::to_string(size));
  }
}

/// Two clusters: the same moduli, different loads.
TEUCHOS_UNIT_TEST(BodyByBody, ClustersOfVeryDifferentLoads) {
  for (const double weak : casesOf({1e-12, 1e-6})) {
    Scene scene = strongAndWeak(weak);
    for (int k = 2; k < 4; ++k) scene.model.materialOfBody[k].young /= weak;
    agrees(scene, ExtendedReference(scene), success, out, "loads " + std::to_string(weak));
    agrees(strongAndWeak(weak), ExtendedReference(strongAndWeak(weak)), success, out, "loads and moduli " + std::to_string(weak));
  }
}

/// A block on two bumps.
TEUCHOS_UNIT_TEST(BodyByBody, LoadsOf1e9thOfTheModulus) {
  for (const double load : casesOf({1e-9, 1e-3})) {
    Scene scene = looseBlock(1.0, 100.0 * load);
    for (ContactPair& pair : scene.constraints.pairs) pair.gap = 1e-3 * std::pow(std::abs(pair.position[0]) - 0.5, 2);
    agrees(scene, ExtendedReference(scene), success, out, "load " + std::to_string(load));
  }
}

/// A crown of 1 cm over 2 m under 100 Pa on steel: all 200 N/m pass through the pair in the middle.
TEUCHOS_UNIT_TEST(BodyByBody, ACrownUnderALightLoad) {
  Scene scene = scenes::fromBoxes(twoBoxes(16, 8, 2, 2), 2.1e11, 0.3);
  scene.pairUp();
  scene.fixLower();
  scene.hold("upper_right", 0, 0.0);
  scene.pressure("upper_top", 100.0);
  for (ContactPair& pair : scene.constraints.pairs) pair.gap = 0.01 * pair.position[0] * pair.position[0];
  const ExtendedReference reference(scene);
  agrees(scene, reference, success, out, "crown");
  for (const std::string& way : ways())
    for (const PairResult& pair : solveAs(way, scene).pairs)
      if (pair.position[0] == 0.0) TEST_FLOATING_EQUALITY(pair.force, 200.0, 1e-9);
}

TEUCHOS_UNIT_TEST(BodyByBody, YoungJumpsBetweenBodies) {
  for (const double jump : casesOf({1e8, 1e-8, 1e4, 1e-4}, 2)) {
    Scene scene = looseBlock();
    scene.model.materialOfBody[1].young *= jump;
    agrees(scene, ExtendedReference(scene), success, out, "jump " + std::to_string(jump));
  }
}

Scene bricks(double jump) {
  Scene scene = looseBlock();
  for (const char* group : {"subdomain_lower_0_0", "subdomain_upper_1_1"}) scene.region(group, 100.0 * jump);
  return scene;
}

TEUCHOS_UNIT_TEST(BodyByBody, YoungJumpsBetweenBricks) {
  for (const double jump : casesOf({1e8, 1e-8, 1e7, 1e4, 1e-4}, 2))
    agrees(bricks(jump), ExtendedReference(bricks(jump)), success, out, "bricks " + std::to_string(jump));
}

/// Beyond double precision: an answer is right, or the verdict rejects it.
TEUCHOS_UNIT_TEST(BodyByBody, TheVerdictKnowsJumpsThatAreTooLarge) {
  for (const double jump : casesOf({1e14, 1e-14, 1e11, 1e-11}, 2)) {
    const ExtendedReference reference(bricks(jump));
    for (const std::string& way : ways()) {
      Solved found;
      try {
        found = solveAs(way, bricks(jump));
      } catch (const NumericalError& error) {  // a factorisation that detects it
        TEST_ASSERT(std::string(error.what()).find("singular to working precision") != std::string::npos);
        continue;
      }
      const BodyByBody apart = compare(bricks(jump), found, reference);
      const bool right = found.converged && apart.force <= 1e-4 && apart.displacement <= 1e-4 && apart.otherwise == 0;
      out << jump << " " << way << ": forces " << apart.force << ", displacements " << apart.displacement << " " << found.failure << ", "
          << (found.verdict.holds() ? "holds" : found.verdict.failure()) << "\n";
      if (found.converged) TEST_ASSERT(right || !found.verdict.holds());
    }
  }
}

/// Moduli and loads in another unit of force.
Scene inUnits(Scene scene, double unit) {
  for (Material& material : scene.model.materialOfBody) material.young *= unit;
  for (Load& load : scene.model.loads)
    for (double& value : load.value) value *= unit;
  return scene;
}

TEUCHOS_UNIT_TEST(BodyByBody, TheSameDigitsInAnyUnit) {
  for (const double unit : casesOf({1e100, 1e-100, 1e60, 1e-60}, 2)) {
    const Scene scene = inUnits(looseBlock(), unit);
    agrees(scene, ExtendedReference(scene), success, out, "unit of 1e" + std::to_string(std::lround(std::log10(unit))));
  }
}

/// Loads, gaps and prescribed values that single precision could not represent.
TEUCHOS_UNIT_TEST(BodyByBody, TheSameDigitsUnderTinyLoads) {
  for (const double load : casesOf({1e-100, 1e-60, 1e-40})) {
    const Scene scene = looseBlock(100.0, load);
    agrees(scene, ExtendedReference(scene), success, out, "loads of 1e" + std::to_string(std::lround(std::log10(load))));
  }
}

}  // namespace
}  // namespace suture
