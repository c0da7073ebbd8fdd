#include <suture/answer/values/Reactions.hpp>
#include <suture/base/Point.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace suture {

namespace {

void addForces(const SubdomainMesh& mesh, const Vector& forces, Resultant& sum) {
  for (int node = 0; node < mesh.nodes(); ++node) {
    Point force{0, 0, 0};
    for (int k = 0; k < mesh.dimension; ++k) force[k] = forces[Eigen::Index(node) * mesh.dimension + k];
    if (force != Point{0, 0, 0}) sum.add(mesh.point(node), force);
  }
}

Resultant& at(std::vector<Resultant>& all, int number) {
  if (number >= static_cast<int>(all.size())) all.resize(number + 1);
  return all[number];
}

}  // namespace

void Resultant::add(const Point& place, const Point& more) {
  force = plus(force, more);
  moment = plus(moment, cross(place, more));
}

void Resultant::add(const Resultant& other, double factor) {
  force = plus(force, scaled(factor, other.force));
  moment = plus(moment, scaled(factor, other.moment));
}

void Reactions::addSupport(const SubdomainMesh& mesh, const Support& support, const Point& force) {
  at(supports, support.condition).add(mesh.point(support.node), scaled(dot(support.along, force), support.direction));
}

void Reactions::addLoad(const SubdomainMesh& mesh, int number, const Vector& forces) { addForces(mesh, forces, at(loads, number)); }

void Reactions::addSpring(const SubdomainMesh& mesh, int number, const Vector& forces) { addForces(mesh, forces, at(springs, number)); }

void Reactions::addOwn(const SubdomainMesh& mesh, const Vector& forces) { addForces(mesh, forces, own); }

void Reactions::finish(const Comm& comm, bool axisymmetric) {
  std::array<std::vector<Resultant>*, 3> lists{&supports, &loads, &springs};
  int mine[3], most[3];
  for (std::size_t i = 0; i < lists.size(); ++i) mine[i] = static_cast<int>(lists[i]->size());
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 3, mine, most);
  for (std::size_t i = 0; i < lists.size(); ++i) lists[i]->resize(most[i]);
  std::vector<Resultant*> each{&own};
  for (std::vector<Resultant>* list : lists)
    for (Resultant& one : *list) each.push_back(&one);
  std::vector<double> values, sums;
  for (const Resultant* one : each) {
    values.insert(values.end(), one->force.begin(), one->force.end());
    values.insert(values.end(), one->moment.begin(), one->moment.end());
  }
  sums.resize(values.size());
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, static_cast<int>(values.size()), values.data(), sums.data());
  for (std::size_t i = 0; i < each.size(); ++i) {
    std::copy_n(sums.data() + 6 * i, 3, each[i]->force.begin());
    std::copy_n(sums.data() + 6 * i + 3, 3, each[i]->moment.begin());
    if (axisymmetric) each[i]->moment = {0, 0, 0};
  }
}

namespace {

/// Ratio of a resultant to the sum of force magnitudes above which it exceeds the solver's residual of cancelling forces: a smaller
/// resultant has no centre.
constexpr double kPresses = 1e-6;

/// A resultant while pairs are added to it.
struct Sum {
  ContactResultant result;
  double size = 0.0;  // sum of the magnitudes of the forces

  void add(const PairResult& pair) {
    for (std::size_t side = 0; side < 2; ++side) {
      std::vector<int>& bodies = result.bodies[side];
      const auto at = std::lower_bound(bodies.begin(), bodies.end(), pair.bodies[side]);
      if (pair.bodies[side] >= 0 && (at == bodies.end() || *at != pair.bodies[side])) bodies.insert(at, pair.bodies[side]);
    }
    result.pairs += 1;
    result.whole += pair.length;
    if (pair.state.closed()) result.active += 1, result.closed += pair.length;
    result.onB.add(pair.position, pair.onB());
    result.pressing += pair.force;
    size += norm(pair.onB());
    result.centre = plus(result.centre, scaled(pair.force, pair.position));
  }

  ContactResultant finished(bool axisymmetric) && {
    if (std::abs(result.pressing) <= kPresses * size) result.pressing = 0.0;
    if (result.presses()) result.centre = scaled(1.0 / result.pressing, result.centre);
    if (axisymmetric) result.onB.moment = {0, 0, 0};
    return std::move(result);
  }
};

}  // namespace

std::vector<ContactResultant> contactResultants(const std::vector<PairResult>& pairs, int lines, bool axisymmetric) {
  std::vector<Sum> sums(static_cast<std::size_t>(lines));
  std::vector<std::map<std::array<int, 2>, Sum>> parts(sums.size());
  for (const PairResult& pair : pairs) {
    if (pair.line < 0 || pair.line >= lines) continue;
    sums[static_cast<std::size_t>(pair.line)].add(pair);
    parts[static_cast<std::size_t>(pair.line)][pair.bodies].add(pair);
  }
  std::vector<ContactResultant> all;
  for (std::size_t line = 0; line < sums.size(); ++line) {
    all.push_back(std::move(sums[line]).finished(axisymmetric));
    if (parts[line].size() < 2) continue;
    for (auto& [bodies, part] : parts[line]) all.back().ofBodies.push_back(std::move(part).finished(axisymmetric));
  }
  return all;
}

}  // namespace suture
