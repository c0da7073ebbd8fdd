#include <Teuchos_UnitTestHarness.hpp>
#include <suture/algebra/dense/NonnegativeLeastSquares.hpp>
#include <suture/search/PadModel.hpp>

#include <cmath>
#include <random>

#include "PadsInARow.hpp"

namespace {

using namespace suture;
using padsinarow::padsInARow;
using Force = FrictionCone::Force;

/// A block of base 2 (2 x 2 in 3D) on pads at its corners, under forces at its centre, `height` above the pads.
struct Block {
  RigidBodyModel::Pairs pairs;

  Block(int dimension, const Force& load, double height = 0.2) {
    const int corners = dimension == 2 ? 2 : 4, motions = dimension == 2 ? 3 : 6;
    std::vector<Matrix> effects(static_cast<std::size_t>(dimension), Matrix::Zero(corners, motions));  // by component
    pairs.penetration = Vector::Zero(corners);
    pairs.stiffness = Vector::Ones(corners);
    pairs.line.assign(corners, 0);
    pairs.canChange.assign(corners, 1);
    for (int i = 0; i < corners; ++i) {
      const double x = i % 2 == 0 ? -1.0 : 1.0, y = dimension == 2 ? 0.0 : i < 2 ? -1.0 : 1.0;
      // Motions: along the normal and the tangents; rotations. Penetration grows where the block moves down.
      effects[0](i, 0) = 1.0;
      for (int t = 0; t < dimension - 1; ++t) effects[static_cast<std::size_t>(t) + 1](i, 1 + t) = 1.0;
      if (dimension == 2) {
        effects[0](i, 2) = x;
        effects[1](i, 2) = -height;
      } else {
        effects[0](i, 3) = x, effects[1](i, 3) = -height;
        effects[0](i, 4) = y, effects[2](i, 4) = -height;
        effects[1](i, 5) = -y, effects[2](i, 5) = x;
      }
    }
    pairs.rows = effects[0].sparseView();
    for (std::size_t k = 1; k < effects.size(); ++k) pairs.tangents.emplace_back(effects[k].sparseView());
    pairs.work = Vector::Zero(motions);
    pairs.work.head(dimension) = load.head(dimension);
  }
};

TEUCHOS_UNIT_TEST(PadModel, DetectsLoadsThatTheConesCannotBalance) {
  // A pyramid of 16 planes about the cone is 2 % too wide: it would miss 1 %.
  const double mu = 0.6;
  for (int k = 0; k < 48; ++k) {
    const double angle = 2.0 * M_PI * (k + 0.5) / 48;
    for (const double part : {0.99, 1.01}) {
      const Force load(1.0, part * mu * std::cos(angle), part * mu * std::sin(angle));
      const Block block(3, load);
      const Vector motion = PadModel(block.pairs, std::vector<FrictionCone>(4, {0.0, mu})).unbalanced();
      TEST_EQUALITY(motion.size() > 0, part > 1.0);
      if (motion.size() > 0) TEST_COMPARE(block.pairs.work.dot(motion), >, 0.0);
    }
  }
  // Without friction, in a groove of two flanks: loads into the groove hold, loads out along a flank do not.
  RigidBodyModel::Pairs groove = Block(2, Force(1.0, 0.0, 0.0)).pairs;
  Matrix normal = Matrix::Zero(2, 3), tangential = normal;
  for (int i = 0; i < 2; ++i) {
    const double side = i == 0 ? 1.0 : -1.0;
    normal(i, 0) = std::sqrt(0.5), normal(i, 1) = side * std::sqrt(0.5);
    tangential(i, 0) = -side * std::sqrt(0.5), tangential(i, 1) = std::sqrt(0.5);
  }
  groove.rows = normal.sparseView();
  groove.tangents[0] = tangential.sparseView();
  for (const double part : {-1.01, -0.99, 0.0, 0.99, 1.01}) {
    groove.work << 1.0, part, 0.0;
    TEST_EQUALITY(PadModel(groove, std::vector<FrictionCone>(2)).unbalanced().size() > 0, std::abs(part) > 1.0);
  }
  // Bounds are forces per unit of size: 4 pads hold 4 times the bound.
  for (const double part : {0.99, 1.01}) {
    const Block block(3, Force(1.0, 4.0 * 0.3 * part, 0.0));
    TEST_EQUALITY(PadModel(block.pairs, std::vector<FrictionCone>(4, {0.3, 0.0})).unbalanced().size() > 0, part > 1.0);
  }
  // A block that is pulled off, and one that tips over.
  TEST_ASSERT(PadModel(Block(2, Force(-1.0, 0.0, 0.0)).pairs, std::vector<FrictionCone>(2, {0.0, mu})).unbalanced().size() > 0);
  TEST_ASSERT(PadModel(Block(2, Force(1.0, 0.5, 0.0), 1.9).pairs, std::vector<FrictionCone>(2, {0.0, mu})).unbalanced().size() == 0);
  TEST_ASSERT(PadModel(Block(2, Force(1.0, 0.5, 0.0), 2.1).pairs, std::vector<FrictionCone>(2, {0.0, mu})).unbalanced().size() > 0);
}

TEUCHOS_UNIT_TEST(PadModel, BalancesTheLoadsByForcesOfTheLaw) {
  const double mu = 0.4;
  std::mt19937 random(8);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  const Vector compliance = Vector::Constant(4, 0.5);
  int slips = 0, near = 0, all = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const double angle = M_PI * value(random), part = 0.5 * (1.0 + value(random));
    const Block block(3, Force(1.0, 0.9 * part * mu * std::cos(angle), 0.9 * part * mu * std::sin(angle)));
    Matrix t = Matrix::Zero(4, 3);
    for (int i = 0; i < 4; ++i) t(i, 0) = 0.3 * value(random), t(i, 1) = value(random), t(i, 2) = value(random);
    const PadModel::Equilibrium found = PadModel(block.pairs, std::vector<FrictionCone>(4, {0.0, mu})).coulomb(t, compliance);
    TEST_ASSERT(found.found);
    Vector work = block.pairs.rows.transpose() * found.force.col(0);
    for (int k = 0; k < 2; ++k) work += block.pairs.tangents[static_cast<std::size_t>(k)].transpose() * found.force.col(k + 1);
    TEST_COMPARE((work - block.pairs.work).norm(), <, 1e-8);
    for (int i = 0; i < 4; ++i) {
      // Coulomb's law: the normal force follows from the penetration, the tangential one is cut off.
      const double normal = std::max(found.trial(i, 0), 0.0), size = found.trial.row(i).tail(2).norm();
      const double held = size > 0.0 ? std::min(1.0, mu * normal / size) : 1.0;
      const double apart = std::hypot(found.force(i, 0) - normal, (found.force.row(i).tail(2) - held * found.trial.row(i).tail(2)).norm());
      near += apart < 2e-3, ++all;
      slips += held < 1.0 && normal > 0.0;
    }
  }
  TEST_COMPARE(slips, >, 20);
  // The fixed-point iteration may be cut short: its states are a guess.
  TEST_COMPARE(near, >, 9 * all / 10);
}

// A wedge in a V-groove of right angle, before it touches: the bounds of pairs without normal force would hold it where it is. It falls
// until both sides touch, and only then do bounds act: statics gives normal forces load / sqrt 2 without them, and less with them.
TEUCHOS_UNIT_TEST(PadModel, OpenPadsHoldNothing) {
  RigidBodyModel::Pairs groove;
  const double r = std::sqrt(0.5);
  groove.rows = (Matrix(2, 2) << r, r, r, -r).finished().sparseView();
  groove.tangents.emplace_back((Matrix(2, 2) << r, -r, r, r).finished().sparseView());
  groove.work = Vector::Unit(2, 0);
  groove.penetration = Vector::Constant(2, -5.0);
  groove.stiffness = Vector::Ones(2);
  groove.line = {0, 1};
  groove.canChange.assign(2, 1);
  const double bound = 0.8;  // one of them holds the wedge
  Matrix t = Matrix::Zero(2, 3);
  t.col(0) = groove.penetration;
  const PadModel model(groove, std::vector<FrictionCone>(2, {bound, 0.0}));
  const PadModel::Equilibrium hanging = model.associated(t, Vector::Ones(2)), found = model.coulomb(t, Vector::Ones(2));
  TEST_ASSERT(hanging.found);
  TEST_ASSERT(found.found);
  TEST_COMPARE(hanging.force.col(0).norm(), <, 1e-6);
  for (int i = 0; i < 2; ++i) {
    TEST_COMPARE(found.force(i, 0), >, 0.0);
    TEST_COMPARE(std::abs(found.force(i, 1)), <=, bound + 1e-12);
  }
  Vector work = groove.rows.transpose() * found.force.col(0) + groove.tangents[0].transpose() * found.force.col(1);
  TEST_COMPARE((work - groove.work).norm(), <, 1e-8);
}

TEUCHOS_UNIT_TEST(PadModel, DistributesTheForceOfWalls) {
  // The distance between the walls is 0.3 less than the total length of the bodies; pads in series carry equal forces.
  const int bodies = 5;
  const Vector compliance = Vector::LinSpaced(bodies + 1, 1.0, 6.0).cwiseInverse();
  const PadModel::Equilibrium found =
      PadModel::unilateral(padsInARow(bodies), Vector::Zero(bodies), Vector::Constant(bodies + 1, 0.05), compliance);
  TEST_ASSERT(found.found);
  TEST_COMPARE((found.force.col(0).array() - 0.3 / compliance.sum()).abs().maxCoeff(), <, 1e-9);
}

TEUCHOS_UNIT_TEST(PadModel, MovesUnloadedBodiesApart) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const int motions : {3, 12, 60}) {
    const SparseRows rows = Matrix::NullaryExpr(4 * motions, motions, [&] { return uniform(random); }).sparseView();
    const Vector room = Vector::NullaryExpr(4 * motions, [&] { return std::max(uniform(random), 0.0); });  // half of the pads just touch
    const Vector there = Vector::NullaryExpr(motions, [&] { return uniform(random); });
    const Vector start = -rows * there - room, compliance = Vector::Ones(4 * motions);
    const PadModel::Equilibrium found = PadModel::unilateral(rows, Vector::Zero(motions), start, compliance);
    TEST_ASSERT(found.found);
    const Vector at = start + rows * found.motion;
    TEST_COMPARE(at.maxCoeff(), <, 1e-9 * start.maxCoeff());
    TEST_COMPARE((at - found.trial.col(0)).cwiseAbs().maxCoeff(), <, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(PadModel, ReportsALoadThatNoPadStops) {
  const SparseRows rows = Matrix::Constant(1, 1, 1.0).sparseView();
  const Vector compliance = Vector::Ones(1), away = Vector::Constant(1, -1.0), against = Vector::Constant(1, 1.0);
  TEST_ASSERT(!PadModel::unilateral(rows, away, Vector::Constant(1, 0.5), compliance).found);
  const PadModel::Equilibrium found = PadModel::unilateral(rows, against, Vector::Constant(1, -0.5), compliance);
  TEST_ASSERT(found.found);
  TEST_FLOATING_EQUALITY(found.motion(0), 1.5, 1e-9);
}

// A body rests on a soft pad beside a stiff one that presses the other way: forces of the soft pad balance the load, however soft it is.
TEUCHOS_UNIT_TEST(PadModel, SoftPadsBalanceLoadsBesideStiffOnes) {
  for (const double soft : {1.0, 1e-3, 1e-6, 1e-9}) {
    RigidBodyModel::Pairs pairs;
    pairs.rows = (Matrix(2, 1) << 1.0, -1.0).finished().sparseView();
    pairs.penetration = Vector::Zero(2);
    pairs.stiffness = (Vector(2) << soft, 1.0).finished();
    pairs.line = {0, 1};
    pairs.canChange = {1, 1};
    pairs.work = Vector::Constant(1, 1.0);
    TEST_EQUALITY(PadModel(pairs, std::vector<FrictionCone>(2)).unbalanced().size(), 0);
    pairs.rows.coeffRef(1, 0) = 1.0;  // both press the same way
    pairs.work = Vector::Constant(1, -1.0);
    TEST_EQUALITY(PadModel(pairs, std::vector<FrictionCone>(2)).unbalanced().size(), 1);
  }
}

TEUCHOS_UNIT_TEST(PadModel, LeavesTheLeastRemainder) {
  std::mt19937 random(7);
  std::normal_distribution<double> value;
  for (int scene = 0; scene < 200; ++scene) {
    const int motions = 2 + scene % 9, pairs = 1 + scene % 13;
    const SparseRows rows = Matrix::NullaryExpr(pairs, motions, [&] { return value(random); }).sparseView();
    const Vector work = Vector::NullaryExpr(motions, [&] { return value(random); });
    const Vector force = PadModel::leastRemainder(rows, work);
    TEST_EQUALITY(force.size(), pairs);
    TEST_COMPARE(force.minCoeff(), >=, 0.0);
    const Vector rest = work - rows.transpose() * force,
                 least = work - rows.transpose() * nonnegativeLeastSquares(Matrix(rows).transpose(), work);
    TEST_COMPARE((rest - least).norm(), <=, 1e-5 * work.norm());
  }
}

}  // namespace
