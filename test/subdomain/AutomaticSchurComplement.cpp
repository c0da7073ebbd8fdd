#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/subdomain/AutomaticSchurComplement.hpp>
#include <suture/subdomain/SubdomainProblem.hpp>

namespace suture {
namespace {

using namespace blocks;

// The square's only subdomain with some boundary, stored as Automatic chooses.
struct Chosen {
  Scene scene = blocks::square(1, 12, 1.0);
  std::unique_ptr<Blocks> all;
  std::vector<int> boundary;
  AutomaticSchurComplement schur;

  Chosen(int iterations, double megabytes, bool everything = false) : schur(iterations, megabytes) {
    scene.hold("body_left", 0, 0.0);
    scene.hold("body_left", 1, 0.0);
    scene.pressure("body_top", 2.0);
    all = std::make_unique<Blocks>(scene, alone());
    const Subdomain& s = *all->subdomains[0];
    for (int dof = 0; dof < s.dofs(); ++dof)
      if (everything ? dof > 1 : s.mesh().point(s.nodeOf(dof))[0] == 1.0) boundary.push_back(dof);
    const std::vector<int> nodes = nodesOfDofs(s);
    schur.compute({s.stiffness(), s.load(), boundary, nodes, placesOfDofs(s), localSolver(), "it"});
  }
};

TEUCHOS_UNIT_TEST(AutomaticSchurComplement, IsExplicitWhereThatPays) {
  TEST_EQUALITY(Chosen(40, 256.0).schur.chosen(), "Explicit");
  TEST_ASSERT(Chosen(40, 256.0).schur.dense() != nullptr);
  TEST_EQUALITY(Chosen(40, 1e-4).schur.chosen(), "Implicit");        // no memory for it
  TEST_EQUALITY(Chosen(1, 256.0, true).schur.chosen(), "Implicit");  // nearly all unknowns on the boundary, one application
}

TEUCHOS_UNIT_TEST(AutomaticSchurComplement, IsTheSameEitherWay) {
  const Chosen dense(40, 256.0), sparse(40, 1e-4);
  const int n = static_cast<int>(dense.boundary.size());
  Matrix a(n, n), b(n, n);
  dense.schur.apply(Matrix::Identity(n, n), a);
  sparse.schur.apply(Matrix::Identity(n, n), b);
  TEST_COMPARE(difference(a, b), <, 1e-12);
  TEST_COMPARE(difference(dense.schur.condensedLoad(), sparse.schur.condensedLoad()), <, 1e-12);
  const Vector trace = random(n, 1).col(0);
  TEST_COMPARE(difference(dense.schur.recover(trace), sparse.schur.recover(trace)), <, 1e-11);
  TEST_FLOATING_EQUALITY(dense.schur.interiorEnergy(), sparse.schur.interiorEnergy(), 1e-11);
  TEST_COMPARE(dense.schur.bytesRead(), >, 0.0);
}

}  // namespace
}  // namespace suture
