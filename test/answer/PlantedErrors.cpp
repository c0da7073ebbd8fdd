// Right answers, corrupted one at a time: the verdict must accept them before, and name the planted error after.
#include <Teuchos_UnitTestHarness.hpp>
#include <answer/Judged.hpp>

#include <limits>
#include <suture/answer/verdict/Deformation.hpp>
#include <suture/pairs/FrictionLaws.hpp>
#include <suture/pairs/PairFrame.hpp>

namespace suture {
namespace {

using namespace blocks;

/// Judges the answer without and with an error. \param body  that the verdict must name; "" any
void caught(const Scene& scene, const std::string& name, const std::function<void(Judged&)>& plant, bool& success,
            Teuchos::FancyOStream& out, const std::string& body = "") {
  Judged answer(scene);
  const Verification before = answer.verdict();
  TEST_ASSERT(before.holds());
  if (!before.holds()) out << "right answer: " << before.failure() << "\n";
  plant(answer);
  const Verification after = answer.verdict();
  const Check& found = check(after, name);
  out << name << " " << check(before, name).value << " -> " << found.value << " bound " << found.bound << " at " << found.where << "\n";
  TEST_ASSERT(!after.holds());
  TEST_ASSERT(!found.holds());
  TEST_ASSERT(after.failure().find(name) != std::string::npos);
  if (!body.empty()) TEST_ASSERT(found.where.find(body) != std::string::npos);
}

#define PLANT(Name, scene, quantity, ...) \
  TEUCHOS_UNIT_TEST(PlantedErrors, Name) { caught(scene, quantity, [](Judged & answer) __VA_ARGS__, success, out); }

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Bodies that move as a whole: no element detects it.
PLANT(ALooseBodyLifted, looseBlock(), "status", {
  const double shift = 1e-5 * answer.deformation(1);
  answer.move(1, [&](const Point&, double* u) { u[1] += shift; });
})
PLANT(ALooseBodyPushedIn, looseBlock(), "penetration", {
  const double shift = 1e-5 * answer.deformation(1);
  answer.move(1, [&](const Point&, double* u) { u[1] -= shift; });
})
PLANT(ALooseBodyTurned, looseBlock(), "status", {
  const double angle = 1e-5 * answer.deformation(1);
  answer.move(1, [&](const Point& x, double* u) { u[0] -= angle * x[1], u[1] += angle * x[0]; });
})
PLANT(ABodyShiftedAlongAGuide, looseBlock(), "prescribed", {
  const double shift = 1e-5 * answer.deformation(1);
  answer.move(1, [&](const Point&, double* u) { u[0] += shift; });
})
PLANT(AFixedBodyMoved, pressedBlocks(), "prescribed", {
  const double shift = 1e-7 * answer.deformation(0);
  answer.move(0, [&](const Point&, double* u) { u[0] += shift; });
})

// Where nothing acts any more, solver errors relative to the path's largest forces are accepted, and nothing larger.
TEUCHOS_UNIT_TEST(PlantedErrors, AreMeasuredByThePathWhereItEndsAtZero) {
  const auto verdict = [](double shift, double carried) {
    Judged answer(liftedBlock());
    if (carried > 0.0) answer.past.assign(2, {carried, 0.0, carried, 1e-2});
    answer.moveNear(0, {-0.3, -0.4, 0}, [&](double* u) { u[1] += shift; });
    return answer.verdict().holds();
  };
  TEST_ASSERT(!verdict(1e-12, 0.0));
  TEST_ASSERT(verdict(1e-12, 10.0));
  TEST_ASSERT(!verdict(1e-8, 10.0));
}

// Contact.
PLANT(AClosedPairCalledOpen, looseBlock(), "status", {
  if (const int pair = answer.strongest(); pair >= 0) answer.pairs[pair].state = PairStatus::Open;
})
PLANT(AnOpenPairCalledClosed, looseBlock(), "status", {
  if (const int pair = answer.widest(); pair >= 0) answer.pairs[pair].state = PairStatus::Slip;
})
PLANT(AForceScaled, looseBlock(), "residual", {
  if (const int pair = answer.strongest(); pair >= 0) answer.pairs[pair].force *= 1.001;
})
PLANT(AForceScaledBetweenPressedBlocks, pressedBlocks(), "residual", {
  if (const int pair = answer.strongest(); pair >= 0) answer.pairs[pair].force *= 1.001;
})
PLANT(AllForcesScaled, looseBlock(), "forces", {
  for (PairResult& pair : answer.pairs) pair.force *= 1.0001;
})
PLANT(AForceMovedToTheNeighbour, looseBlock(), "moments", {
  if (const int pair = answer.strongest(); pair >= 0) {
    const double moved = 1e-3 * answer.pairs[pair].force;
    answer.pairs[pair].force -= moved;
    answer.pairs[pair == 0 ? 1 : pair - 1].force += moved;
  }
})
PLANT(AForceAcrossAnOpenGap, looseBlock(), "complementarity", {
  const double force = 1e-4 * answer.largestForce();
  if (const int pair = answer.widest(); pair >= 0) answer.pairs[pair].force += force;
})
PLANT(ASmallTension, looseBlock(), "tension", {
  const double force = 1e-4 * answer.largestForce();
  if (const int pair = answer.widest(); pair >= 0) answer.pairs[pair].force -= force;
})
PLANT(APairLost, looseBlock(), "status", {
  if (!answer.pairs.empty()) answer.pairs.pop_back();
})
PLANT(APairTooMany, looseBlock(), "status", {
  if (!answer.pairs.empty()) answer.pairs.push_back(answer.pairs.back()), answer.pairs.back().id += 1;
})
PLANT(AGapThatWasSmaller, looseBlock(), "penetration", {
  const double closer = 1e-5 * answer.deformation(1);
  for (SubdomainMesh& mesh : answer.all.meshes)
    for (ContactRow& row : mesh.contactRows) row.pair.gap -= closer;
})
PLANT(AMortarForceScaled, mortarBlock(), "residual", {
  if (const int pair = answer.strongest(); pair >= 0) answer.pairs[pair].force *= 1.001;
})
PLANT(AMortarNodePushedIn, mortarBlock(), "penetration", {
  const double shift = 1e-5 * answer.deformation(1);
  answer.move(1, [&](const Point&, double* u) { u[1] -= shift; });
})
PLANT(AMortarPairCalledOpen, mortarBlock(), "status", {
  if (const int pair = answer.strongest(); pair >= 0) answer.pairs[pair].state = PairStatus::Open;
})
PLANT(AnObstaclesForceScaled, blockOnObstacle(), "residual", {
  if (const int pair = answer.strongest(); pair >= 0) answer.pairs[pair].force *= 1.001;
})
PLANT(AnObstacleThatWasNearer, blockOnObstacle(), "penetration", {
  const double closer = 1e-5 * answer.deformation(0);
  for (SubdomainMesh& mesh : answer.all.meshes)
    for (ContactRow& row : mesh.contactRows) row.pair.gap -= closer;
})

// Displacements.
PLANT(OneDofDisturbed, pressedBlocks(), "nodes", {
  const double shift = 1e-5 * answer.deformation(1);
  answer.moveNear(1, {0.2, 0.6, 0}, [&](double* u) { u[0] += shift; });
})
PLANT(OneDofOfTheLowerBodyDisturbed, looseBlock(), "nodes", {
  const double shift = 1e-5 * answer.deformation(0);
  answer.moveNear(0, {-0.3, -0.4, 0}, [&](double* u) { u[1] += shift; });
})
PLANT(ABumpOfTheLongestWave, looseBlock(100.0, 1.0, 16), "residual", {
  const double height = 1e-4 * answer.deformation(0);
  answer.move(0, [&](const Point& x, double* u) { u[0] += height * std::sin(2.0 * (x[1] + 1)) * x[1] * (x[0] - 1); });
})
PLANT(DisplacementsScaled, pressedBlocks(), "residual", {
  for (int body : {0, 1}) answer.move(body, [&](const Point&, double* u) { u[0] *= 1.0001, u[1] *= 1.0001; });
})
PLANT(OneDofOfABodyThatOnlyMoves, liftedBlock(), "nodes", { answer.moveNear(1, {0.2, 0.6, 0}, [&](double* u) { u[0] += 1e-9 * 0.3; }); })
PLANT(OneDofOfABodyThatCarriesNothing, liftedBlock(), "nodes", {
  answer.moveNear(0, {-0.3, -0.4, 0}, [&](double* u) { u[1] += 1e-9 * 0.3; });
})
PLANT(ABodyThatOnlyMovesStretched, liftedBlock(), "residual",
      { answer.move(1, [&](const Point& x, double* u) { u[1] += 1e-9 * 0.1 * (x[1] - 1); }); })
PLANT(ABodyThatOnlyMovesMovedFurther, liftedBlock(), "prescribed", { answer.move(1, [&](const Point&, double* u) { u[0] *= 1 + 1e-9; }); })
PLANT(AForceOnABodyThatOnlyMoves, liftedBlock(), "tension", {
  if (!answer.pairs.empty()) answer.pairs[3].force = -1e-9;
})
// Its deformation is round-off: bounds relative to it would be meaningless, with and without loads on its held nodes.
TEUCHOS_UNIT_TEST(PlantedErrors, BoundsOfABodyThatOnlyMovesAreMeaningful) {
  for (const double load : {0.0, 5.0}) {
    Scene scene = liftedBlock();
    scene.traction("upper_top", {0, -load, 0});
    const Verification verdict = Judged(scene).verdict();
    TEST_ASSERT(verdict.holds());
    for (const Check& one : verdict.checks) {
      out << load << " " << one.name << " " << one.value << " of " << one.bound << "\n";
      TEST_COMPARE(one.bound, <=, 1.0);
    }
    if (load > 0.0) TEST_COMPARE(check(verdict, "nodes").bound, <=, 0.05);
  }
}
PLANT(NotANumberInside, pressedBlocks(), "residual", { answer.moveNear(1, {0.2, 0.6, 0}, [&](double* u) { u[0] = kNaN; }); })
PLANT(NotANumberAmongTheForces, pressedBlocks(), "tension", {
  if (!answer.pairs.empty()) answer.pairs[2].force = kNaN;
})
PLANT(AnInfiniteDisplacement, looseBlock(), "residual", {
  answer.moveNear(0, {-0.3, -0.4, 0}, [&](double* u) { u[1] = std::numeric_limits<double>::infinity(); });
})
PLANT(ATornSeam, pressedBlocks(), "seams", {
  const double shift = 1e-8 * answer.deformation(1);
  for (std::size_t i = 0; i < answer.all.meshes.size(); ++i) {
    const SubdomainMesh& mesh = answer.all.meshes[i];
    for (int node = 0; mesh.body == 1 && node < mesh.nodes(); ++node)
      if (!counts(mesh, node)) answer.displacement[i][2 * node] += shift;
  }
})

// Data.
PLANT(AMissingLoad, looseBlock(), "forces", { answer.all.model.loads.push_back({Load::Kind::BodyForce, "upper", {0, -1e-6, 0}}); })
PLANT(AMissingLoadOnAHeldBody, looseBlock(), "residual", {
  answer.all.model.loads.push_back({Load::Kind::BodyForce, "lower", {1e-6, 0, 0}});
})
PLANT(AWrongModulus, pressedBlocks(), "residual", { answer.all.model.materialOfBody[1].young *= 1.0001; })
PLANT(AWrongPoissonRatio, looseBlock(), "residual", { answer.all.model.materialOfBody[0].poisson += 1e-4; })
PLANT(AnotherPlaneModel, looseBlock(), "residual", { answer.all.model.plane = PlaneModel::Stress; })
PLANT(AnotherPrescribedValue, pressedBlocks(), "prescribed", {
  const double off = 1e-8 * answer.deformation(1);
  for (SubdomainMesh& mesh : answer.all.meshes)
    for (NodeRule& rule : mesh.rules)
      if (mesh.body == 1) rule.value[1] += off;
})
PLANT(AnotherNormal, looseBlock(), "residual", {
  for (SubdomainMesh& mesh : answer.all.meshes)
    for (ContactRow& row : mesh.contactRows) row.pair.normal = {1e-4, 1, 0};
})

/// All bodies moved by the given number of body sizes: a right answer that has lost its digits.
TEUCHOS_UNIT_TEST(PlantedErrors, DigitsLostToARigidMotion) {
  Judged answer(pressedBlocks());
  TEST_ASSERT(answer.verdict().holds());
  for (const double distance : {1e3, 1e13}) {
    Judged moved(pressedBlocks());
    for (int body : {0, 1}) moved.move(body, [&](const Point&, double* u) { u[0] += distance; });
    for (SubdomainMesh& mesh : moved.all.meshes)
      for (NodeRule& rule : mesh.rules)
        if (rule.fixed[0]) rule.value[0] += distance;
    const Verification verdict = moved.verdict();
    TEST_EQUALITY(check(verdict, "digits").holds(), distance < 1e6);
    TEST_EQUALITY(verdict.holds(), distance < 1e6);
    out << distance << ": digits " << check(verdict, "digits").value << "\n" << verdict.failure() << "\n";
  }
}

/// In a contact that slides freely, a body is rotated by the small slope of the tangent: forces balance, but its position is meaningless.
TEUCHOS_UNIT_TEST(PlantedErrors, ATurnThatNothingHolds) {
  for (const double turn : {0.2, 8.0}) {
    Judged answer(looseBlock());
    answer.move(1, [&](const Point& x, double* u) { u[0] -= turn * x[1], u[1] += turn * x[0]; });
    const Check& found = check(answer.verdict(), "rotation");
    out << turn << " rad, deformation " << answer.deformation(1) << ": " << found.value << " of " << found.bound << " at " << found.where
        << "\n";
    TEST_EQUALITY(found.holds(), turn < 0.3);
    TEST_ASSERT(found.value == 0.0 || std::abs(found.value - turn) < 0.01 * turn);
  }
}

TEUCHOS_UNIT_TEST(PlantedErrors, ATurnThatDeformationExplains) {
  Deformation roller, arm;
  roller.turn = 0.4;
  roller.extent = 1.0;
  roller.largest = 1e-4;
  arm.largest = 1e-3;
  TEST_EQUALITY(unexplainedTurn({roller, arm}, 0), 0.4);
  TEST_EQUALITY(unexplainedTurn({roller, arm}, 1), 0.0);
  arm.largest = 1e-2;  // bent by as much as the roller has rotated
  TEST_EQUALITY(unexplainedTurn({roller, arm}, 0), 0.0);
  arm.largest = 1e-3;
  arm.prescribed = 3e-3;  // far less than the roller has rotated
  TEST_EQUALITY(unexplainedTurn({roller, arm}, 0), 0.4);
  arm.prescribed = 1e-2;
  TEST_EQUALITY(unexplainedTurn({roller, arm}, 0), 0.0);
}

/// A friction law with zero bound: the answers are those of frictionless scenes. No pair may have a tangential force.
TEUCHOS_UNIT_TEST(PlantedErrors, ATangentialForceWhereNothingRubs) {
  for (Scene scene : {looseBlock(), mortarBlock(), blockOnObstacle(), turned(looseBlock(), 0.5)}) {
    scene.constraints.laws = ContactLaws({std::make_shared<DryFriction>(Expression("0"), Expression("0"))});
    Judged answer(scene);
    for (PairResult& pair : answer.pairs)
      if (const double size = norm(pair.slip); pair.state.closed() && size > 0.0) {
        const Point tangent = pairFrame(pair.normal, 2)[1];
        pair.state = {PairStatus::Slip, {0, dot(pair.slip, tangent) > 0 ? 1.0 : -1.0, 0}, 0.0};
      }
    const Verification before = answer.verdict();
    TEST_ASSERT(before.holds());
    TEST_EQUALITY(before.checks.size(), scene.constraints.pairs[0].ends.size() > 1 ? 18 : 17);  // `offset` of two bodies
    out << before.failure() << "\n";
    for (const bool isOpen : {false, true}) {
      const int pair = isOpen ? answer.widest() : answer.strongest();
      if (pair >= 0) answer.pairs[pair].tangential = scaled(1e-4 * answer.largestForce(), pairFrame(answer.pairs[pair].normal, 2)[1]);
      const Verification after = answer.verdict();
      TEST_ASSERT(!check(after, "friction").holds());
      if (pair >= 0) answer.pairs[pair].tangential = {0, 0, 0};
    }
  }
}

/// A weak pair of bodies next to a strong one: its own forces are the scale.
TEUCHOS_UNIT_TEST(PlantedErrors, AWeakBodysForceScaled) {
  for (const double weak : {1e-3, 1e-9})
    caught(
        strongAndWeak(weak), "residual",
        [](Judged& answer) {
          for (PairResult& pair : answer.pairs)
            if (pair.piece == 1) pair.force *= 1.0001;
        },
        success, out, "2'");
}
/// A rotation common to all bodies was taken out: one node that did not rotate with its body is found, and a stretch.
TEUCHOS_UNIT_TEST(PlantedErrors, AMotionTakenOutThatIsNotRigid) {
  const double turn = 0.25;
  for (const int planted : {0, 1, 2}) {
    Judged answer(pressedBlocks());
    for (SubdomainMesh& mesh : answer.all.meshes) {
      mesh.lift.motion = Vector::Zero(2 * mesh.nodes());
      for (int node = 0; node < mesh.nodes(); ++node) {
        const Point x = mesh.point(node);
        mesh.lift.motion[2 * node] = 1.0 - turn * x[1];
        mesh.lift.motion[2 * node + 1] = 2.0 + turn * x[0] * (planted == 2 ? 1 + 1e-9 : 1.0);
        if (planted == 1 && mesh.body == 1 && std::hypot(x[0] - 0.5, x[1] - 0.5) < 0.3) mesh.lift.motion[2 * node] += 1e-9;
      }
      for (const NodeRule& rule : mesh.rules) {
        mesh.lift.values.push_back(rule.value);
        for (int k = 0; k < 2; ++k)
          mesh.lift.values.back()[k] +=
              rule.axes[k][0] * mesh.lift.motion[2 * rule.node] + rule.axes[k][1] * mesh.lift.motion[2 * rule.node + 1];
      }
      for (const ContactRow& row : mesh.contactRows) mesh.lift.gaps.emplace(row.pair.id, row.pair.gap);
    }
    const Verification verdict = answer.verdict();
    out << planted << ": " << verdict.failure() << "\n";
    TEST_EQUALITY(verdict.holds(), planted == 0);
    if (planted > 0) TEST_ASSERT(verdict.failure().find("prescribed") != std::string::npos);
  }
}

TEUCHOS_UNIT_TEST(PlantedErrors, AWeakBodyLifted) {
  caught(
      strongAndWeak(1e-6), "status",
      [](Judged& answer) {
        const double shift = 1e-5 * answer.deformation(3);
        answer.move(3, [&](const Point&, double* u) { u[1] += shift; });
      },
      success, out, "2'");
}

}  // namespace
}  // namespace suture
