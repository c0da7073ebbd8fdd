#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/subdomain/ExplicitSchurComplement.hpp>
#include <suture/subdomain/SubdomainProblem.hpp>

namespace suture {
namespace {

using namespace blocks;

SubdomainProblem problemOf(const Subdomain& subdomain, const std::string& schur, const std::string& solver = "CHOLMOD") {
  return {7, subdomain, sharedDofs(subdomain), localSolver(solver), schurComplement(schur)};
}

// 3 x 3 blocks of 6 x 6 cells, the left side moved, loaded: held and floating subdomains, one without a free side.
Scene loaded(double young) {
  Scene scene = square(3, 6, young);
  scene.hold("body_left", 0, 0.01);
  scene.hold("body_left", 1, -0.02);
  scene.pressure("body_top", 3.0);
  scene.model.loads.push_back({Load::Kind::BodyForce, "", {0.5, -2.0, 0}});
  return scene;
}

TEUCHOS_UNIT_TEST(ExplicitSchurComplement, EqualsTheImplicitOne) {
  for (const double young : {2e3, 2e11}) {
    const Scene scene = loaded(young);
    const Blocks all(scene, alone());
    for (const auto& subdomain : all.subdomains)
      for (const char* solver : {"CHOLMOD", "Amesos2"}) {
        const SubdomainProblem own = problemOf(*subdomain, "Explicit", solver), other = problemOf(*subdomain, "Implicit", solver);
        const int n = own.size();
        Matrix a(n, n), b(n, n);
        own.applySchur(Matrix::Identity(n, n), a);
        other.applySchur(Matrix::Identity(n, n), b);
        TEST_COMPARE(difference(a, b), <, 1e-12);
        TEST_EQUALITY((a - a.transpose()).norm(), 0.0);
        TEST_COMPARE(difference(own.schur(), b), <, 1e-12);
        TEST_COMPARE(difference(own.condensedLoad(), other.condensedLoad()), <, 1e-12);
        TEST_FLOATING_EQUALITY(own.constantEnergy(), other.constantEnergy(), 1e-11);
        const Vector trace = random(n, 1, 5).col(0);
        TEST_COMPARE(difference(own.recover(trace), other.recover(trace)), <, 1e-12);
        TEST_EQUALITY(difference(rowsAt(own.recover(trace), sharedDofs(*subdomain)), trace), 0.0);
      }
  }
}

// A body that only soft springs hold: interiors are recovered although its pivots are too small for a factor in single precision.
TEUCHOS_UNIT_TEST(ExplicitSchurComplement, RecoversBodiesOnVerySoftSprings) {
  const Blocks all(square(1, 6, 2e3), alone());
  Matrix dense = all.subdomains[0]->stiffness().dense();
  const int n = static_cast<int>(dense.rows());
  const Vector load = random(n, 1, 3).col(0), other = random(n, 1, 4).col(0);
  const std::vector<int> boundary{0}, interior = complement(n, boundary);
  const std::vector<Point> places(static_cast<std::size_t>(n), Point{0, 0, 0});
  std::vector<int> nodes(static_cast<std::size_t>(n), 0);
  for (int i = 0; i < n; ++i) nodes[static_cast<std::size_t>(i)] = i / 2;
  for (const double spring : {1e-2, 1e-6, 1e-10, 1e-11}) {
    Matrix held = dense;
    held.diagonal().array() += spring;
    const SymmetricMatrix stiffness(SparseMatrix(held.sparseView()));
    ExplicitSchurComplement schur;
    Vector now = load;
    const SchurData data{stiffness, now, boundary, nodes, places, localSolver("CHOLMOD"), "body", 2};
    schur.compute(data);
    for (const Vector& next : {load, other}) {
      now = next;
      schur.reload(data);
      const Vector x = schur.recover(Vector::Constant(1, 0.3));
      TEST_EQUALITY(x(0), 0.3);
      const Vector rest = (now - held * x)(interior);
      TEST_COMPARE(rest.norm(), <, 1e-13 * held.norm() * x.norm());
    }
  }
}

TEUCHOS_UNIT_TEST(ExplicitSchurComplement, VanishesOnRigidMotionsToRoundOff) {
  const Scene scene = loaded(2e11);
  const Blocks all(scene, alone());
  int floating = 0;
  for (const auto& subdomain : all.subdomains) {
    const SubdomainProblem one = problemOf(*subdomain, "Explicit");
    const Matrix& kernel = one.kernel();
    floating += kernel.cols() == 3;
    if (kernel.cols() == 0) continue;
    const Matrix s = one.schur();
    const Matrix flux = s * kernel;
    TEST_COMPARE(flux.norm(), <, 1e-14 * s.norm() * kernel.norm());
    const Vector values = eigenvalues(s);
    TEST_COMPARE(values(3), >, 1e-3 * values(values.size() - 1));  // and on nothing else
  }
  TEST_EQUALITY(floating, 6);
}

TEUCHOS_UNIT_TEST(ExplicitSchurComplement, CountsItsApplications) {
  const Scene scene = loaded(1.0);
  const Blocks all(scene, alone());
  const auto schur = schurComplement("Explicit");
  const Subdomain& s = *all.subdomains[4];
  const std::vector<int> boundary = sharedDofs(s), nodes = nodesOfDofs(s);
  schur->compute({s.stiffness(), s.load(), boundary, nodes, placesOfDofs(s), localSolver(), "it"});
  const int n = int(boundary.size());
  Matrix flux(n, 2);
  schur->apply(random(n, 2), flux);
  TEST_EQUALITY(schur->applications(), 1);
  TEST_ASSERT(schur->dense() != nullptr);
  TEST_COMPARE(difference(flux, schur->dense()->full() * random(n, 2)), <, 1e-14);
}

}  // namespace
}  // namespace suture
