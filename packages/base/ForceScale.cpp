#include <suture/base/ForceScale.hpp>

#include <algorithm>

namespace suture {

void BodyForces::take(const BodyForces& other) {
  loads = std::max(loads, other.loads);
  prescribed = std::max(prescribed, other.prescribed);
  force = std::max(force, other.force);
  deformation = std::max(deformation, other.deformation);
}

std::vector<char> idleBodies(const std::vector<BodyForces>& now, const std::vector<BodyForces>& past) {
  std::vector<char> idle;
  for (std::size_t b = 0; b < now.size(); ++b) {
    const BodyForces before = past.empty() ? BodyForces() : past[b];
    idle.push_back(now[b].loads <= kRoundedForce * before.force && now[b].prescribed <= kRoundedForce * before.prescribed);
  }
  return idle;
}

std::vector<double> lentValues(const std::vector<double>& own, const std::vector<char>& idle, double share,
                               const std::vector<std::pair<int, int>>& neighbours) {
  std::vector<double> lent(own.size(), 0.0);
  bool rises = true;
  const auto lend = [&](int from, int to) {
    const double offer = std::max(share * own[from], idle[from] && lent[from] > own[from] ? lent[from] : 0.0);
    if (!idle[to] || !(offer > lent[to])) return;
    lent[to] = offer;
    rises = true;
  };
  while (rises) {
    rises = false;
    for (const auto& [one, other] : neighbours) {
      lend(one, other);
      lend(other, one);
    }
  }
  return lent;
}

std::vector<ForceScale> ForceScale::of(const std::vector<BodyForces>& now, const std::vector<BodyForces>& past,
                                       const std::vector<std::pair<int, int>>& neighbours) {
  const std::vector<char> idle = idleBodies(now, past);
  std::vector<double> own, largest;
  for (std::size_t b = 0; b < now.size(); ++b) {
    own.push_back(now[b].force);
    largest.push_back(past.empty() ? 0.0 : past[b].force);
  }
  const std::vector<double> lent = lentValues(own, idle, kLentForce, neighbours), before = lentValues(largest, idle, 1.0, neighbours);
  std::vector<ForceScale> scales;
  for (std::size_t b = 0; b < now.size(); ++b)
    scales.push_back({std::max(own[b], lent[b]), lent[b], idle[b] ? kRoundedForce * std::max(largest[b], before[b]) : 0.0});
  return scales;
}

}  // namespace suture
