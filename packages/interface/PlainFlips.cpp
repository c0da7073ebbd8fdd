#include <algorithm>
#include <suture/interface/PlainFlips.hpp>

namespace suture {

ClosedSet plainFlips(const RigidContact& rigid, const ContactLaws& laws, const ClosedSet& closed, PairResolution resolution,
                     const Vector& digits, InterfaceEvaluation& found) {
  found.forceTolerance = (std::max(resolution.ofCluster, kGapDigits) * rigid.clusterScale(closed, found.force))
                             .cwiseMax(resolution.ofBody * rigid.bodyScale(closed, found.force))
                             .cwiseMax(rigid.rounding());
  // A stiff pair among soft ones has the accuracy of its own compliance: a force that is much for it moves the soft ones by little.
  found.penetrationTolerance = rigid.compliance().cwiseProduct(found.forceTolerance) + digits;
  ClosedSet next = closed;
  for (std::size_t i = 0; i < closed.size(); ++i) {
    if (!rigid.data().able[i]) continue;
    const auto pair = static_cast<Eigen::Index>(i);
    // The tolerance goes to the state that the pair has.
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
