#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/subdomain/SubdomainProblem.hpp>

namespace suture {
namespace {

using namespace blocks;

// A square of 2 x 2 blocks, its left side moved by given displacements, loaded on top and by its weight: two held and two floating blocks.
Scene loadedSquare(double young = 2e3) {
  Scene scene = square(2, 4, young);
  scene.hold("body_left", 0, 0.01);
  scene.hold("body_left", 1, -0.02);
  scene.pressure("body_top", 3.0);
  scene.model.loads.push_back({Load::Kind::BodyForce, "", {0.5, -2.0, 0}});
  return scene;
}

struct Case {
  const Subdomain& subdomain;
  std::vector<int> boundary;
  SubdomainProblem problem;
  explicit Case(const Subdomain& s, const std::string& solver = "CHOLMOD", const std::string& schur = "Implicit")
      : subdomain(s), boundary(sharedDofs(s)), problem(7, s, boundary, localSolver(solver), schurComplement(schur)) {}
  Matrix applied() const {
    Matrix flux(problem.size(), problem.size());
    problem.applySchur(Matrix::Identity(problem.size(), problem.size()), flux);
    return flux;
  }
};

TEUCHOS_UNIT_TEST(SchurComplement, IsTheDenseOne) {
  const Scene scene = loadedSquare();
  const Blocks all(scene, alone());
  for (const auto& subdomain : all.subdomains)
    for (const std::string& name : Registry<SchurComplement>::instance().names())
      for (const std::string& solver : Registry<LocalSolver>::instance().names()) {
        const Case one(*subdomain, solver, name);
        Vector load;
        const Matrix expected = denseSchur(subdomain->stiffness().dense(), one.boundary, subdomain->load(), &load);
        const Matrix s = one.applied();
        TEST_COMPARE(difference(s, expected), <, 1e-12);
        TEST_COMPARE(difference(one.problem.condensedLoad(), load), <, 1e-12);
        const std::vector<int> some{3, 0, 5};
        const Matrix block = one.problem.schurBlock(some);
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) TEST_COMPARE(std::abs(block(i, j) - expected(some[i], some[j])), <, 1e-12 * expected.norm());
      }
}

// Other loads and prescribed displacements after factoring, against dense elimination; single precision, too.
TEUCHOS_UNIT_TEST(SchurComplement, TakesOtherLoads) {
  const Scene scene = loadedSquare();
  for (const std::string name : {"Explicit", "Implicit", "Single", "Automatic"}) {
    Blocks all(scene, alone());
    std::vector<std::unique_ptr<SubdomainProblem>> problems;
    for (const auto& subdomain : all.subdomains) {
      auto single = std::make_unique<ImplicitSchurComplement>(ImplicitSchurComplement::Precision::Single);
      problems.push_back(std::make_unique<SubdomainProblem>(7, *subdomain, sharedDofs(*subdomain), localSolver("CHOLMOD"),
                                                            name == "Single" ? std::move(single) : schurComplement(name)));
    }
    for (Load& load : all.model.loads) load.factor = load.kind == Load::Kind::BodyForce ? -3.0 : 0.25;
    for (std::size_t i = 0; i < problems.size(); ++i) {
      for (NodeRule& rule : all.meshes[i].rules) rule.value = scaled(-2.0, rule.value);
      Subdomain& subdomain = *all.subdomains[i];
      subdomain.reload();
      problems[i]->reload();
      Vector load;
      const std::vector<int> boundary = sharedDofs(subdomain);
      denseSchur(subdomain.stiffness().dense(), boundary, subdomain.load(), &load);
      TEST_COMPARE(difference(problems[i]->condensedLoad(), load), <, 1e-11);
      const Vector values = problems[i]->recover(Vector::Zero(problems[i]->size()));  // no motion of the boundary
      Vector rest = subdomain.load() - subdomain.stiffness() * values;
      for (const int dof : boundary) rest(dof) = 0.0;
      TEST_COMPARE(rest.norm(), <, 1e-12 * subdomain.load().norm());
      TEST_FLOATING_EQUALITY(problems[i]->constantEnergy(), subdomain.constantEnergy() - 0.5 * values.dot(subdomain.load()), 1e-11);
    }
  }
}

TEUCHOS_UNIT_TEST(SchurComplement, VanishesOnTracesOfRigidMotions) {
  const Scene scene = loadedSquare(2e11);
  const Blocks all(scene, alone());
  int floating = 0;
  for (const auto& subdomain : all.subdomains) {
    const Case one(*subdomain);
    const Matrix& kernel = one.problem.kernel();
    const bool held = subdomain->mesh().rules.size() > 0;
    TEST_EQUALITY(kernel.cols(), held ? 0 : 3);
    TEST_EQUALITY(one.problem.hint(Hint::kCoarseModes).cols(), 3);
    if (held) continue;
    ++floating;
    Matrix flux(kernel.rows(), kernel.cols());
    one.problem.applySchur(kernel, flux);
    TEST_COMPARE(flux.norm(), <, 1e-13 * one.applied().norm() * kernel.norm());
    // and on nothing else
    const Vector values = eigenvalues(one.applied());
    TEST_COMPARE(values(2), <, 1e-12 * values(values.size() - 1));
    TEST_COMPARE(values(3), >, 1e-3 * values(values.size() - 1));
  }
  TEST_EQUALITY(floating, 2);
}

TEUCHOS_UNIT_TEST(SchurComplement, RecoversTheDiscreteHarmonicExtension) {
  const Scene scene = loadedSquare();
  const Blocks all(scene, alone());
  for (const auto& subdomain : all.subdomains) {
    const Case one(*subdomain);
    const Vector trace = random(one.problem.size(), 1).col(0), u = one.problem.recover(trace);
    const std::vector<int> interior = complement(subdomain->dofs(), one.boundary);
    TEST_EQUALITY(difference(rowsAt(u, one.boundary), trace), 0.0);
    const Vector residual = subdomain->stiffness() * u - subdomain->load();
    TEST_COMPARE(rowsAt(residual, interior).norm(), <, 1e-12 * (subdomain->stiffness() * u).norm());
    // The boundary keeps S trace - condensed load, and the energies agree.
    Matrix flux(trace.size(), 1);
    one.problem.applySchur(trace, flux);
    TEST_COMPARE(difference(rowsAt(residual, one.boundary), flux - one.problem.condensedLoad()), <, 1e-12);
    const double whole = 0.5 * u.dot(subdomain->stiffness() * u) - u.dot(subdomain->load()) + subdomain->constantEnergy();
    const double condensed = 0.5 * trace.dot(flux.col(0)) - trace.dot(one.problem.condensedLoad()) + one.problem.constantEnergy();
    TEST_FLOATING_EQUALITY(condensed, whole, 1e-11);
  }
}

TEUCHOS_UNIT_TEST(SchurComplement, TheLocalInverseSolvesBalancedFluxes) {
  const Scene scene = loadedSquare(2e11);
  const Blocks all(scene, alone());
  for (const auto& subdomain : all.subdomains)
    for (const std::string& solver : Registry<LocalSolver>::instance().names()) {
      const Case one(*subdomain, solver);
      const int n = one.problem.size();
      const auto inverse = one.problem.inverse();
      Matrix f = random(n, 3), trace(n, 3), flux(n, 3);
      const Matrix& z = one.problem.kernel();
      if (z.cols() > 0) f = withoutSpan(z, f);
      inverse->apply(f, trace);
      one.problem.applySchur(trace, flux);
      TEST_COMPARE(difference(flux, f), <, 1e-11);
      Matrix dense(n, n);
      inverse->apply(Matrix::Identity(n, n), dense);
      TEST_COMPARE(difference(dense, dense.transpose()), <, 1e-12);
      const Vector values = eigenvalues(dense);
      TEST_COMPARE(values(0), >, 0.0);
    }
}

TEUCHOS_UNIT_TEST(SchurComplement, ASubdomainWithoutInteriorIsItsOwn) {
  const Scene scene = square(2, 1);  // four subdomains of two triangles; all unknowns of the blocks on the boundary
  const Blocks all(scene, alone());
  const Subdomain& s = *all.subdomains[0];
  SubdomainProblem problem(0, s, range(s.dofs()), localSolver(), schurComplement("Implicit"));
  TEST_COMPARE(difference(problem.schurBlock(range(s.dofs())), s.stiffness().dense()), <, 1e-14);
  TEST_EQUALITY(problem.constantEnergy(), 0.0);
}

// A factor in single precision changes neither fluxes nor interiors: their errors are the squares of its error.
TEUCHOS_UNIT_TEST(SchurComplement, IsTheSameByAFactorInSinglePrecision) {
  using Precision = ImplicitSchurComplement::Precision;
  Scene scene = square(1, 48, 2e11);
  scene.hold("body_left", 0, 0.01);
  scene.hold("body_left", 1, -0.02);
  scene.pressure("body_top", 3e8);
  const Blocks all(scene, alone());
  const Subdomain& s = *all.subdomains[0];
  std::vector<int> boundary;
  for (int dof = 0; dof < s.dofs(); ++dof)
    if (s.mesh().point(s.nodeOf(dof))[0] == 1.0) boundary.push_back(dof);
  const std::vector<int> nodes = nodesOfDofs(s);
  const std::vector<Point> places = placesOfDofs(s);
  ImplicitSchurComplement exact(Precision::Double), single(Precision::Single);
  for (SchurComplement* schur : {static_cast<SchurComplement*>(&exact), static_cast<SchurComplement*>(&single)})
    schur->compute({s.stiffness(), s.load(), boundary, nodes, places, localSolver(), "it"});
  TEST_ASSERT(exact.precision() == Precision::Double);
  TEST_ASSERT(single.precision() == Precision::Single);
  const int n = static_cast<int>(boundary.size());
  Matrix a(n, n), b(n, n), column(n, 1);
  exact.apply(Matrix::Identity(n, n), a);
  single.apply(Matrix::Identity(n, n), b);
  TEST_COMPARE(difference(b, a), <, 1e-12);
  TEST_COMPARE((b - b.transpose()).norm(), <, 1e-12 * a.norm());
  single.apply(Matrix::Identity(n, n).col(3), column);
  TEST_COMPARE(difference(Vector(column.col(0)), Vector(a.col(3))), <, 1e-12);
  const Vector trace = random(n, 1).col(0);
  TEST_COMPARE(difference(single.recover(trace), exact.recover(trace)), <, 1e-11);
  TEST_FLOATING_EQUALITY(single.interiorEnergy(), exact.interiorEnergy(), 1e-13);
}

}  // namespace
}  // namespace suture
