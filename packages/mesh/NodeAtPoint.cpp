#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/NodeAtPoint.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace suture {

namespace {

constexpr double kAtPoint = 1e-6;      // default tolerance relative to the extent: coordinates in text files have six digits or more
constexpr double kEquallyNear = 1e-9;  // difference up to which distances count as equal, relative to the extent

}  // namespace

bool NodeAtPoint::isNearer(const NearNode& a, const NearNode& b) const {
  return std::abs(a.distance - b.distance) > kEquallyNear * extent_ ? a.distance < b.distance : a.node < b.node;
}

void NodeAtPoint::offer(const NearNode& node) {
  const auto own = std::find_if(candidates_.begin(), candidates_.end(), [&](const NearNode& one) { return one.body == node.body; });
  if (own == candidates_.end())
    candidates_.push_back(node);
  else if (isNearer(node, *own))
    *own = node;
}

std::optional<NearNode> NodeAtPoint::choose(double tolerance, const std::vector<std::string>& bodies, int dimension,
                                            const std::string& path, Problems& problems) const {
  std::vector<NearNode> found = candidates_;
  std::sort(found.begin(), found.end(), [](const NearNode& a, const NearNode& b) { return a.distance < b.distance; });
  const auto nameOf = [&](const NearNode& node) { return "'" + bodies[static_cast<std::size_t>(node.body)] + "'"; };
  const double limit = tolerance > 0.0 ? tolerance : kAtPoint * extent_;
  if (found.empty() || found.front().distance > limit) {
    std::ostringstream text;
    text << "no node within " << limit << " of " << placeText(point_, dimension);
    if (!found.empty())
      text << "; the nearest one is " << placeText(found.front().place, dimension) << " of the body " << nameOf(found.front()) << ", "
           << found.front().distance << " away. Add a point to the geometry there, or set Tolerance";
    problems.add(path + "/Point", text.str());
    return std::nullopt;
  }
  if (found.size() > 1 && found[1].distance <= found[0].distance + kEquallyNear * extent_) {
    problems.add(path + "/Body", "is missing: at " + placeText(point_, dimension) + " there are nodes of the bodies " + nameOf(found[0]) +
                                     " and " + nameOf(found[1]));
    return std::nullopt;
  }
  return found.front();
}

}  // namespace suture
