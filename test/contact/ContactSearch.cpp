#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <random>
#include <suture/base/Dense.hpp>
#include <suture/base/Errors.hpp>
#include <suture/contact/DelassusProblem.hpp>

namespace suture {
namespace {

/// A random contact problem in its dual form. Some rows repeat others, some compliances are singular, some gaps and loads are zero.
struct RandomContact {
  Matrix compliance;
  Vector open;
  RigidContact::Pairs pairs;

  explicit RandomContact(unsigned seed) {
    std::mt19937_64 engine(seed);
    const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
    const auto number = [&](int least, int most) { return least + static_cast<int>(uniform() * (most - least + 1)); };
    const int n = number(1, 10), motions = number(0, 3);
    const int rank = uniform() < 0.3 ? number(1, n) : n;
    const Matrix factor = Matrix::NullaryExpr(n, rank, [&] { return uniform() - 0.5; });
    const double size = std::pow(10.0, number(-6, 6));
    compliance = size * (factor * factor.transpose());
    compliance.diagonal().array() += size * (uniform() < 0.5 ? 0.1 : 1e-6);
    pairs.rows = Matrix::NullaryExpr(n, motions, [&] { return uniform() < 0.2 ? 0.0 : 2.0 * uniform() - 1.0; });
    if (n > 1 && uniform() < 0.3) {  // two pairs that say the same
      pairs.rows.row(n - 1) = pairs.rows.row(0);
      compliance.row(n - 1) = compliance.row(0);
      compliance.col(n - 1) = compliance.col(0);
      compliance(n - 1, n - 1) = compliance(0, 0);
    }
    const Vector carried = Vector::NullaryExpr(n, [&] { return uniform() < 0.4 ? 0.0 : uniform(); });
    pairs.work = uniform() < 0.1 ? Vector(Vector::Zero(motions)) : Vector(pairs.rows.transpose() * carried);
    const double gap = size * std::pow(10.0, number(-3, 4));
    open = Vector::NullaryExpr(n, [&] { return uniform() < 0.2 ? 0.0 : gap * (uniform() - 0.7); });
    pairs.penetration = open;
    pairs.stiffness = 2.0 * compliance.diagonal().cwiseInverse();
    pairs.line.assign(n, 0);
    pairs.able.assign(n, 1);
  }
};

/// Largest violation of  l >= 0, w <= 0, l w = 0, G^T l = e  with w = d - C l + G a, relative to the sizes of forces and penetrations.
double violation(const RandomContact& given, const Vector& force, const Vector& amplitude) {
  const Vector w = given.open - given.compliance * force + given.pairs.rows * amplitude;
  // Forces are measured by the loads, and by what would close the gaps: a thousandth of it is still a force.
  const double forces = force.cwiseAbs().maxCoeff() + given.pairs.work.cwiseAbs().sum() +
                        1e-3 * given.open.cwiseAbs().maxCoeff() / given.compliance.diagonal().maxCoeff() + 1e-300;
  const double lengths = (given.compliance * force).cwiseAbs().maxCoeff() + given.open.cwiseAbs().maxCoeff() +
                         (given.pairs.rows.cwiseAbs() * amplitude.cwiseAbs()).maxCoeff() + 1e-300;
  double worst = std::max(-force.minCoeff() / forces, w.maxCoeff() / lengths);
  worst = std::max(worst, force.cwiseProduct(w).cwiseAbs().maxCoeff() / (forces * lengths));
  if (amplitude.size() > 0) worst = std::max(worst, (given.pairs.rows.transpose() * force - given.pairs.work).norm() / forces);
  return worst;
}

TEUCHOS_UNIT_TEST(ContactSearch, EndsWithACertificateOnThreeThousandDegenerateProblems) {
  int failed = 0, most = 0;
  double solves = 0.0;
  for (unsigned seed = 0; seed < 3000; ++seed) {
    const RandomContact given(seed);
    RigidContact rigid(given.pairs);
    DelassusProblem problem(rigid, given.compliance, given.open, {});
    ClosedSet start = rigid.start();
    if (const ClosedSet all(start.size(), 1); seed % 3 == 0 && !rigid.loosens(all)) start = all;
    const ContactSearch::Result found = ContactSearch(rigid, problem, 300).run(start);
    solves += found.solves;
    most = std::max(most, found.solves);
    const double wrong = found.converged ? violation(given, found.force, problem.state().amplitude) : 1.0;
    if (!(wrong < 1e-8)) {
      ++failed;
      out << "seed " << seed << ": " << (found.converged ? "violation " : found.failure + " ") << wrong << "\n";
    }
  }
  out << "solves " << solves / 3000 << " in the mean, " << most << " at most\n";
  TEST_EQUALITY(failed, 0);
  TEST_COMPARE(solves / 3000, <, 4.0);
}

TEUCHOS_UNIT_TEST(RigidContact, PadsCarryTheLoads) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    const RandomContact given(seed);
    RigidContact rigid(given.pairs);
    rigid.start();
    const RigidContact::Equilibrium pads = rigid.project(given.pairs.penetration);
    TEST_ASSERT(pads.found);
    if (pads.force.size() > 0) TEST_COMPARE(pads.force.minCoeff(), >=, 0.0);
    const double size =
        pads.force.sum() + given.pairs.work.norm() + 1e-3 * given.open.cwiseAbs().maxCoeff() * given.pairs.stiffness.minCoeff() + 1e-300;
    TEST_COMPARE((given.pairs.rows.transpose() * pads.force - given.pairs.work).norm(), <=, 1e-8 * size);
  }
}

TEUCHOS_UNIT_TEST(RigidContact, HoldersStopAllThatPairsCanStop) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    const RandomContact given(seed);
    const RigidContact rigid(given.pairs);
    ClosedSet closed(given.open.size(), 0);
    for (std::size_t i = 0; i < closed.size(); i += 2 + seed % 3) closed[i] = 1;
    const Matrix loose = rigid.loose(closed);
    for (const int i : rigid.holders(closed, loose)) {
      TEST_EQUALITY(static_cast<int>(closed[i]), 0);
      closed[i] = 1;
    }
    TEST_ASSERT(!rigid.loosens(closed));
  }
}

TEUCHOS_UNIT_TEST(RigidContact, RefusesLoadsThatPushABodyAway) {
  RigidContact::Pairs pairs;
  pairs.rows = Matrix::Constant(2, 1, 1.0);
  pairs.work = Vector::Constant(1, -1.0);  // pairs only push the other way
  pairs.penetration = Vector::Constant(2, -0.1);
  pairs.stiffness = Vector::Ones(2);
  pairs.line = {0, 0};
  pairs.able = {1, 1};
  RigidContact rigid(pairs);
  TEST_THROW(rigid.start(), NumericalError);
  TEST_EQUALITY(rigid.staticForces().size(), 0);
}

TEUCHOS_UNIT_TEST(RigidContact, NeutralMotionsAreThoseThatTouchingPairsDoNotStop) {
  RigidContact::Pairs pairs;
  pairs.rows = (Matrix(3, 2) << 1, 0, 0, 1, 0, -1).finished();
  pairs.work = (Vector(2) << 1, 0).finished();
  pairs.penetration = Vector::Zero(3);
  pairs.stiffness = Vector::Ones(3);
  pairs.line = {0, 1, 2};
  pairs.able = {1, 1, 1};
  const RigidContact rigid(pairs);
  TEST_EQUALITY(rigid.neutral({1, 0, 0}, {0, 0, 0}).cols(), 1);
  TEST_EQUALITY(rigid.neutral({1, 0, 0}, {0, 1, 0}).cols(), 1);  // away from the one that touches
  TEST_EQUALITY(rigid.neutral({1, 0, 0}, {0, 1, 1}).cols(), 0);  // between two that touch
}

}  // namespace
}  // namespace suture
