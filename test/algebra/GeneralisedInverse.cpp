#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/algebra/GeneralisedInverse.hpp>
#include <suture/subdomain/SubdomainProblem.hpp>

namespace suture {
namespace {

using namespace blocks;

// One body with some components of its left side held, so that `loose` rigid motions remain.
Scene heldIn(const std::vector<int>& components, double young = 2e11) {
  Scene scene = square(1, 7, young);
  for (int k : components) scene.hold("body_left", k, 0.0);
  return scene;
}

TEUCHOS_UNIT_TEST(GeneralisedInverse, SolvesEveryBalancedLoadOfAFloatingBody) {
  for (const std::vector<int>& components : {std::vector<int>{}, {0}, {0, 1}})
    for (const std::string& name : Registry<LocalSolver>::instance().names()) {
      const Scene scene = heldIn(components);
      const Blocks body(scene, alone(), 1);
      const Subdomain& s = *body.subdomains[0];
      const int loose = components.empty() ? 3 : components.size() == 1 ? 1 : 0;
      TEST_EQUALITY(s.kernel().cols(), loose);
      const GeneralisedInverse inverse(s.stiffness().full(), s.kernel(), nodesOfDofs(s), localSolver(name), "body");
      Matrix b = random(s.dofs(), 4);
      if (loose > 0) b = withoutSpan(s.kernel(), b);
      Matrix x = b;
      inverse.apply(x);
      TEST_COMPARE(difference(s.stiffness() * x, b), <, 1e-11);
      // equal to the pseudo-inverse up to a rigid motion
      Matrix expected = leastSquares(s.stiffness().dense(), b);
      if (loose > 0) x = withoutSpan(s.kernel(), x);
      TEST_COMPARE(difference(x, expected), <, 1e-9);
    }
}

TEUCHOS_UNIT_TEST(GeneralisedInverse, IsSymmetricPositiveDefinite) {
  const Scene scene = heldIn({});
  const Blocks body(scene, alone(), 1);
  const Subdomain& s = *body.subdomains[0];
  const GeneralisedInverse inverse(s.stiffness().full(), s.kernel(), nodesOfDofs(s), localSolver(), "body");
  Matrix x = Matrix::Identity(s.dofs(), s.dofs());
  inverse.apply(x);
  TEST_COMPARE(difference(x, x.transpose()), <, 1e-12);
  TEST_COMPARE(eigenvalues(x)(0), >, 0.0);
}

TEUCHOS_UNIT_TEST(GeneralisedInverse, RefusesAKernelThatIsNotOne) {
  const Scene scene = heldIn({0, 1});
  const Blocks body(scene, alone(), 1);
  const Subdomain& s = *body.subdomains[0];
  TEST_THROW(GeneralisedInverse(s.stiffness().full(), s.rigidModes(), nodesOfDofs(s), localSolver(), "body"), NumericalError);
}

TEUCHOS_UNIT_TEST(GeneralisedInverse, RefusesAForgottenMode) {
  const Scene scene = heldIn({});
  const Blocks body(scene, alone(), 1);
  const Subdomain& s = *body.subdomains[0];
  for (int known : {0, 1, 2})
    for (const std::string& name : Registry<LocalSolver>::instance().names())
      TEST_THROW(GeneralisedInverse(s.stiffness().full(), s.kernel().leftCols(known), nodesOfDofs(s), localSolver(name), "body"),
                 NumericalError);
}

}  // namespace
}  // namespace suture
