#include <suture/answer/verdict/Balance.hpp>
#include <suture/base/Point.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

void Balance::addNode(const Point& load, const Point& support, const NodeRule* rule, int dimension, bool isRigid) {
  for (int k = 0; k < dimension; ++k) applied[k] += load[k];
  absolute_ += norm(load);
  if (!rule) return;
  for (int k = 0; k < dimension; ++k) {
    if (!rule->fixed[k] && !isRigid) continue;
    const Point& axis = rule->axes[k];
    const double along = dot(support, axis);
    for (int c = 0; c < dimension; ++c) reactions[c] += along * axis[c];
    absolute_ += std::abs(along);
  }
}

void Balance::addSupports(const Vector& forces, int dimension) {
  for (Eigen::Index i = 0; i < forces.size(); i += dimension) {
    Point force{0, 0, 0};
    std::copy_n(forces.data() + i, dimension, force.begin());
    reactions = plus(reactions, force);
    absolute_ += norm(force);
  }
}

void Balance::leaveOut(const Point& load) { applied = minus(applied, load); }

void Balance::addPair(const ContactPair& pair, const Point& onB) {
  const Point obstacle = obstacleForce(pair, onB);
  reactions = plus(reactions, obstacle);
  absolute_ += norm(obstacle);
}

void Balance::finish(const Comm& comm, bool axisymmetric) {
  double mine[7], all[7];
  std::copy(applied.begin(), applied.end(), mine);
  std::copy(reactions.begin(), reactions.end(), mine + 3);
  mine[6] = absolute_;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 7, mine, all);
  std::copy(all, all + 3, applied.begin());
  std::copy(all + 3, all + 6, reactions.begin());
  absolute_ = all[6];
  finish(axisymmetric);
}

void Balance::finish(bool axisymmetric) {
  // Radial forces of a body of revolution balance around the circle, independent of their magnitudes.
  const Point sum{axisymmetric ? 0.0 : applied[0] + reactions[0], applied[1] + reactions[1], applied[2] + reactions[2]};
  imbalance = absolute_ > 0.0 ? norm(sum) / (0.5 * absolute_) : 0.0;
}

}  // namespace suture
