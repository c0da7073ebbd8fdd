#include <Teuchos_UnitTestHarness.hpp>
#include <precond/CoarseElementsOf.hpp>
#include <suture/base/Buffer.hpp>

namespace suture {
namespace {

using namespace blocks;

/// Subdomains of a body, and its stiffness by dense assembly.
struct Body {
  Scene scene = clampedSquare(3, 2);
  Blocks spread{scene, world()}, single{scene, alone()};
  Dense whole{single};
};

TEUCHOS_UNIT_TEST(CoarseElement, TheirSumIsTheMatrixOfTheWhole) {
  const Body body;
  CoarseElements all = coarseElementsOf(body.single, body.whole);
  for (CoarseElement& element : all.elements) {  // unknowns need not ascend
    std::reverse(element.unknowns.begin(), element.unknowns.end());
    element.matrix = element.matrix.reverse().eval();
  }
  const SparseMatrix sum = assembleCoarseElements(all.size, all.elements);
  TEST_ASSERT(sum.isCompressed());
  TEST_COMPARE(difference(Matrix(sum), body.whole.stiffness), <, 1e-15);
  TEST_EQUALITY(Matrix(sum), Matrix(sum.transpose()));  // to the last bit
  TEST_EQUALITY(assembleCoarseElements(0, {}).size(), 0);
}

TEUCHOS_UNIT_TEST(CoarseElement, SurvivesAMessage) {
  const Body body;
  const CoarseElements mine = coarseElementsOf(body.single, body.whole);
  Packer packer;
  for (const CoarseElement& element : mine.elements) pack(element, packer);
  Unpacker unpacker(packer.bytes());
  for (const CoarseElement& element : mine.elements) {
    const CoarseElement found = unpackCoarseElement(unpacker);
    TEST_EQUALITY(found.id, element.id);
    TEST_ASSERT(found.unknowns == element.unknowns);
    TEST_EQUALITY(found.matrix, Matrix(element.matrix.selfadjointView<Eigen::Lower>()));
  }
  TEST_ASSERT(unpacker.done());
}

TEUCHOS_UNIT_TEST(CoarseElement, OfAllRanksAreThoseOfOneRankInTheSameOrder) {
  const Body body;
  const CoarseElements all = coarseElementsOf(body.single, body.whole), mine = coarseElementsOf(body.spread, body.whole);
  for (const bool everywhere : {true, false}) {
    const std::vector<CoarseElement> found = gatherCoarseElements(*world(), mine.elements, everywhere);
    if (!everywhere && world()->getRank() > 0) {
      TEST_ASSERT(found.empty());
      continue;
    }
    TEST_EQUALITY(found.size(), all.elements.size());
    // hence their sum is the same on any number of ranks, to the last bit
    TEST_EQUALITY(Matrix(assembleCoarseElements(all.size, found)), Matrix(assembleCoarseElements(all.size, all.elements)));
  }
}

}  // namespace
}  // namespace suture
