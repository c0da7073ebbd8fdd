#include <suture/solver/BodyImbalance.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {
constexpr double kLent = 1e-3;  // share of a neighbour's forces that a body without loads counts as its own, as in the verdict
}  // namespace

double bodyImbalance(const ContactBodies& bodies, const Vector& force, const Vector& energy, const Vector& largest) {
  const RigidContact::Pairs& data = bodies.rigid().data();
  if (bodies.areBound()) return 0.0;  // forces between bound pairs are not known here
  const std::size_t parts = bodies.parts().size();
  std::vector<double> size(parts, 0.0), loads(parts, 0.0), stiffness(parts, 0.0);
  for (std::size_t p = 0; p < parts; ++p)
    size[p] = loads[p] = data.work.segment(bodies.firstMotion(static_cast<int>(p)), bodies.parts()[p].free.cols()).norm();
  for (std::size_t i = 0; i < data.bodies.size(); ++i)
    for (const int p : data.bodies[i]) {
      size[p] += std::abs(force(static_cast<Eigen::Index>(i)));
      stiffness[p] = std::max(stiffness[p], data.stiffness(static_cast<Eigen::Index>(i)));
    }
  const std::vector<double> own = size;
  for (const auto& two : data.bodies)
    for (const int p : two)
      for (const int other : two)
        if (loads[p] == 0.0) size[p] = std::max(size[p], kLent * own[other]);
  double most = 0.0;
  for (std::size_t p = 0; p < parts; ++p) {
    const auto at = static_cast<Eigen::Index>(p);
    const Eigen::Index first = bodies.firstMotion(static_cast<int>(p)), count = bodies.parts()[p].free.cols();
    if (count == 0) continue;
    const Vector rest = data.rows.middleCols(first, count).transpose() * force - data.work.segment(first, count);
    if (rest.norm() <= kNegligibleEnergyNorm * std::sqrt(largest(at) * stiffness[p])) continue;
    size[p] = std::max(size[p], kLent * std::sqrt(std::max(energy(at), 0.0) * stiffness[p]));
    most = std::max(most, rest.norm() / size[p]);
  }
  return most;
}

}  // namespace suture
