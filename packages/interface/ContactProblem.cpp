#include <suture/base/ForceScale.hpp>
#include <suture/interface/ContactProblem.hpp>
#include <suture/search/LawProjection.hpp>

#include <algorithm>

namespace suture {

InterfaceState ContactProblem::stateOnPads(RigidBodyModel& rigid) const {
  InterfaceState state = stateWith(suture::statesOf(rigid.start()));
  move(state, rigid.project(rigid.data().penetration).motion);
  return state;
}

void move(InterfaceState& state, const Vector& motion) {
  if (motion.size() == 0 || motion.isZero(0.0)) return;
  if (state.rigid.size() == 0) state.rigid = Vector::Zero(motion.size());
  state.rigid += motion;
}

ContactAnswer answerOf(const ContactProblem& contact, const PairStates& states, const PairValues& values, PairResolution resolution) {
  const RigidBodyModel& rigid = contact.bodies().rigid();
  const ClosedSet closed = closedSet(states);
  const Vector size = values.force.rowwise().norm();
  ContactAnswer answer;
  answer.force = values.force;
  answer.jump = values.jump;
  answer.energy = values.energy;
  answer.forceTolerance = (std::max(resolution.ofCluster, kGapDigits) * rigid.clusterScale(closed, size))
                              .cwiseMax(resolution.ofBody * rigid.bodyScale(closed, size))
                              .cwiseMax(std::max(1.0, resolution.ofPath / kRoundedForce) * rigid.rounding());
  // Slip is compared with forces. Without loads, forces are round-off of displacements.
  if (contact.laws().restrictSliding())
    answer.forceTolerance = answer.forceTolerance.cwiseMax(values.digits.cwiseQuotient(rigid.compliance()));
  // The tolerance uses the compliance of the pair: a force that is large for a stiff pair hardly moves the soft ones around it.
  answer.jumpTolerance = rigid.compliance().cwiseProduct(answer.forceTolerance) + values.digits;
  return answer;
}

InterfaceEvaluation evaluationOf(const ContactProblem& contact, const PairStates& states, const PairValues& values,
                                 const ContactAnswer& answer) {
  const RigidBodyModel& rigid = contact.bodies().rigid();
  const PairStates next = LawProjection(rigid, contact.laws(), contact.sites()).atSolution(states, answer);
  InterfaceEvaluation result;
  result.residual = values.residual;
  result.energy = values.energy;
  result.applications = values.applications;
  result.next = contact.statusOf(next);
  for (std::size_t i = 0; i < next.size(); ++i) {
    if (!rigid.data().canChange[i]) continue;
    result.changed += next[i].status != states[i].status;
    result.active += next[i].closed();
  }
  // With friction, directions of slip and bounds may still change: only the search knows.
  result.settled = result.changed == 0 && !contact.laws().restrictSliding();
  return result;
}

}  // namespace suture
