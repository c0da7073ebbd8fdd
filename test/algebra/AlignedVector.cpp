// Memory for kernels: it is aligned, pieces do not overlap, and freed memory is returned to the system.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/algebra/dense/AlignedVector.hpp>

#include <cstdint>
#include <fstream>
#include <random>
#include <thread>

namespace suture {
namespace {

// Resident bytes of this process.
double resident() {
  std::ifstream file("/proc/self/statm");
  double all = 0.0, pages = 0.0;
  file >> all >> pages;
  return 4096.0 * pages;
}

// Allocates and frees vectors in random order, each filled with a different number. Returns how many were corrupted.
int mistakes(unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<AlignedVector<double>> kept(40);
  int wrong = 0;
  for (int step = 0; step < 600; ++step) {
    const std::size_t k = generator() % kept.size();
    for (const double value : kept[k]) wrong += value != static_cast<double>(k);
    const std::size_t size = generator() % 2 == 0 ? generator() % 100 : generator() % 150000;
    kept[k] = AlignedVector<double>(size, static_cast<double>(k));
    if (size > 0) wrong += reinterpret_cast<std::uintptr_t>(kept[k].data()) % 64 != 0;
  }
  return wrong;
}

TEUCHOS_UNIT_TEST(AlignedVector, PiecesAreAlignedAndDoNotOverlap) { TEST_EQUALITY(mistakes(1), 0); }

TEUCHOS_UNIT_TEST(AlignedVector, ServesSeveralThreads) {
  int wrong[3];
  std::vector<std::thread> threads;
  for (int k = 0; k < 3; ++k) threads.emplace_back([&wrong, k] { wrong[k] = mistakes(10 + k); });
  for (std::thread& thread : threads) thread.join();
  for (const int of : wrong) TEST_EQUALITY(of, 0);
}

TEUCHOS_UNIT_TEST(AlignedVector, IsAVector) {
  AlignedVector<float> values;
  values.resize(3);
  values.assign(3, 2.0F);
  for (int k = 0; k < 20000; ++k) values.push_back(static_cast<float>(k));
  const AlignedVector<float> copy = values, moved = std::move(values);
  TEST_ASSERT(copy == moved);
  TEST_EQUALITY(copy[2], 2.0F);
  TEST_EQUALITY(copy[20002], 19999.0F);
}

TEUCHOS_UNIT_TEST(AlignedVector, LargerThanAChunkIsPossible) {
  const std::size_t size = (std::size_t(1) << 23) + 1;  // doubles: 64 MiB
  AlignedVector<double> large(size, 1.0), next(7000, 2.0);
  TEST_EQUALITY(large[size - 1], 1.0);
  TEST_EQUALITY(next[0], 2.0);
}

TEUCHOS_UNIT_TEST(AlignedVector, FreedMemoryIsReturnedToTheSystem) {
  const double piece = 1 << 20;
  const int pieces = 100;
  const double before = resident();
  std::vector<AlignedVector<unsigned char>> all;
  for (int k = 0; k < pieces; ++k) all.emplace_back(static_cast<std::size_t>(piece), 1);
  TEST_COMPARE(resident() - before, >, 0.9 * pieces * piece);
  for (int k = 0; k < pieces; ++k)
    if (k % 10 != 0) AlignedVector<unsigned char>().swap(all[k]);  // every chunk keeps a few
  TEST_COMPARE(resident() - before, <, 0.3 * pieces * piece);
  for (const auto& values : all)
    if (!values.empty()) TEST_EQUALITY(static_cast<int>(values[values.size() - 1]), 1);
  all.clear();
  TEST_COMPARE(resident() - before, <, 0.05 * pieces * piece);
}

}  // namespace
}  // namespace suture
