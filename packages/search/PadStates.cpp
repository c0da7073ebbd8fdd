#include <suture/search/PadStates.hpp>
#include <suture/search/SoftBodies.hpp>

namespace suture {

namespace {

std::vector<FrictionCone> cones(const RigidBodyModel& rigid, const LawProjection& projection) {
  std::vector<FrictionCone> all;
  for (int i = 0; i < rigid.pairs(); ++i) all.push_back(projection.cone(static_cast<std::size_t>(i)));
  return all;
}

}  // namespace

PadStates::PadStates(const RigidBodyModel& rigid, const ContactLaws& laws, const LawProjection& projection)
    : rigid_(rigid), laws_(laws), projection_(projection), pads_(rigid.data(), cones(rigid, projection)) {}

PairStates PadStates::start(Vector& normal) const {
  Matrix t = Matrix::Zero(rigid_.pairs(), 3);
  t.col(0) = rigid_.data().penetration;
  const PadModel::Equilibrium pads = pads_.coulomb(t, rigid_.compliance());
  normal = pads.force.col(0);
  PairStates bound(static_cast<std::size_t>(rigid_.pairs()));
  for (std::size_t i = 0; i < bound.size(); ++i)
    if (rigid_.isBound(i)) bound[i] = laws_.of(rigid_.data().line[i]).pressed();
  return states(pads, std::move(bound));
}

PairStates PadStates::states(const PadModel::Equilibrium& pads, PairStates now) const {
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (!rigid_.data().canChange[i]) continue;
    const auto at = static_cast<Eigen::Index>(i);
    Point force{0, 0, 0}, jump{0, 0, 0};
    for (int k = 0; k < 3; ++k) force[k] = pads.force(at, k), jump[k] = pads.trial(at, k) - pads.force(at, k);
    now[i] = projection_.state(i, now[i], force, jump);
  }
  return now;
}

PadModel::Equilibrium PadStates::equilibrium(const ContactBalance& at, double softness) const {
  const Vector compliance = softness * rigid_.compliance();
  if (!projection_.isFrictionless())
    return pads_.coulomb(compliance.asDiagonal() * at.force + at.jump, compliance, at.jump.rightCols(2).rowwise().norm());
  const Vector t = rigid_.compliance().cwiseProduct(at.force.col(0)) + at.jump.col(0);
  Vector reached = t;
  RigidBodyModel::Equilibrium found;
  if (const SoftBodies* soft = rigid_.soft()) {
    found = soft->project(t, rigid_.compliance(), reached);
  } else {
    found = rigid_.project(t);  // accurate for light bodies, too
    if (rigid_.motions() > 0) reached += rigid_.data().rows * found.motion;
  }
  PadModel::Equilibrium pads;
  pads.found = found.found;
  pads.motion = found.motion;
  pads.force = pads.trial = Matrix::Zero(t.size(), 3);
  pads.force.col(0) = found.force;
  pads.trial.col(0) = reached.cwiseQuotient(rigid_.compliance());
  for (Eigen::Index i = 0; i < t.size(); ++i)
    if (found.force(i) > 0.0) pads.trial(i, 0) = found.force(i);
  return pads;
}

bool PadStates::loosens(const PairStates& states) const {
  return rigid_.loosens(states) || (rigid_.soft() && rigid_.soft()->loosens(states));
}

bool PadStates::near(const ContactBalance& at, double softness, const PairStates& now, PairStates& found) const {
  if (at.force.size() == 0) return false;
  const PadModel::Equilibrium pads = equilibrium(at, softness);
  if (pads.found) found = states(pads, now);
  return pads.found;
}

}  // namespace suture
