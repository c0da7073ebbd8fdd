// Heap memory that an iteration of the inner solver takes: nothing that grows with the problem.
#include <suture/algebra/AlignedVector.hpp>
#include <suture/interface/CondensedProblem.hpp>
#include <suture/solver/InnerSolver.hpp>

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
  double unknowns = 0.0;   // unknowns of all ranks
  double messages = 0.0;   // unknowns shared with other ranks and not owned, the most of all ranks
  double coarse = 0.0;     // bytes of the coarse unknowns, where several ranks sum them up
};

Found inner(const InterfaceProblem& problem, const std::vector<std::string>& preconditioner) {
  const InterfaceProblem::Linearisation linear = problem.linearise(problem.initialState());
  const Teuchos::RCP<Preconditioner> made = makePreconditioner(resolved("Preconditioner", preconditionerSchema(), preconditioner));
  made->initialize(linear.matrix->space());
  made->compute(linear.matrix);
  const MultiVectorPtr x = problem.space()->vector();
  Monitor silent;
  const auto bytes = [&](int iterations) {
    InnerSolver solver(iterations);
    const long long before = taken;
    solver.solve(linear.matrix, made, *linear.load, *x, 0.0, 0.0, silent);
    return static_cast<double>(taken - before);
  };
  bytes(6);  // makes what is kept
  const InterfaceSpace& space = *problem.space();
  const double own = sizeof(double) * static_cast<double>(space.map()->getNodeNumElements()), all = sizeof(double) * space.overlapSize();
  const double mine[2] = {(bytes(6) - bytes(2)) / 4.0, all - own};
  double most[2];
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_MAX, 2, mine, most);
  const double coarse = world()->getSize() > 1 ? sizeof(double) * static_cast<double>(made->coarseSize()) : 0.0;
  return {most[0], static_cast<double>(space.size()), most[1], coarse};
}

Found onInterface(const std::vector<std::string>& preconditioner, const std::string& schur, int blocks, int cells) {
  Scene scene = clampedSquare(blocks, cells);
  scene.model.loads.push_back({Load::Kind::BodyForce, "", {0.3, -1.0, 0}});
  const OnInterface one(scene, world(), schur);
  return inner(one.problem, preconditioner);
}

// A contact group of four subdomains beside four others; every second pair closed.
Found inGroups(const std::string& preconditioner, int refinement) {
  const Scene scene = pressed(wavyBlocks(twoBoxes(6 * refinement, 4 * refinement, 2, 2)));
  const Blocks all(scene, world());
  const CondensedProblem problem(world(), all.partition, all.subdomains, localSolver(), schurOf());
  return inner(problem, {"Type=" + preconditioner});
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

// Views of vectors; and MPI keeps messages until they are taken (found: once what they are longer), and room for the sums of coarse
// unknowns (once or twice each).
bool takesNoMore(const Found& small, const Found& large, std::ostream& out) {
  out << small.iteration << " and " << large.iteration << " bytes an iteration, " << small.unknowns << " and " << large.unknowns
      << " unknowns, messages of " << small.messages << " and " << large.messages << ", coarse " << small.coarse << " and " << large.coarse
      << "\n";
  return large.iteration < 1.1 * small.iteration + 256.0 + 2.0 * (large.messages - small.messages) + 2.0 * (large.coarse - small.coarse);
}

TEUCHOS_UNIT_TEST(InnerLoop, TakesNothingThatGrowsWithTheProblem) {
  using Case = std::pair<std::string, std::string>;  // preconditioner, Schur complements
  for (const auto& [name, schur] : {Case("BDDC", "Explicit"), Case("Neumann-Neumann", "Explicit"), Case("BDDC", "Implicit")}) {
    out << name << ", " << schur << ": ";
    const Found small = onInterface({"Type=" + name}, schur, 4, 8), large = onInterface({"Type=" + name}, schur, 4, 64);
    TEST_ASSERT(takesNoMore(small, large, out));
    TEST_COMPARE(large.unknowns, >, 8.0 * small.unknowns);
  }
}

TEUCHOS_UNIT_TEST(InnerLoop, TakesNothingThatGrowsWithContactGroups) {
  for (const char* name : {"BDDC", "Neumann-Neumann"}) {
    out << name << ": ";
    const Found small = inGroups(name, 2), large = inGroups(name, 16);
    TEST_ASSERT(takesNoMore(small, large, out));
    TEST_COMPARE(large.unknowns, >, 5.0 * small.unknowns);
  }
}

// Four clusters of more and more subdomains.
TEUCHOS_UNIT_TEST(InnerLoop, TakesNothingThatGrowsWithTheCoarseLevel) {
  const std::vector<std::string> settings{"Type=BDDC", "BDDC/Coarse Level Above=1", "BDDC/Coarse Clusters=4",
                                          "BDDC/Coarse Accuracy=0.9"};  // one step for both: each makes views of vectors
  const Found small = onInterface(settings, "Explicit", 6, 3), large = onInterface(settings, "Explicit", 24, 3);
  TEST_ASSERT(takesNoMore(small, large, out));
  TEST_COMPARE(large.unknowns, >, 8.0 * small.unknowns);
}

}  // namespace
}  // namespace suture
