#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_MultiVector.hpp>
#include <interface/Interfaces.hpp>
#include <interface/RecoveredPairs.hpp>

namespace suture {
namespace {

using namespace blocks;

InterfaceProblem::Evaluation at(const Interface& one, const MultiVectorPtr& trace) {
  return one.problem.evaluate({trace, one.closed.status});
}

double scale(const Matrix& values) { return values.cwiseAbs().maxCoeff(); }

TEUCHOS_UNIT_TEST(CondensedProblem, CountsPiecesAndPairs) {
  const Twins t(pressedBlocks());
  TEST_EQUALITY(t.spread.problem.pieces(), 1);
  TEST_EQUALITY(t.spread.problem.pairs(), 7);
  int closed = 0, all = 0;
  for (const auto& row : t.spread.closed.status)
    for (const ContactState& state : row) closed += state.closed();
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, closed, Teuchos::outArg(all));
  TEST_EQUALITY(all, 7);  // contact is started closed
}

TEUCHOS_UNIT_TEST(CondensedProblem, ResidualIsMinusTheGradientOfTheEnergy) {
  const Twins t(pressedBlocks());
  const double h = 1e-5;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const Matrix u = 0.03 * random(t.size(), 1, seed), d = random(t.size(), 1, seed + 20);
    const double ahead = at(t.spread, t.toSpread(u + h * d)).energy, behind = at(t.spread, t.toSpread(u - h * d)).energy;
    const Matrix residual = t.toDense(*at(t.spread, t.toSpread(u)).residual);
    TEST_COMPARE(std::abs((ahead - behind) / (2 * h) + residual.col(0).dot(d.col(0))), <, 1e-7 * residual.norm() * d.norm());
  }
}

TEUCHOS_UNIT_TEST(CondensedProblem, LinearisationIsTheDerivativeOfTheResidual) {
  const Twins t(pressedBlocks());
  const double h = 1e-6;
  int compared = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Matrix u = 0.03 * random(t.size(), 1, seed), d = random(t.size(), 1, seed + 20);
    const auto here = at(t.spread, t.toSpread(u)), ahead = at(t.spread, t.toSpread(u + h * d)),
               behind = at(t.spread, t.toSpread(u - h * d));
    int same = here.next == ahead.next && here.next == behind.next, allSame = 0;
    Teuchos::reduceAll(*world(), Teuchos::REDUCE_MIN, same, Teuchos::outArg(allSame));
    if (!allSame) continue;
    ++compared;
    const auto tangent = t.spread.problem.linearise({t.toSpread(u), here.next});
    const MultiVectorPtr product = t.spread.space->vector();
    tangent.matrix->apply(*t.toSpread(d), *product);
    const Matrix expected = (t.toDense(*behind.residual) - t.toDense(*ahead.residual)) / (2 * h);
    TEST_COMPARE(difference(t.toDense(*product), expected), <, 1e-7);
    // second difference of the energy, and the residual of the linear problem, which is exact while the status does not change
    const double big = 1e-4;
    const double second =
        (at(t.spread, t.toSpread(u + big * d)).energy - 2 * here.energy + at(t.spread, t.toSpread(u - big * d)).energy) / (big * big);
    TEST_COMPARE(std::abs(second / (t.toDense(*product).col(0).dot(d.col(0))) - 1.0), <, 1e-2);
    TEST_COMPARE(difference(t.toDense(*tangent.load), t.toDense(*here.residual)), <, 1e-10);
  }
  TEST_COMPARE(compared, >=, 3);
}

TEUCHOS_UNIT_TEST(CondensedProblem, IsTheSameOnAnyNumberOfRanks) {
  for (const Scene& scene : {pressedBlocks(), stackedBlocks(3), stackedBlocks(2)}) {
    const Twins t(scene);
    const int pairs = int(scene.constraints.pairs.size());
    TEST_EQUALITY(t.spread.problem.pairs(), pairs);
    TEST_EQUALITY(t.spread.problem.pieces(), int(scene.constraints.pieces.size()));
    TEST_EQUALITY(t.single.problem.groups().size(), scene.constraints.pieces.size());
    int mixed = 0;
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const Matrix u = 0.03 * random(t.size(), 1, seed);
      const auto a = at(t.spread, t.toSpread(u)), b = at(t.single, t.toSingle(u));
      TEST_FLOATING_EQUALITY(a.energy, b.energy, 1e-11);
      TEST_EQUALITY(a.active, b.active);
      TEST_EQUALITY(a.changed, b.changed);
      TEST_EQUALITY(a.changed, pairs - a.active);  // starting with all closed
      TEST_COMPARE(difference(t.toDense(*a.residual), t.toDenseSingle(*b.residual)), <, 1e-11);
      mixed += a.active > 0 && a.active < pairs;
    }
    TEST_COMPARE(mixed, >, 0);
  }
}

// Groups that touch each other: S_0 does not include the seam between them.
TEUCHOS_UNIT_TEST(CondensedProblem, WithoutContactTheSeamBetweenTwoGroupsIsUntouched) {
  const Twins apart(stackedBlocks(3)), touching(stackedBlocks(2));
  TEST_EQUALITY(apart.spread.problem.withoutContact()->untouched(), 0);
  TEST_EQUALITY(touching.spread.problem.withoutContact()->untouched(), 2 * 5);
}

TEUCHOS_UNIT_TEST(CondensedProblem, WithoutContactIsTheSumOverPlainSubdomains) {
  const Twins t(pressedBlocks());
  const auto plain = t.spread.problem.withoutContact();
  TEST_EQUALITY(plain->untouched(), 0);
  Matrix expected = Matrix::Zero(t.size(), t.size());
  int count = 0;
  for (const auto& local : t.single.matrix().locals()) {
    if (local->id() >= t.single.all.partition.subdomains()) continue;  // a group
    ++count;
    const Matrix s = local->schurBlock(range(local->size()));
    for (int i = 0; i < local->size(); ++i)
      for (int j = 0; j < local->size(); ++j) expected(t.place(local->boundary()[i]), t.place(local->boundary()[j])) += s(i, j);
  }
  TEST_EQUALITY(count, 4);
  TEST_COMPARE(difference(t.toDense(static_cast<const Operator&>(*plain)), expected), <, 1e-12);
}

// Newton's method by dense algebra, then every condition of the scene in Cartesian displacements.
TEUCHOS_UNIT_TEST(CondensedProblem, ItsSolutionSolvesTheScene) {
  const Twins t(pressedBlocks());
  const Interface& one = t.spread;
  InterfaceState state = one.problem.initialState();
  for (int k = 0; k < 20; ++k) {
    const auto linear = one.problem.linearise(state);
    const Matrix s = t.toDense(static_cast<const Operator&>(*linear.matrix));
    state.trace->update(1.0, *t.toSpread(solveSymmetric(s, t.toDense(*linear.load))), 1.0);
    const auto value = one.problem.evaluate(state);
    state.status = value.next;
    if (value.changed == 0) break;
  }
  const auto value = one.problem.evaluate(state);
  TEST_EQUALITY(value.changed, 0);
  TEST_COMPARE(value.active, >, 0);
  TEST_COMPARE(value.active, <, 7);
  TEST_COMPARE(t.toDense(*value.residual).norm(), <, 1e-11 * t.toDense(*one.linearised.load).norm());

  const InterfaceProblem::Recovered found = one.problem.recover(state);
  TEST_FLOATING_EQUALITY(found.energy, value.energy, 1e-11);
  double forces = 0.0, allForces = 0.0;
  for (const PairResult& pair : pairsOf(one.all, found)) {
    TEST_COMPARE(pair.gap, >, -1e-12);
    TEST_COMPARE(pair.force, >, -1e-12);
    TEST_COMPARE(std::abs(pair.gap * pair.force), <, 1e-12);
    TEST_EQUALITY(pair.force > 0.0, pair.state.closed());
    forces += pair.force;
  }
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, forces, Teuchos::outArg(allForces));
  // loads, reactions: the whole is in equilibrium
  double mine[5] = {0, 0, 0, 0, 0}, sum[5];
  for (std::size_t s = 0; s < one.all.subdomains.size(); ++s) {
    Point applied{0, 0, 0}, reactions{0, 0, 0};
    double absolute = 0.0;
    one.all.subdomains[s]->resultants(found.freeValues[s], applied, reactions, absolute);
    for (int k = 0; k < 2; ++k) {
      mine[k] += applied[k] + reactions[k];
      if (one.all.meshes[s].body == 1) mine[2 + k] += applied[k] + reactions[k];
    }
    mine[4] += absolute;
  }
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, 5, mine, sum);
  TEST_COMPARE(std::abs(sum[0]) + std::abs(sum[1]), <, 1e-11 * sum[4]);
  TEST_COMPARE(std::abs(sum[2]), <, 1e-11 * sum[4]);              // contact has no friction
  TEST_COMPARE(std::abs(sum[3] + allForces), <, 1e-11 * sum[4]);  // and carries the upper body
}

TEUCHOS_UNIT_TEST(CondensedProblem, UpdateMovesTheTrace) {
  const Twins t(loadedRectangle());
  InterfaceState state = t.spread.problem.initialState();
  TEST_EQUALITY(scale(t.toDense(*state.trace)), 0.0);
  const Matrix step = random(t.size(), 1);
  t.spread.problem.update(state, *t.toSpread(step), 0.25);
  t.spread.problem.update(state, *t.toSpread(step), 0.5);
  TEST_COMPARE(difference(t.toDense(*state.trace), 0.75 * step), <, 1e-14);
}

}  // namespace
}  // namespace suture
