#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Errors.hpp>

#include "RandomContact.hpp"

namespace suture {
namespace {

/// Pads of unit stiffness on bodies that move along one line each; one row per pad.
RigidBodyModel::Pairs onLines(const Matrix& rows, const Vector& work, const Vector& penetration) {
  RigidBodyModel::Pairs pairs;
  pairs.rows = rows.sparseView();
  pairs.work = work;
  pairs.penetration = penetration;
  pairs.stiffness = Vector::Ones(rows.rows());
  for (int i = 0; i < rows.rows(); ++i) pairs.line.push_back(i);
  pairs.canChange.assign(rows.rows(), 1);
  return pairs;
}

TEUCHOS_UNIT_TEST(RigidBodyModel, PadsCarryTheLoads) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    const RandomContact given(seed);
    RigidBodyModel rigid(given.pairs);
    rigid.start();
    const RigidBodyModel::Equilibrium pads = rigid.project(given.pairs.penetration);
    TEST_ASSERT(pads.found);
    if (pads.force.size() > 0) TEST_COMPARE(pads.force.minCoeff(), >=, 0.0);
    const double size =
        pads.force.sum() + given.pairs.work.norm() + 1e-3 * given.open.cwiseAbs().maxCoeff() * given.pairs.stiffness.minCoeff() + 1e-300;
    TEST_COMPARE((given.pairs.rows.transpose() * pads.force - given.pairs.work).norm(), <=, 1e-8 * size);
  }
}

TEUCHOS_UNIT_TEST(RigidBodyModel, StabilisingPairsStopAllThatPairsCanStop) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    const RandomContact given(seed);
    const RigidBodyModel rigid(given.pairs);
    ClosedSet closed(given.open.size(), 0);
    for (std::size_t i = 0; i < closed.size(); i += 2 + seed % 3) closed[i] = 1;
    const Matrix loose = rigid.loose(closed);
    for (const int i : rigid.stabilisingPairs(closed, loose)) {
      TEST_EQUALITY(static_cast<int>(closed[i]), 0);
      closed[i] = 1;
    }
    TEST_ASSERT(!rigid.loosens(closed));
  }
}

TEUCHOS_UNIT_TEST(RigidBodyModel, RefusesLoadsThatPushABodyAway) {
  RigidBodyModel::Pairs pairs;
  pairs.rows = Matrix::Constant(2, 1, 1.0).sparseView();
  pairs.work = Vector::Constant(1, -1.0);  // pairs only push the other way
  pairs.penetration = Vector::Constant(2, -0.1);
  pairs.stiffness = Vector::Ones(2);
  pairs.line = {0, 0};
  pairs.canChange = {1, 1};
  RigidBodyModel rigid(pairs);
  TEST_THROW(rigid.start(), NumericalError);
}

TEUCHOS_UNIT_TEST(RigidBodyModel, NeutralMotionsAreThoseThatTouchingPairsDoNotStop) {
  RigidBodyModel::Pairs pairs;
  pairs.rows = (Matrix(3, 2) << 1, 0, 0, 1, 0, -1).finished().sparseView();
  pairs.work = (Vector(2) << 1, 0).finished();
  pairs.penetration = Vector::Zero(3);
  pairs.stiffness = Vector::Ones(3);
  pairs.line = {0, 1, 2};
  pairs.canChange = {1, 1, 1};
  const RigidBodyModel rigid(pairs);
  TEST_EQUALITY(rigid.neutral({1, 0, 0}, {0, 0, 0}).cols(), 1);
  TEST_EQUALITY(rigid.neutral({1, 0, 0}, {0, 1, 0}).cols(), 1);  // away from the one that touches
  TEST_EQUALITY(rigid.neutral({1, 0, 0}, {0, 1, 1}).cols(), 0);  // between two that touch
}

/// A weak cluster next to a strong one: its equilibrium is not lost in the round-off of the other. Pads have compliance 2 before start().
TEUCHOS_UNIT_TEST(RigidBodyModel, SeparateClustersKeepTheirDigits) {
  const Matrix rows = Matrix::Identity(2, 2);
  for (const double weak : {1.0, 1e-12, 1e-30}) {
    const RigidBodyModel rigid(onLines(rows, (Vector(2) << 1.0, weak).finished(), (Vector(2) << -1e3, -weak).finished()));
    const RigidBodyModel::Equilibrium pads = rigid.project(rigid.data().penetration);
    TEST_ASSERT(pads.found);
    TEST_FLOATING_EQUALITY(pads.force(0), 1.0, 1e-10);
    TEST_FLOATING_EQUALITY(pads.force(1), weak, 1e-12);
    TEST_FLOATING_EQUALITY(pads.motion(0), 1e3 + 2.0, 1e-12);
    TEST_FLOATING_EQUALITY(pads.motion(1), 3.0 * weak, 1e-12);
  }
}

/// Forces keep their digits over long motions: with pads of compliance 2 the body moves to the end of the gap and 2 further.
TEUCHOS_UNIT_TEST(RigidBodyModel, ForcesKeepTheirDigitsOverLongWays) {
  for (const double gap : {1.0, 1e6, 1e12}) {
    const RigidBodyModel rigid(onLines(Matrix::Ones(1, 1), Vector::Ones(1), Vector::Constant(1, -gap)));
    const RigidBodyModel::Equilibrium pads = rigid.project(rigid.data().penetration);
    TEST_ASSERT(pads.found);
    TEST_FLOATING_EQUALITY(pads.force(0), 1.0, 1e-9);
    TEST_FLOATING_EQUALITY(pads.motion(0), gap + 2.0, 1e-12);
  }
}

/// A wedge that two walls guide slides a long way down a narrowing slot of many steps and comes to rest against one of them: each plain
/// Newton step detects one wall.
TEUCHOS_UNIT_TEST(RigidBodyModel, ABodyThatBouncesBetweenWallsIsBroughtToRest) {
  for (const double slope : {1e-1, 1e-3, 1e-5}) {
    Matrix rows(2, 2);  // walls that close in by `slope`
    rows << slope, 1.0, slope, -1.0;
    const double way = 1e4;
    RigidBodyModel rigid(onLines(rows, (Vector(2) << 1.0, 0.0).finished(), Vector::Constant(2, -way * slope)));
    const RigidBodyModel::Equilibrium pads = rigid.project(rigid.data().penetration);
    TEST_ASSERT(pads.found);
    TEST_FLOATING_EQUALITY(pads.force(0), 0.5 / slope, 1e-7);
    TEST_FLOATING_EQUALITY(pads.force(1), 0.5 / slope, 1e-7);
    // Penetration 2 f of each = slope (x - way)
    TEST_FLOATING_EQUALITY(pads.motion(0), way + 1.0 / (slope * slope), 1e-7);
    TEST_COMPARE(std::abs(pads.motion(1)), <, 1e-7 * pads.motion(0) * slope);
  }
}

/// The body has moved further than necessary: if the way back is free it returns to its start, or to the wall that stops it.
TEUCHOS_UNIT_TEST(RigidBodyModel, LeastMotionGoesBackAsFarAsWallsAllow) {
  Matrix rows(2, 2);
  rows << 0, 1,  // carries
      1, 0;      // a wall
  const RigidBodyModel rigid(onLines(rows, (Vector(2) << 0, 1).finished(), Vector::Constant(2, -1.0)));
  const Vector motion = (Vector(2) << 5.0, 3.0).finished();
  const Vector back = rigid.leastMotion({1, 0}, motion, (Vector(2) << 0.0, -7.0).finished());
  TEST_COMPARE(std::abs(back(0)), <, 1e-12);
  TEST_FLOATING_EQUALITY(back(1), 3.0, 1e-12);
  Matrix barred = rows;
  barred(1, 0) = -1.0;  // the wall lies behind it, 2 away
  const Vector half = RigidBodyModel(onLines(barred, (Vector(2) << 0, 1).finished(), Vector::Constant(2, -1.0)))
                          .leastMotion({1, 0}, motion, (Vector(2) << 0.0, -2.0).finished());
  TEST_FLOATING_EQUALITY(half(0), 3.0, 1e-12);
  TEST_FLOATING_EQUALITY(half(1), 3.0, 1e-12);
}

TEUCHOS_UNIT_TEST(RigidBodyModel, ScalesAreThoseOfTheOwnCluster) {
  RigidBodyModel::Pairs pairs = onLines(Matrix::Identity(3, 3), Vector::Ones(3), Vector::Zero(3));
  pairs.bodies = {{0, 1}, {1, 2}, {3, 4}};
  const RigidBodyModel rigid(pairs);
  const Vector values = (Vector(3) << 5.0, -1e-3, 1e-9).finished();
  const Vector joined = rigid.clusterScale({1, 1, 1}, values), apart = rigid.clusterScale({1, 0, 1}, values);
  TEST_EQUALITY(joined(0), 5.0);
  TEST_EQUALITY(joined(1), 5.0);
  TEST_EQUALITY(joined(2), 1e-9);
  TEST_EQUALITY(apart(1), 5.0);  // an open pair is scaled by the cluster that it would join
}

// A ball falls on a plane: 400 pairs in any order give the same pads, as soft as a disc of as many nodes (Boussinesq).
TEUCHOS_UNIT_TEST(RigidBodyModel, PadsOnASurfaceDoNotDependOnTheOrderOfPairs) {
  const int n = 20;
  std::vector<int> order(n * n);
  for (int i = 0; i < n * n; ++i) order[i] = (i * 161 + 7) % (n * n);
  std::vector<ClosedSet> sets;
  for (const bool mixed : {false, true}) {
    RigidBodyModel::Pairs pairs = onLines(Matrix::Ones(n * n, 1), Vector::Constant(1, 4.0), Vector::Zero(n * n));
    pairs.line.assign(n * n, 0);
    pairs.surfaces = true;
    for (int i = 0; i < n * n; ++i) {
      const int at = mixed ? order[i] : i;
      const double x = at % n - 9.5, y = at / n - 9.5;
      pairs.penetration(i) = -0.02 * (x * x + y * y);
    }
    RigidBodyModel rigid(pairs);
    const ClosedSet found = rigid.start();
    ClosedSet set(found.size());
    for (int i = 0; i < n * n; ++i) set[mixed ? order[i] : i] = found[i];
    sets.push_back(set);
    const double closed = static_cast<double>(std::count(set.begin(), set.end(), 1));
    TEST_COMPARE(closed, >, 20.0);
    TEST_COMPARE(closed, <, 300.0);
    TEST_FLOATING_EQUALITY(rigid.compliance().maxCoeff(), 0.9 * std::sqrt(closed), 0.1);
  }
  TEST_ASSERT(sets[0] == sets[1]);
}

// A column of bodies: each pad carries the weight of all bodies above it, whatever the gaps. More bodies than the dense model is used for.
TEUCHOS_UNIT_TEST(RigidBodyModel, CarriesAColumnOfManyBodies) {
  for (const int bodies : {10, 59, 61, 150}) {
    Matrix rows = Matrix::Zero(bodies, bodies);
    Vector gaps(bodies);
    for (int i = 0; i < bodies; ++i) {
      rows(i, i) = 1.0;
      if (i > 0) rows(i, i - 1) = -1.0;
      gaps(i) = 0.01 * ((7 * i) % 5 - 1);
    }
    RigidBodyModel rigid(onLines(rows, Vector::Ones(bodies), -gaps));
    const RigidBodyModel::Equilibrium found = rigid.project(-gaps);
    TEST_ASSERT(found.found);
    for (int i = 0; i < bodies; ++i) TEST_FLOATING_EQUALITY(found.force(i), double(bodies - i), 1e-7);
    double place = 0.0;  // each pad is compressed by its force times its compliance
    for (int i = 0; i < bodies; ++i) {
      place += gaps(i) + found.force(i) * rigid.compliance()(i);
      TEST_FLOATING_EQUALITY(found.motion(i), place, 1e-7);
    }
    ClosedSet closed(bodies, 1);
    TEST_EQUALITY(rigid.loose(closed).cols(), 0);
    closed[bodies / 2] = 0;
    const Matrix loose = rigid.loose(closed);
    TEST_EQUALITY(loose.cols(), 1);
    for (int i = 0; i < bodies; ++i)  // the bodies above the open pad move together
      TEST_FLOATING_EQUALITY(std::abs(loose(i, 0)) + 1.0, 1.0 + (i < bodies / 2 ? 0.0 : 1.0 / std::sqrt(bodies - bodies / 2)), 1e-10);
    // Pulled upwards, nothing holds the bodies.
    TEST_ASSERT(!RigidBodyModel(onLines(rows, -Vector::Ones(bodies), -gaps)).project(-gaps).found);
  }
}

/// Rows of a block's corners on a plane: motions are three displacements and three rotations about the middle of its lower side.
TEUCHOS_UNIT_TEST(RigidBodyModel, StatesOfPairsLeaveTheMotionsThatTheyDoNotHold) {
  RigidBodyModel::Pairs pairs;
  std::vector<Matrix> effects(3, Matrix::Zero(4, 6));  // by component
  for (int i = 0; i < 4; ++i) {
    const double x = i % 2 == 0 ? -1.0 : 1.0, y = i < 2 ? -1.0 : 1.0;
    effects[0].row(i) << 0, 0, 1, y, -x, 0;
    effects[1].row(i) << 1, 0, 0, 0, 0, -y;
    effects[2].row(i) << 0, 1, 0, 0, 0, x;
  }
  pairs.rows = effects[0].sparseView();
  for (int k = 1; k < 3; ++k) pairs.tangents.emplace_back(effects[k].sparseView());
  pairs.work = Vector::Zero(6);
  pairs.penetration = Vector::Zero(4);
  pairs.stiffness = Vector::Ones(4);
  pairs.line.assign(4, 0);
  pairs.canChange.assign(4, 1);
  pairs.surfaces = true;
  const RigidBodyModel rigid(pairs);
  const ContactState open, slip(PairStatus::Slip, {0, 1, 0}, 1.0), stick(PairStatus::Stick);
  ContactState guided(PairStatus::Slip, {0, 1, 0}, 1.0);
  guided.transverseStiffness = 2.0;
  const auto left = [&](const PairStates& states) { return int(rigid.loose(states).cols()); };
  TEST_EQUALITY(left({open, open, open, open}), 6);
  TEST_EQUALITY(left({slip, open, open, open}), 5);
  TEST_EQUALITY(left({slip, slip, slip, slip}), 3);    // slides and spins
  TEST_EQUALITY(left({stick, slip, slip, slip}), 1);   // spins about the one that sticks
  TEST_EQUALITY(left({stick, stick, open, open}), 1);  // tilts about the edge
  TEST_EQUALITY(left({stick, slip, stick, slip}), 0);
  TEST_EQUALITY(left({guided, slip, slip, slip}), 2);
  TEST_EQUALITY(left({guided, guided, slip, slip}), 1);
  const Vector along = rigid.loose(PairStates{guided, guided, guided, guided}).col(0);  // along the direction of slip
  TEST_FLOATING_EQUALITY(std::abs(along(0)), 1.0, 1e-12);
  const Vector spin = rigid.loose(PairStates{stick, slip, slip, slip}).col(0);  // the corner (-1, -1) stays where it is
  TEST_COMPARE(std::abs(spin(0) + spin(5)) + std::abs(spin(1) - spin(5)) + std::abs(spin(2)), <, 1e-12);
}

}  // namespace
}  // namespace suture
