#include <algorithm>
#include <suture/interface/PlainFlips.hpp>

namespace suture {

ClosedSet plainFlips(const RigidBodyModel& rigid, const ContactLaws& laws, const ClosedSet& closed, PairResolution resolution,
                     const Vector& digits, InterfaceEvaluation& found) {
  found.forceTolerance = (std::max(resolution.ofCluster, kGapDigits) * rigid.clusterScale(closed, found.force))
                             .cwiseMax(resolution.ofBody * rigid.bodyScale(closed, found.force))
                             .cwiseMax(rigid.rounding());
  // The tolerance uses the compliance of the pair: a force that is large for a stiff pair hardly moves the soft ones around it.
  found.penetrationTolerance = rigid.compliance().cwiseProduct(found.forceTolerance) + digits;
  ClosedSet next = closed;
  for (std::size_t i = 0; i < closed.size(); ++i) {
    if (!rigid.data().canChange[i]) continue;
    const auto pair = static_cast<Eigen::Index>(i);
    // The tolerance favours the current state of the pair.
    const ContactLaw& law = laws.of(rigid.data().line[i]);
    ContactTrial trial;
    trial.normalOnly = true;
    if (closed[i])
      trial.force[0] = found.force(pair) + found.forceTolerance(pair);
    else
      trial.jump[0] = (found.penetration(pair) - found.penetrationTolerance(pair)) * rigid.data().stiffness(pair);
    next[i] = law.project(trial, closed[i] ? law.pressed() : ContactState()).closed();
    found.changed += next[i] != closed[i];
    found.active += next[i] != 0;
  }
  found.settled = found.changed == 0;
  return next;
}

}  // namespace suture
