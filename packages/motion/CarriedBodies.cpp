#include <suture/base/Gather.hpp>
#include <suture/elasticity/loads/NodalLoads.hpp>
#include <suture/motion/CarriedBodies.hpp>
#include <suture/search/RigidBodyModel.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace suture {

namespace {

constexpr double kFar = 1e3;           // relative to the compression of a part's pads: a thousandfold motion costs three digits
constexpr double kCoincident = 1e-12;  // relative to the coordinates
constexpr double kNoWork = 1e-12;      // relative to the sum of magnitudes: round-off of balanced loads

/// End of a pair, and its normal displacement under the motions of its part. Trivially copyable.
struct PadEnd {
  int pair, end, line, part;
  double gap, young, amplitudes[6];
};

double reduced(const Comm& comm, Teuchos::EReductionType how, double mine) {
  double all = 0.0;
  Teuchos::reduceAll(comm, how, mine, Teuchos::outArg(all));
  return all;
}

std::vector<PadEnd> endsOf(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const BodyParts& parts) {
  std::vector<PadEnd> mine;
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    const SubdomainMesh& mesh = meshes[s];
    if (mesh.contactEnds.empty()) continue;
    std::map<int, const ContactPair*> pairs;
    for (const ContactRow& row : mesh.contactRows) pairs[row.pair.id] = &row.pair;
    double young = 0.0;
    for (int e = 0; e < mesh.elements(); ++e) young = std::max(young, model.materialOf(mesh, e, mesh.body).young);
    for (const SubdomainMesh::ContactEnd& end : mesh.contactEnds) {
      if (!counts(mesh, end.node)) continue;
      const ContactPair& pair = *pairs.at(end.pair);
      PadEnd own{end.pair, end.end, pair.line, parts.partOf[s], pair.gap, young, {}};
      const Vector felt = along(parts.parts[own.part], mesh.point(end.node), pair.normal, mesh.dimension);
      for (Eigen::Index k = 0; k < felt.size(); ++k) own.amplitudes[k] = pair.ends[end.end].weight * felt[k];
      mine.push_back(own);
    }
  }
  std::vector<PadEnd> all = joinEverywhere(comm, mine);
  std::sort(all.begin(), all.end(), [](const PadEnd& a, const PadEnd& b) { return a.pair != b.pair ? a.pair < b.pair : a.end < b.end; });
  return all;
}

/// Work of the loads in unit free motions.
Vector workOf(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const BodyParts& parts,
              const std::vector<int>& first, int motions) {
  Matrix mine = Matrix::Zero(motions, 2), all = mine;  // work, and the sum of the magnitudes of its terms
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    const RigidPart& part = parts.parts[parts.partOf[s]];
    const SubdomainMesh& mesh = meshes[s];
    if (part.free.cols() == 0) continue;
    const Vector load = subdomainLoads(mesh, model);
    for (int node = 0; node < mesh.nodes(); ++node) {
      const auto force = load.segment(Eigen::Index(node) * mesh.dimension, mesh.dimension);
      if (force.isZero(0.0)) continue;
      const Vector own = part.free.transpose() * (part.at(mesh.point(node), mesh.dimension).transpose() * force);
      mine.col(0).segment(first[parts.partOf[s]], own.size()) += own;
      mine.col(1).segment(first[parts.partOf[s]], own.size()) += own.cwiseAbs();
    }
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, int(mine.size()), mine.data(), all.data());
  Vector work = all.col(0);
  for (int k = 0; k < motions; ++k)
    if (std::abs(work(k)) <= kNoWork * all(k, 1)) work(k) = 0.0;
  return work;
}

}  // namespace

bool hasGaps(const Comm& comm, const std::vector<SubdomainMesh>& meshes) {
  double gap = 0.0, size = 0.0;
  for (const SubdomainMesh& mesh : meshes) {
    for (const ContactRow& row : mesh.contactRows) gap = std::max(gap, std::abs(row.pair.gap));
    for (int node = 0; node < mesh.nodes(); ++node)
      for (int k = 0; k < mesh.dimension; ++k) size = std::max(size, std::abs(mesh.point(node)[k]));
  }
  return reduced(comm, Teuchos::REDUCE_MAX, gap) > kCoincident * reduced(comm, Teuchos::REDUCE_MAX, size);
}

std::vector<Vector> carriedMotions(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                   const BodyParts& parts) {
  const int amplitudes = int(parts.lift.front().size());
  std::vector<Vector> carried(parts.parts.size(), Vector::Zero(amplitudes));
  std::vector<int> first;
  int motions = 0;
  for (const RigidPart& part : parts.parts) {
    first.push_back(motions);
    motions += int(part.free.cols());
  }
  if (motions == 0) return carried;
  const std::vector<PadEnd> ends = endsOf(comm, meshes, model, parts);
  const int count = ends.empty() ? 0 : ends.back().pair + 1;
  RigidBodyModel::Pairs pairs;
  std::vector<Eigen::Triplet<double, int>> entries;
  pairs.penetration = Vector::Zero(count);
  pairs.line.assign(count, -1);
  pairs.canChange.assign(count, 0);
  pairs.bodies.resize(count);
  Vector compliance = Vector::Zero(count);
  for (const PadEnd& end : ends) {
    const RigidPart& part = parts.parts[end.part];
    const Eigen::Map<const Vector> felt(end.amplitudes, amplitudes);
    pairs.penetration[end.pair] += felt.dot(parts.lift[end.part]);
    if (end.end == 0) pairs.penetration[end.pair] -= end.gap;
    const Vector effect = part.free.transpose() * felt;
    for (int k = 0; k < static_cast<int>(effect.size()); ++k) entries.emplace_back(end.pair, first[end.part] + k, effect(k));
    compliance[end.pair] += 1.0 / end.young;
    pairs.line[end.pair] = end.line;
    pairs.canChange[end.pair] = pairs.canChange[end.pair] || part.free.cols() > 0;
    std::vector<int>& bodies = pairs.bodies[end.pair];
    if (std::find(bodies.begin(), bodies.end(), end.part) == bodies.end()) bodies.push_back(end.part);
  }
  pairs.rows.resize(count, motions);
  pairs.rows.setFromTriplets(entries.begin(), entries.end());
  pairs.rows.prune(0.0);
  pairs.stiffness = compliance.cwiseMax(std::numeric_limits<double>::min()).cwiseInverse();
  pairs.work = workOf(comm, meshes, model, parts, first, motions);
  const Vector penetration = pairs.penetration;
  RigidBodyModel rigid(std::move(pairs));
  rigid.start();
  const RigidBodyModel::Equilibrium found = rigid.project(penetration);
  if (!found.found) return carried;
  ClosedSet carrying(count, 0);
  for (int i = 0; i < count; ++i) carrying[i] = found.force[i] > 0.0;
  const Vector least = rigid.leastMotion(carrying, found.motion, penetration + rigid.data().rows * found.motion);
  std::vector<double> pressed(carried.size(), 0.0);  // largest compression of a part's pads
  const Vector compression = found.force.cwiseProduct(rigid.compliance());
  for (const PadEnd& end : ends) pressed[end.part] = std::max(pressed[end.part], compression[end.pair]);
  for (std::size_t p = 0; p < carried.size(); ++p) {
    const RigidPart& part = parts.parts[p];
    const Vector motion = part.free * least.segment(first[p], part.free.cols());
    if (motion.norm() > kFar * pressed[p]) carried[p] = motion;
  }
  return carried;
}

}  // namespace suture
