#include <suture/algebra/DisjointSets.hpp>
#include <suture/answer/solvability/PairClasses.hpp>
#include <suture/base/Collective.hpp>
#include <suture/elasticity/loads/NodalLoads.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kNoForce = 1e-12, kNoHold = 1e-8;  // relative to the largest pair force on a body
constexpr double kNoCluster = 1e-13;         // relative to the largest pair force on bodies joined by pairs: smaller forces are round-off
constexpr double kLastDigit = 16 * 1.1e-16;  // relative to a displacement: a few round-off errors
constexpr double kWholeCircle = 6.28;        // times the radius: width on which forces of axisymmetric scenes act
constexpr double kNoGap = 1e-6;              // relative to the largest change of a gap on a body
constexpr double kFlat = 1e-6;               // relative to a body's size: least scale of gap changes

/// The largest value among the pairs of each part.
std::vector<double> largestOf(const RigidBodyModel::Pairs& data, std::size_t parts, const Vector& values) {
  std::vector<double> most(parts, 0.0);
  for (std::size_t i = 0; i < data.bodies.size(); ++i)
    for (const int part : data.bodies[i]) most[part] = std::max(most[part], values(static_cast<Eigen::Index>(i)));
  return most;
}

/// Round-off of forces on each part: from the largest load or pair force on any part that is connected with it by pairs, closed or open. If
/// no load is among them, all forces come from prescribed displacements and have the uncertainty of their last digits.
std::vector<double> roundingOf(const RigidBodyModel::Pairs& data, const std::vector<double>& force, const ForceScales& scales) {
  const std::size_t parts = force.size();
  DisjointSets neighbours(static_cast<int>(parts));
  for (const auto& bodies : data.bodies)
    for (const int part : bodies) neighbours.join(part, bodies.front());
  struct Cluster {
    double force = 0.0, loads = 0.0, way = 0.0;
  };
  std::vector<Cluster> clusters(parts);
  const auto clusterOf = [&](std::size_t p) -> Cluster& { return clusters[std::size_t(neighbours.lowest(static_cast<int>(p)))]; };
  for (std::size_t p = 0; p < parts; ++p) {
    Cluster& own = clusterOf(p);
    own.force = std::max({own.force, force[p], scales.loads[p]});
    own.loads += scales.loads[p];
    own.way = std::max(own.way, scales.ways[p]);
  }
  std::vector<double> rounding(parts);
  for (std::size_t p = 0; p < parts; ++p) {
    const Cluster& own = clusterOf(p);
    rounding[p] = std::max(kNoCluster * own.force, own.loads == 0.0 ? own.way : 0.0);
  }
  return rounding;
}

}  // namespace

PairsAtSolution broadcastPairs(const Comm& comm, const std::vector<PairResult>& results, int count) {
  PairsAtSolution pairs{Vector::Zero(count), Vector::Zero(count), Vector::Zero(count), ClosedSet(count, 0)};
  Matrix all = Matrix::Zero(count, 4);
  if (comm.getRank() == 0)
    for (const PairResult& pair : results)
      if (pair.id < count)
        all.row(pair.id) << std::max(pair.kind.separates ? pair.force : std::abs(pair.force), norm(pair.tangential)), pair.gap,
            pair.initialGap, pair.state.closed();
  broadcastBytes(comm, all.data(), sizeof(double) * static_cast<std::size_t>(all.size()));
  pairs.force = all.col(0).cwiseMax(0.0);
  pairs.gap = all.col(1);
  pairs.change = (all.col(1) - all.col(2)).cwiseAbs();
  for (int i = 0; i < count; ++i) pairs.closed[i] = all(i, 3) != 0.0;
  return pairs;
}

ForceScales forceScales(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const ContactBodies& bodies,
                        const std::vector<Vector>& displacement) {
  const std::size_t parts = bodies.parts().size();
  ForceScales mine{std::vector<double>(parts, 0.0), std::vector<double>(parts, 0.0)}, all = mine;
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    const std::size_t part = std::size_t(bodies.partOf(static_cast<int>(s)));
    mine.loads[part] += subdomainLoads(meshes[s], model).lpNorm<1>();
    const Vector& motion = meshes[s].lift.motion.size() > 0 ? meshes[s].lift.motion : displacement[s];
    if (motion.size() == 0) continue;
    double young = 0.0;
    for (int e = 0; e < meshes[s].elements(); ++e) young = std::max(young, model.materialOf(meshes[s], e, meshes[s].body).young);
    const double width = meshes[s].axisymmetric ? kWholeCircle * bodies.parts()[part].radius : 1.0;
    mine.ways[part] = std::max(mine.ways[part], kLastDigit * young * width * motion.lpNorm<Eigen::Infinity>());
  }
  const int count = static_cast<int>(parts);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, count, mine.loads.data(), all.loads.data());
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, count, mine.ways.data(), all.ways.data());
  return all;
}

PairClasses classify(const ContactBodies& bodies, const PairsAtSolution& pairs, const ForceScales& scales) {
  const RigidBodyModel::Pairs& data = bodies.rigid().data();
  const int count = bodies.rigid().pairs();
  const std::vector<double> force = largestOf(data, bodies.parts().size(), pairs.force),
                            change = largestOf(data, bodies.parts().size(), pairs.change);
  const std::vector<double> rounding = roundingOf(data, force, scales);
  PairClasses classes{ClosedSet(count, 0), ClosedSet(count, 0), ClosedSet(count, 0)};
  for (int i = 0; i < count; ++i) {
    if (bodies.rigid().isBound(static_cast<std::size_t>(i))) classes.carrying[i] = 1;  // pairs that never open hold at any force
    if (!data.canChange[i]) continue;
    double least = 0.0, moved = 0.0, none = bodies.rigid().rounding()(i);
    for (const int part : data.bodies[i]) {
      none = std::max(none, rounding[part]);
      least = least == 0.0 ? force[part] : std::min(least, force[part]);
      moved = std::max({moved, change[part], kFlat * bodies.parts()[part].radius});
    }
    classes.carrying[i] = pairs.closed[i] && pairs.force(i) > std::max(kNoHold * least, none);
    classes.idle[i] = pairs.closed[i] && pairs.force(i) <= std::max(kNoForce * least, none);
    classes.touching[i] = !classes.carrying[i] && pairs.gap(i) <= kNoGap * moved;
  }
  return classes;
}

}  // namespace suture
