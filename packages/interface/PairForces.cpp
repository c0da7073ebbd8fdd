#include <suture/base/Point.hpp>
#include <suture/interface/ContactProblem.hpp>
#include <suture/interface/PairForces.hpp>
#include <suture/pairs/PairFrame.hpp>

namespace suture {

Point PairForces::tangential(const ContactState& state) const {
  Point force{0, 0, 0};
  if (!state.closed()) return force;
  const Point across = acrossSlip(state);
  const double spring = state.transverseStiffness * dot(across, slip);
  for (int component = 1; component <= 2; ++component)
    force[component] = state.holds(component)
                           ? held[component]
                           : (state.bound + state.friction * normal) * state.direction[component] + spring * across[component];
  return force;
}

Point cartesian(const ContactPair& pair, int dimension, const Point& tangential) {
  const std::vector<Point> frame = pairFrame(pair, dimension);
  Point sum{0, 0, 0};
  for (int component = 1; component < dimension; ++component) sum = plus(sum, scaled(tangential[component], frame[component]));
  return sum;
}

void putPair(const ContactState& state, const PairForces& pair, Matrix& all, Eigen::Index row) {
  const Point force = pair.tangential(state);
  (state.closed() ? all(row, 0) : all(row, 3)) = state.closed() ? pair.normal : -pair.gap;
  for (int component = 1; component <= 2; ++component) {
    all(row, component) = force[component];
    if (!state.holds(component) || pair.isPrescribed[static_cast<std::size_t>(component)]) all(row, 3 + component) = pair.slip[component];
  }
  all(row, 6) = kGapDigits * pair.digits;
}

void putState(const ContactState& state, Matrix& all, Eigen::Index row) {
  all.row(row) << static_cast<double>(state.status), state.direction[0], state.direction[1], state.direction[2], state.bound,
      state.friction, state.transverseStiffness;
}

PairStates statesFrom(const Matrix& rows) {
  PairStates states;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    states.emplace_back(static_cast<PairStatus>(static_cast<int>(rows(i, 0))), Point{rows(i, 1), rows(i, 2), rows(i, 3)}, rows(i, 4),
                        rows(i, 5));
    states.back().transverseStiffness = rows(i, 6);
  }
  return states;
}

void putSite(const ContactPair& pair, const std::array<double, 2>& stiffness, Matrix& all, Eigen::Index row) {
  const int count = (stiffness[0] > 0.0) + (stiffness[1] > 0.0);
  all.row(row) << pair.position[0], pair.position[1], pair.position[2], pair.length,
      count > 0 ? (stiffness[0] + stiffness[1]) / count : 0.0, static_cast<double>(pair.past.slipped), 0.0;
}

std::vector<FrictionSite> sitesFrom(const Matrix& rows) {
  std::vector<FrictionSite> sites;
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    sites.push_back({{rows(i, 0), rows(i, 1), rows(i, 2)}, rows(i, 3), rows(i, 4), rows(i, 5) != 0.0});
  return sites;
}

}  // namespace suture
