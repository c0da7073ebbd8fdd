#include <suture/pairs/mortar/ObstacleSampling.hpp>

namespace suture {

ObstacleSampling::ObstacleSampling(const ContactSurface& contact) : contact_(contact) {
  for (int side = 0; side < contact.a.surface->sides(); ++side) own_.emplace_back(*contact.a.surface, side);
}

int ObstacleSampling::functions(int side, bool) const { return own_[side].multipliers(contact_.multipliers); }

Point ObstacleSampling::rowNormal(int side, int node) const {
  const MortarFace& own = own_[side];
  return contact_.direction == Contact::Direction::Side ? own.normal(node) : contact_.obstacle->from(own.points()[node]).normal;
}

MortarSamples ObstacleSampling::sample(int side, const Point& normal) const {
  const MortarFace& own = own_[side];
  MortarSamples samples;
  samples.covered = 1.0;
  samples.reach.fill(1.0);
  for (const auto& [at, weight] : own.quadrature()) {
    MortarSample sample;
    const MortarFace::Place place = own.place(at);
    const Point& from = place.point;
    sample.at = at;
    sample.own = place.values;
    sample.weight = weight * norm(place.density);
    // If the normal of the condition misses the obstacle, the shortest distance serves as well.
    sample.gap = contact_.initialGap ? contact_.initialGap->at(from)
                                     : contact_.obstacle->way(from, normal).value_or(contact_.obstacle->from(from).gap);
    samples.all.push_back(sample);
  }
  return samples;
}

}  // namespace suture
