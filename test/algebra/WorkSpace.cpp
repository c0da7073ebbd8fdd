#include <Teuchos_UnitTestHarness.hpp>
#include <suture/algebra/WorkSpace.hpp>

#include <thread>

namespace suture {
namespace {

TEUCHOS_UNIT_TEST(WorkSpace, ASingleColumnUsesTheKeptMemory) {
  std::vector<double> kept;
  const WorkSpace large(100, 1, kept);
  TEST_EQUALITY(large.values.rows(), 100);
  TEST_EQUALITY(large.values.data(), kept.data());
  const std::size_t size = kept.size();
  for (const int rows : {100, 7, 0}) {  // neither reallocated nor shrunk
    const WorkSpace again(rows, 1, kept);
    TEST_EQUALITY(again.values.rows(), rows);
    TEST_EQUALITY(again.values.data(), kept.data());
    TEST_EQUALITY(kept.size(), size);
  }
}

TEUCHOS_UNIT_TEST(WorkSpace, SeveralColumnsAreAllocatedSeparately) {
  std::vector<double> kept(3, 5.0);
  WorkSpace first(40, 3, kept), second(40, 3, kept);
  first.values.setConstant(1.0);
  second.values.setConstant(2.0);
  TEST_EQUALITY(first.values.sum(), 120.0);
  TEST_EQUALITY(second.values.sum(), 240.0);
  TEST_EQUALITY(kept.size(), std::size_t(3));
  TEST_EQUALITY(kept[0], 5.0);
}

TEUCHOS_UNIT_TEST(WorkSpace, KernelsOfAThreadShareOnePiece) {
  double* const here = kernelSpace<double>(500);
  TEST_EQUALITY(kernelSpace<double>(20), here);
  TEST_INEQUALITY(static_cast<void*>(kernelSpace<float>(20)), static_cast<void*>(here));
  double* there = nullptr;
  std::thread([&there] { there = kernelSpace<double>(500); }).join();
  TEST_INEQUALITY(there, here);
}

}  // namespace
}  // namespace suture
