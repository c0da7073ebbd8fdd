#include <Teuchos_UnitTestHarness.hpp>
#include <interface/Interfaces.hpp>

namespace suture {
namespace {

using namespace blocks;

TEUCHOS_UNIT_TEST(InterfaceOperator, IsTheSchurComplementOfTheWholeBody) {
  const Scene scene = loadedRectangle();
  const Twins t(scene);
  const Blocks uncut(scene, alone(), 1);
  const Dense body(uncut);
  Vector load;
  const Matrix expected = denseSchur(body.stiffness, body.places(t.single.overlap), body.load, &load);
  const Matrix s = t.toDense(static_cast<const Operator&>(t.spread.matrix()));
  TEST_COMPARE(difference(s, expected), <, 1e-12);
  TEST_COMPARE(difference(t.toDense(*t.spread.linearised.load), load), <, 1e-12);
  TEST_COMPARE(difference(s, s.transpose()), <, 1e-13);
  TEST_COMPARE(eigenvalues(0.5 * (s + s.transpose()))(0), >, 0.0);
  // the solution on the interface is that of the whole body
  const Vector u = solveSymmetric(body.stiffness, body.load);
  TEST_COMPARE(difference(solveSymmetric(s, t.toDense(*t.spread.matrix().condensedLoad())), rowsAt(u, body.places(t.single.overlap))), <,
               1e-10);
}

TEUCHOS_UNIT_TEST(InterfaceOperator, IsTheSameOnAnyNumberOfRanksWithContact) {
  const Twins t(pressedBlocks());
  const Matrix s = t.toDense(static_cast<const Operator&>(t.spread.matrix()));
  const MultiVectorPtr x = t.toSingle(Matrix::Identity(t.size(), t.size())), y = t.single.space->vector(t.size());
  t.single.matrix().apply(*x, *y);
  const Matrix expected = t.toDenseSingle(*y);
  TEST_COMPARE(difference(s, expected), <, 1e-12);
  TEST_COMPARE(difference(s, s.transpose()), <, 1e-12);
  TEST_COMPARE(eigenvalues(0.5 * (s + s.transpose()))(0), >, 0.0);
}

TEUCHOS_UNIT_TEST(InterfaceOperator, ScalesAndAdds) {
  const Twins t(loadedRectangle());
  const Matrix x = random(t.size(), 2, 1), y = random(t.size(), 2, 2);
  const Matrix s = t.toDense(static_cast<const Operator&>(t.spread.matrix()));
  for (double alpha : {1.0, -0.5})
    for (double beta : {0.0, 2.0}) {
      const MultiVectorPtr result = t.toSpread(y);
      t.spread.matrix().apply(*t.toSpread(x), *result, Teuchos::NO_TRANS, alpha, beta);
      TEST_COMPARE(difference(t.toDense(*result), alpha * s * x + beta * y), <, 1e-12);
    }
}

TEUCHOS_UNIT_TEST(InterfaceOperator, CountsItsApplications) {
  const Twins t(loadedRectangle());
  const long long before = t.spread.matrix().applications();
  const MultiVectorPtr x = t.spread.space->vector(3), y = t.spread.space->vector(3);
  t.spread.matrix().apply(*x, *y);
  TEST_EQUALITY(t.spread.matrix().applications() - before, 3);
}

TEUCHOS_UNIT_TEST(InterfaceOperator, OfASubsetLeavesItsOtherUnknownsUntouched) {
  const Twins t(loadedRectangle());
  TEST_EQUALITY(t.spread.matrix().untouched(), 0);
  LocalProblems some = t.spread.matrix().locals();
  std::set<GlobalId> touched;
  for (auto& local : some)
    if (local->id() != 0 && local->id() != 5) local.reset();
  for (const auto& local : t.single.matrix().locals())
    if (local->id() == 0 || local->id() == 5) touched.insert(local->boundary().begin(), local->boundary().end());
  const InterfaceOperator part(t.spread.space, some);
  TEST_EQUALITY(part.untouched(), t.spread.space->size() - GlobalId(touched.size()));
  Matrix expected = Matrix::Zero(t.size(), t.size());
  for (const auto& local : t.single.matrix().locals())
    if (local->id() == 0 || local->id() == 5) {
      const Matrix s = local->schurBlock(range(local->size()));
      for (int i = 0; i < local->size(); ++i)
        for (int j = 0; j < local->size(); ++j) expected(t.place(local->boundary()[i]), t.place(local->boundary()[j])) += s(i, j);
    }
  TEST_COMPARE(difference(t.toDense(static_cast<const Operator&>(part)), expected), <, 1e-12);
}

}  // namespace
}  // namespace suture
