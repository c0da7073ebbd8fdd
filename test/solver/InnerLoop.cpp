// What an iteration of the inner solver takes from the heap: nothing that grows with the problem.
#include <suture/solver/InnerSolver.hpp>
#include <suture/subdomain/AlignedVector.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_MultiVector.hpp>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <solver/ContactMethods.hpp>

// glibc's functions under their other names; what this program defines serves its libraries, too, and operator new calls it. Pieces of
// AlignedVector beyond 32 kB come from mmap and are not seen: matrices, which are made before, and kernelSpace(), which never shrinks.
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* __libc_calloc(std::size_t count, std::size_t size);
extern "C" void* __libc_realloc(void* at, std::size_t size);
extern "C" void* __libc_memalign(std::size_t alignment, std::size_t size);

namespace {
std::atomic<long long> taken{0};
}

extern "C" {
void* malloc(std::size_t size) {
  taken += static_cast<long long>(size);
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  taken += static_cast<long long>(count * size);
  return __libc_calloc(count, size);
}
void* realloc(void* at, std::size_t size) {
  taken += static_cast<long long>(size);
  return __libc_realloc(at, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  taken += static_cast<long long>(size);
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** at, std::size_t alignment, std::size_t size) {
  *at = aligned_alloc(alignment, size);
  return *at == nullptr ? ENOMEM : 0;
}
}

namespace suture {
namespace {

using namespace blocks;

struct Found {
  double iteration = 0.0;  // bytes taken in one, the most of all ranks
  double unknowns = 0.0;   // of all ranks
  double messages = 0.0;   // of the unknowns that it shares with other ranks and does not own, the most of all ranks
};

Found inner(const std::string& name, const std::string& schur, int cells) {
  Scene scene = clampedSquare(4, cells);
  scene.model.loads.push_back({Load::Kind::BodyForce, "", {0.3, -1.0, 0}});
  const OnInterface one(scene, world(), schur);
  const InterfaceProblem::Linearisation linear = one.problem.linearise(one.problem.initialState());
  const Teuchos::RCP<Preconditioner> made = preconditioner(name)();
  made->initialize(linear.matrix->space());
  made->compute(linear.matrix);
  const MultiVectorPtr x = one.problem.space()->vector();
  Monitor silent;
  const auto bytes = [&](int iterations) {
    InnerSolver solver(iterations);
    const long long before = taken;
    solver.solve(linear.matrix, made, *linear.load, *x, 0.0, 0.0, silent);
    return static_cast<double>(taken - before);
  };
  bytes(6);  // makes what is kept
  const InterfaceSpace& space = *one.problem.space();
  const double own = sizeof(double) * static_cast<double>(space.map()->getNodeNumElements()), all = sizeof(double) * space.overlapSize();
  const double mine[2] = {(bytes(6) - bytes(2)) / 4.0, all - own};
  double most[2];
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_MAX, 2, mine, most);
  return {most[0], static_cast<double>(space.size()), most[1]};
}

TEUCHOS_UNIT_TEST(InnerLoop, SeesWhatVectorsTake) {
  const std::size_t size = 3000;
  const MapPtr map = Teuchos::rcp(new Map(size, 0, world(), Tpetra::LocallyReplicated));
  const auto bytes = [](const auto& make) {
    const long long before = taken;
    make();
    return static_cast<double>(taken - before);
  };
  TEST_COMPARE(bytes([&] { MultiVector(map, 1); }), >=, 8.0 * size);
  TEST_COMPARE(bytes([&] { Matrix::Zero(size, 1).eval(); }), >=, 8.0 * size);
  TEST_COMPARE(bytes([&] { std::vector<double> values(size); }), >=, 8.0 * size);
  TEST_COMPARE(bytes([&] { AlignedVector<double> values(size); }), >=, 8.0 * size);
}

TEUCHOS_UNIT_TEST(InnerLoop, TakesNothingThatGrowsWithTheProblem) {
  using Case = std::pair<std::string, std::string>;  // preconditioner, Schur complements
  for (const auto& [name, schur] : {Case("BDDC", "Explicit"), Case("Neumann-Neumann", "Explicit"), Case("BDDC", "Implicit")}) {
    const Found small = inner(name, schur, 8), large = inner(name, schur, 64);
    out << name << ", " << schur << ": " << small.iteration << " and " << large.iteration << " bytes an iteration, " << small.unknowns
        << " and " << large.unknowns << " unknowns, messages of " << small.messages << " and " << large.messages << "\n";
    // Views of vectors; and MPI keeps messages until they are taken (found: once what they are longer).
    TEST_COMPARE(large.iteration, <, 1.1 * small.iteration + 256.0 + 2.0 * (large.messages - small.messages));
    TEST_COMPARE(large.unknowns, >, 8.0 * small.unknowns);
  }
}

}  // namespace
}  // namespace suture
