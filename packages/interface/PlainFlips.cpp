#include <algorithm>
#include <suture/interface/PlainFlips.hpp>

namespace suture {

ClosedSet plainFlips(const RigidContact& rigid, const ClosedSet& closed, double resolution, const Vector& digits,
                     InterfaceEvaluation& found) {
  found.forceTolerance = std::max(resolution, kGapDigits) * rigid.clusterScale(closed, found.force);
  // A stiff pair among soft ones has the accuracy of its own compliance: a force that is much for it moves the soft ones by little.
  found.penetrationTolerance = rigid.compliance().cwiseProduct(found.forceTolerance) + digits;
  ClosedSet next = closed;
  for (std::size_t i = 0; i < closed.size(); ++i) {
    if (!rigid.data().able[i]) continue;
    const auto pair = static_cast<Eigen::Index>(i);
    if (closed[i] ? found.force(pair) < -found.forceTolerance(pair) : found.penetration(pair) > found.penetrationTolerance(pair))
      next[i] = !closed[i];
    found.changed += next[i] != closed[i];
    found.active += next[i] != 0;
  }
  found.settled = found.changed == 0;
  return next;
}

}  // namespace suture
