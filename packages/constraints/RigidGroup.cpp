#include <suture/constraints/RigidGroup.hpp>

namespace suture {

RigidGroupNodes::RigidGroupNodes(const std::vector<RigidGroup>& groups, int dimension) : dimension_(dimension) {
  for (const RigidGroup& group : groups)
    for (std::size_t place = 0; place < group.nodes.size(); ++place) placeOf_.emplace(group.nodes[place], Place{&group, place});
}

bool RigidGroupNodes::isMaster(int node, int component) const {
  const auto found = placeOf_.empty() ? placeOf_.end() : placeOf_.find(node);
  if (found == placeOf_.end()) return false;
  const RigidGroup& group = *found->second.group;
  for (std::size_t m = 0; m < group.masterNodes.size(); ++m)
    if (group.masterNodes[m] == node && group.masterComponents[m] == component) return true;
  return false;
}

bool RigidGroupNodes::moves(int node) const {
  const auto found = placeOf_.empty() ? placeOf_.end() : placeOf_.find(node);
  return found != placeOf_.end() && found->second.group->masters() > 0;
}

}  // namespace suture
