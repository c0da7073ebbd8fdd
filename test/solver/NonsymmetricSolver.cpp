// GMRES in the norm of the preconditioner, on tangents of contact with friction.
#include <suture/solver/InnerSolver.hpp>
#include <suture/solver/NonsymmetricSolver.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_MultiVector.hpp>
#include <interface/DenseSpace.hpp>
#include <interface/FrictionBlocks.hpp>
#include <solver/ContactMethods.hpp>
#include <support/DryLaw.hpp>

namespace suture {
namespace {

using namespace blocks;

/// The residual itself.
class NoPreconditioner : public Preconditioner {
 protected:
  void doCompute() override {}
  void doApply(const MultiVector& r, MultiVector& z) const override { z.update(1.0, r, 0.0); }
};

/// Every third pair sticks, the others slip to the right, half of them by Coulomb's law with this coefficient.
struct TangentProblem {
  TangentProblem(const Scene& scene, double friction, bool preconditioned = true)
      : one(scene, world()), state(stateOf(one, friction)), linear(one.problem.linearise(state)), space(*linear.matrix->space()) {
    made = preconditioned ? preconditioner("BDDC")() : Teuchos::RCP<Preconditioner>(Teuchos::rcp(new NoPreconditioner));
    made->initialize(linear.matrix->space());
    made->compute(linear.matrix);
  }
  static InterfaceState stateOf(const OnInterface& one, double friction) {
    PairStates states;
    for (int p = 0; p < one.problem.contact()->bodies().rigid().pairs(); ++p)
      states.push_back(p % 3 == 0 ? ContactState(PairStatus::Stick) : ContactState(PairStatus::Slip, {0, -1, 0}, 1e-3, p % 2 * friction));
    InterfaceState state = one.problem.contact()->stateWith(states);
    one.problem.conform(state);
    state.memory.reset();
    return state;
  }
  InnerResult solve(MultiVector& x, double tolerance, int most = 1000) const {
    return solveNonsymmetric(linear.matrix, made, *linear.load, x, tolerance, 0.0, most);
  }
  double residual(const MultiVector& x) const {
    MultiVector r(*linear.load, Teuchos::Copy);
    linear.matrix->apply(x, r, Teuchos::NO_TRANS, -1.0, 1.0);
    return preconditionedNorm(*made, r) / preconditionedNorm(*made, *linear.load);
  }
  /// By elimination; unknowns that are expressed by others stay zero.
  Vector direct() const {
    const Matrix a = space.dense(static_cast<const Operator&>(*linear.matrix));
    const Vector b = space.dense(*linear.load);
    std::vector<int> active;
    for (int i = 0; i < space.size(); ++i)
      if (a.col(i).norm() > 0.0) active.push_back(i);
    const Vector own = dense::solve(a(active, active), b(active));
    Vector x = Vector::Zero(space.size());
    for (std::size_t k = 0; k < active.size(); ++k) x(active[k]) = own(Eigen::Index(k));
    return x;
  }
  MultiVectorPtr vector() const { return one.problem.space()->vector(); }

  OnInterface one;
  InterfaceState state;
  InterfaceProblem::Linearisation linear;
  DenseSpace space;
  Teuchos::RCP<Preconditioner> made;
  Monitor silent;
};

TEUCHOS_UNIT_TEST(NonsymmetricSolver, FindsTheSolutionAndReportsItsResidual) {
  for (const int dimension : {2, 3})
    for (const Sides sides : {Sides::Matching, Sides::Mortar}) {
      const TangentProblem p(rubbedBlocks(dimension, sides, scenes::dry(0.1, 0.6)), 0.6);
      TEST_ASSERT(!p.linear.matrix->symmetric());
      const MultiVectorPtr x = p.vector();
      const Vector expected = p.direct();
      for (const double tolerance : {1e-3, 1e-6, 1e-12}) {
        const InnerResult result = p.solve(*x, tolerance);
        TEST_ASSERT(result.converged);
        TEST_COMPARE(result.residual, <=, tolerance);
        TEST_COMPARE(std::abs(p.residual(*x) - result.residual), <, 1e-6 * result.residual + 1e-14);
      }
      TEST_COMPARE((p.space.dense(*x).col(0) - expected).norm(), <, 1e-9 * expected.norm());
    }
}

TEUCHOS_UNIT_TEST(NonsymmetricSolver, LosesNothingFromIterationToIteration) {
  const TangentProblem p(rubbedBlocks(2, Sides::Matching, scenes::dry(0.1, 0.6), 6), 0.6);
  const MultiVectorPtr x = p.vector();
  const int all = p.solve(*x, 1e-10).pcg;
  TEST_COMPARE(all, >=, 5);
  double before = 1.0;
  for (int most = 1; most + 1 < all; ++most) {
    const InnerResult result = p.solve(*x, 1e-10, most);
    TEST_ASSERT(!result.converged);
    TEST_EQUALITY(result.pcg, most + 1);  // one for the residual itself
    const double now = p.residual(*x);
    TEST_COMPARE(now, <=, before * (1.0 + 1e-10));
    TEST_COMPARE(std::abs(now - result.residual), <, 1e-6 * now);
    before = now;
  }
}

// Without a preconditioner and with a jump of stiffness more vectors are needed than are kept.
TEUCHOS_UNIT_TEST(NonsymmetricSolver, GoesOnBeyondItsRestart) {
  Scene scene = rubbedBlocks(2, Sides::Matching, scenes::dry(0.1, 0.6), 32);
  scene.model.materialOfBody[0].young = 300.0;
  const TangentProblem p(scene, 0.6, false);
  const MultiVectorPtr x = p.vector();
  const InnerResult result = p.solve(*x, 1e-8, 20000);
  out << result.pcg << " iterations of " << p.space.size() << " unknowns\n";
  TEST_ASSERT(result.converged);
  TEST_COMPARE(result.pcg, >, 120);
  TEST_COMPARE(p.residual(*x), <, 1.01e-8);
}

TEUCHOS_UNIT_TEST(NonsymmetricSolver, OfNothingIsNothing) {
  const TangentProblem p(rubbedBlocks(2, Sides::Matching, scenes::dry(0.1, 0.6)), 0.6);
  const MultiVectorPtr x = p.vector(), none = p.vector();
  x->putScalar(3.0);
  const InnerResult result = solveNonsymmetric(p.linear.matrix, p.made, *none, *x, 1e-10, 0.0, 100);
  TEST_ASSERT(result.converged);
  TEST_EQUALITY(result.pcg, 0);
  TEST_EQUALITY(dot(*x, *x), 0.0);
  // A right-hand side that is already small enough.
  const double norm = preconditionedNorm(*p.made, *p.linear.load);
  TEST_EQUALITY(solveNonsymmetric(p.linear.matrix, p.made, *p.linear.load, *x, 1e-2, 200.0 * norm, 100).pcg, 0);
}

TEUCHOS_UNIT_TEST(NonsymmetricSolver, ToleratesJumpsOfStiffness) {
  for (const double jump : {1e-8, 1e8})
    for (const double unit : {1.0, 1e12}) {
      Scene scene = rubbedBlocks(2, Sides::Matching, scenes::dry(0.1, 0.4), 4);
      scene.model.materialOfBody[0].young = unit * jump;
      scene.model.materialOfBody[1].young = unit;
      const TangentProblem p(scene, 0.4);
      const MultiVectorPtr x = p.vector();
      const InnerResult result = p.solve(*x, 1e-8);
      TEST_ASSERT(result.converged);
      out << jump << ": " << result.pcg << " iterations\n";
      TEST_COMPARE(result.pcg, <, 60);
      TEST_COMPARE(p.residual(*x), <, 1.1e-8);
    }
}

TEUCHOS_UNIT_TEST(NonsymmetricSolver, TakesAsManyIterationsAsConjugateGradientsWhereTheTangentIsSymmetric) {
  for (const int dimension : {2, 3}) {
    const TangentProblem p(rubbedBlocks(dimension, Sides::Matching, scenes::dry(0.1, 0.0), 4), 0.0);
    TEST_ASSERT(p.linear.matrix->symmetric());
    for (const double tolerance : {1e-4, 1e-8}) {
      const MultiVectorPtr x = p.vector(), y = p.vector();
      const InnerResult gmres = p.solve(*x, tolerance);
      Monitor silent;
      const InnerResult cg = InnerSolver(1000).solve(p.linear.matrix, p.made, *p.linear.load, *y, tolerance, 0.0, silent);
      out << dimension << ": " << gmres.pcg << " and " << cg.pcg << "\n";
      TEST_COMPARE(std::abs(gmres.pcg - cg.pcg), <=, 2);
      TEST_COMPARE(gmres.pcg, <=, cg.pcg + 1);  // one for the residual itself
      y->update(-1.0, *x, 1.0);
      TEST_COMPARE(std::sqrt(dot(*y, *y)), <, 100.0 * tolerance * std::sqrt(dot(*x, *x)));
    }
  }
}

}  // namespace
}  // namespace suture
