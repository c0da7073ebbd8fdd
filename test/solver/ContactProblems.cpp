// The contract of ContactProblem, for every formulation that a scene may name.
#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_MultiVector.hpp>
#include <answer/Judged.hpp>
#include <solver/SceneChoices.hpp>

namespace suture {
namespace {

using namespace blocks;

/// A block held by contact only, in a formulation, with every n-th pair closed (0: none).
struct Held : Formulated {
  const ContactProblem& contact;
  ClosedSet closed;
  InterfaceState state;

  Held(const std::string& formulation, int every) : Formulated(looseBlock(), world(), formulation), contact(*problem->contact()) {
    state = contact.padState();
    closed = closedSet(contact.statesOf(state.status));
    for (std::size_t i = 0; i < closed.size(); ++i) closed[i] = every > 0 && int(i) % every == 0;
    state.status = contact.statusOf(statesOf(closed));
    state.memory.reset();
    problem->conform(state);
  }
  const RigidBodyModel& rigid() const { return contact.bodies().rigid(); }
  std::shared_ptr<const InterfaceSpace> space() const { return problem->linearise(state).matrix->space(); }
  InterfaceState after(const MultiVector& step) const {
    InterfaceState copy = state;
    copy.trace = Teuchos::rcp(new MultiVector(*state.trace, Teuchos::Copy));
    copy.memory.reset();
    problem->update(copy, step, 1.0);
    return copy;
  }
};

TEUCHOS_UNIT_TEST(ContactProblems, ABodyThatNothingHoldsMovesWithoutForces) {
  for (const std::string& formulation : formulations()) {
    Held held(formulation, 0);
    const Matrix loose = held.rigid().loose(held.closed);
    TEST_EQUALITY(loose.cols(), 1);
    const Vector motion = 0.3 * loose.col(0);
    const PairValues before = held.contact.valuesOf(held.state);
    move(held.state, motion);
    const PairValues after = held.contact.valuesOf(held.state);
    out << formulation << ": energy " << before.energy << ", " << after.energy << "\n";
    TEST_FLOATING_EQUALITY(after.energy - before.energy, -held.rigid().data().work.dot(motion), 1e-9);
    TEST_COMPARE((after.jump.col(0) - before.jump.col(0) - held.rigid().data().rows * motion).norm(), <, 1e-12);
    MultiVector difference(*after.residual, Teuchos::Copy);
    difference.update(-1.0, *before.residual, 1.0);
    TEST_COMPARE(norm(difference), <=, 1e-10 * norm(*before.residual));
    TEST_ASSERT(after.force.isZero(0.0));
  }
}

TEUCHOS_UNIT_TEST(ContactProblems, RigidMotionsPutBesideTheTraceAreTheSameState) {
  for (const std::string& formulation : formulations()) {
    const Held held(formulation, 0);
    InterfaceState moved = held.after(*someStep(*held.space(), 1e-3, 3.0));
    const PairValues before = held.contact.valuesOf(moved);
    const Vector beside = moved.rigid;
    held.contact.separate(moved);
    TEST_COMPARE((moved.rigid - (beside.size() > 0 ? beside : Vector(Vector::Zero(moved.rigid.size())))).norm(), >,
                 1e-6);  // steps are 1e-3
    InterfaceState again = moved;
    again.trace = Teuchos::rcp(new MultiVector(*moved.trace, Teuchos::Copy));
    held.contact.separate(again);
    TEST_COMPARE((again.rigid - moved.rigid).norm(), <, 1e-15);  // nothing remains in the trace
    moved.memory.reset();
    const PairValues after = held.contact.valuesOf(moved);
    TEST_FLOATING_EQUALITY(before.energy, after.energy, 1e-10);
    TEST_COMPARE((after.jump - before.jump).norm(), <, 1e-12);
    MultiVector difference(*after.residual, Teuchos::Copy);
    difference.update(-1.0, *before.residual, 1.0);
    TEST_COMPARE(norm(difference), <, 1e-10 * norm(*before.residual));
  }
}

/// Groups hold loads and gaps inside: their energies are quadratic in the trace plus a linear part.
TEUCHOS_UNIT_TEST(ContactProblems, EnergiesOfPartsAreQuadraticInTheTrace) {
  for (const std::string& formulation : formulations()) {
    Held held(formulation, 0);
    held.state.trace->putScalar(0.0);
    std::vector<Vector> energies;
    for (const double size : {0.0, 1.0, 2.0, 3.0}) {
      const MultiVectorPtr step = someStep(*held.space(), 1e-3 * size, 5.0);
      energies.push_back(held.contact.energies(held.after(*step)));
      TEST_EQUALITY(energies.back().size(), Eigen::Index(held.contact.bodies().parts().size()));
    }
    const Vector curvature = energies[2] - 2.0 * energies[1] + energies[0];
    const Vector third = energies[3] - 3.0 * energies[2] + 3.0 * energies[1] - energies[0];
    out << formulation << ": " << energies[1].transpose() << ", second difference " << curvature.transpose() << ", third "
        << third.transpose() << "\n";
    TEST_COMPARE(energies[0].minCoeff(), >=, 0.0);
    TEST_COMPARE(curvature.minCoeff(), >, 0.0);
    TEST_COMPARE(third.cwiseAbs().maxCoeff(), <=, 1e-12 * energies[3].maxCoeff());
  }
}

}  // namespace
}  // namespace suture
