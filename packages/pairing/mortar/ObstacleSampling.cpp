#include <suture/pairing/mortar/ObstacleSampling.hpp>

namespace suture {

ObstacleSampling::ObstacleSampling(const ContactSurface& contact) : contact_(contact), hats_(vertexHats(*contact.a.surface)) {
  for (int side = 0; side < contact.a.surface->sides(); ++side) own_.emplace_back(*contact.a.surface, side);
}

Point ObstacleSampling::meanNormal(int side, int node) const {
  const MortarFace& own = own_[side];
  return contact_.direction == Contact::Direction::Side ? own.normal(node) : contact_.obstacle->from(own.points()[node]).normal;
}

MortarSamples ObstacleSampling::sample(int side, const Point& normal) const {
  const MortarFace& own = own_[side];
  MortarSamples samples;
  samples.covered = 1.0;
  for (const auto& [at, weight] : own.quadrature()) {
    MortarSample sample;
    sample.at = at;
    const Point from = own.at(at);
    sample.weight = weight * norm(own.density(at));
    // Where the normal of the condition leads past the obstacle the distance is as good.
    sample.gap = contact_.initialGap ? contact_.initialGap->at(from)
                                     : contact_.obstacle->way(from, normal).value_or(contact_.obstacle->from(from).gap);
    samples.all.push_back(sample);
  }
  return samples;
}

}  // namespace suture
