#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <suture/search/DelassusProblem.hpp>
#include <suture/search/StateSearch.hpp>

#include "RandomContact.hpp"

namespace suture {
namespace {

/// Largest violation of  l >= 0, w <= 0, l w = 0, G^T l = e  with w = d - C l + G a, relative to the sizes of forces and penetrations.
double violation(const RandomContact& given, const Vector& force, const Vector& amplitude) {
  const Vector w = given.open - given.compliance * force + given.pairs.rows * amplitude;
  // Forces are scaled by the loads, and by the forces that would close the gaps: a thousandth of it is still a force.
  const double forces = force.cwiseAbs().maxCoeff() + given.pairs.work.cwiseAbs().sum() +
                        1e-3 * given.open.cwiseAbs().maxCoeff() / given.compliance.diagonal().maxCoeff() + 1e-300;
  const double lengths = (given.compliance * force).cwiseAbs().maxCoeff() + given.open.cwiseAbs().maxCoeff() +
                         (given.pairs.rows.cwiseAbs() * amplitude.cwiseAbs()).maxCoeff() + 1e-300;
  double worst = std::max(-force.minCoeff() / forces, w.maxCoeff() / lengths);
  worst = std::max(worst, force.cwiseProduct(w).cwiseAbs().maxCoeff() / (forces * lengths));
  if (amplitude.size() > 0) worst = std::max(worst, (given.pairs.rows.transpose() * force - given.pairs.work).norm() / forces);
  return worst;
}

TEUCHOS_UNIT_TEST(FrictionlessSearch, SolvesThreeThousandDegenerateProblems) {
  int failed = 0, most = 0;
  double solves = 0.0;
  for (unsigned seed = 0; seed < 3000; ++seed) {
    const RandomContact given(seed);
    RigidBodyModel rigid(given.pairs);
    DelassusProblem problem(rigid, given.compliance, given.open, {});
    ClosedSet start = rigid.start();
    if (const ClosedSet all(start.size(), 1); seed % 3 == 0 && !rigid.loosens(all)) start = all;
    const StateSearch::Result found = StateSearch(rigid, problem, 300).run(statesOf(start));
    solves += found.solves;
    most = std::max(most, found.solves);
    const double wrong = found.converged ? violation(given, found.normal, problem.state().amplitude) : 1.0;
    if (!(wrong < 1e-8)) {
      ++failed;
      out << "seed " << seed << ": " << (found.converged ? "violation " : "not found ") << wrong << "\n";
    }
  }
  out << "solves " << solves / 3000 << " in the mean, " << most << " at most\n";
  TEST_EQUALITY(failed, 0);
  TEST_COMPARE(solves / 3000, <, 4.0);
}

}  // namespace
}  // namespace suture
