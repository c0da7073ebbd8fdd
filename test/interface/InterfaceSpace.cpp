#include <Teuchos_UnitTestHarness.hpp>
#include <interface/Interfaces.hpp>

namespace suture {
namespace {

using namespace blocks;

TEUCHOS_UNIT_TEST(InterfaceSpace, HasTheSameUnknownsOnAnyNumberOfRanks) {
  const Twins t(loadedRectangle());
  // seams: one of 10 nodes along, two of 7 across, 2 crossings counted once; one node held on the left
  TEST_EQUALITY(t.spread.space->size(), 2 * (10 + 2 * 7 - 2 - 1));
  TEST_EQUALITY(t.single.space->size(), t.spread.space->size());
  const Twins c(pressedBlocks());
  TEST_EQUALITY(c.spread.space->size(), 2 * (2 * 7 + 2));  // y = -1/2, 1/2 and a free node of the seam beyond each
  TEST_EQUALITY(c.single.space->size(), c.spread.space->size());
}

TEUCHOS_UNIT_TEST(InterfaceSpace, KnowsWhereItsUnknownsAre) {
  const Twins t(loadedRectangle());
  for (std::size_t i = 0; i < t.spread.overlap.size(); ++i) {
    const GlobalId unknown = t.spread.overlap[i];
    TEST_EQUALITY(t.spread.space->component(int(i)), int(unknown % 2));
    const Point expected = t.spread.scene.mesh.point(int(unknown / 2)), found = t.spread.space->point(int(i));
    for (int k = 0; k < 3; ++k) TEST_EQUALITY(found[k], expected[k]);
  }
}

TEUCHOS_UNIT_TEST(InterfaceSpace, GatherIsTheTransposeOfScatterAdd) {
  const Twins t(loadedRectangle());
  const InterfaceSpace& space = *t.spread.space;
  const MultiVectorPtr x = t.toSpread(random(t.size(), 1, 3));
  Matrix seen;
  space.gather(*x, seen);
  TEST_EQUALITY(seen.rows(), int(t.spread.overlap.size()));
  for (std::size_t i = 0; i < t.spread.overlap.size(); ++i)
    TEST_FLOATING_EQUALITY(seen(i, 0), random(t.size(), 1, 3)(t.place(t.spread.overlap[i]), 0), 1e-14);
  const Matrix other = random(int(seen.rows()), 1, 11 + world()->getRank());
  const MultiVectorPtr y = space.vector();
  space.scatterAdd(other, *y);
  double mine = other.col(0).dot(seen.col(0)), sum = 0.0;
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(sum));
  TEST_FLOATING_EQUALITY(dot(*x, *y), sum, 1e-12);
}

TEUCHOS_UNIT_TEST(InterfaceSpace, SumsCountTheLocalProblemsThatMeet) {
  const Twins t(loadedRectangle());
  const InterfaceSpace& space = *t.spread.space;
  Matrix count = Matrix::Zero(int(t.spread.overlap.size()), 1);
  for (int i = 0; i < space.locals(); ++i) space.coupling(i).addTransposed(Matrix::Ones(space.coupling(i).rows(), 1), count);
  space.sum(count);
  for (std::size_t i = 0; i < t.spread.overlap.size(); ++i) {
    const Point p = space.point(int(i));
    const bool crossing = p[1] == 1.0 && (p[0] == 1.0 || p[0] == 2.0);
    TEST_EQUALITY(count(i, 0), crossing ? 4.0 : 2.0);
  }
}

}  // namespace
}  // namespace suture
