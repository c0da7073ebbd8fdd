#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/answer/values/RigidGroupMotions.hpp>
#include <suture/base/Gather.hpp>
#include <suture/base/RigidFrame.hpp>
#include <suture/base/RigidValues.hpp>

#include <algorithm>
#include <map>
#include <tuple>

namespace suture {

namespace {

/// A node of a rigid group. Trivially copyable.
struct Member {
  int condition = -1, dimension = 2;
  bool axisymmetric = false;
  GlobalId node = -1;
  Point point{0, 0, 0}, place{0, 0, 0}, moved{0, 0, 0};
  Point shifted{0, 0, 0}, turned{0, 0, 0};  // RigidGroup::moved, turned
};

RigidGroupMotion motionOf(const std::vector<Member>& nodes) {
  const int dimension = nodes.front().dimension, amplitudes = rigidMotions(dimension);
  std::vector<Point> places;
  for (const Member& one : nodes) places.push_back(one.place);
  const RigidFrame frame = RigidFrame::around(places);
  Matrix motion(static_cast<Eigen::Index>(nodes.size()) * dimension, amplitudes);
  Vector moved(motion.rows());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto first = static_cast<Eigen::Index>(i) * dimension;
    motion.middleRows(first, dimension) = frame.at(nodes[i].place, dimension);
    moved.segment(first, dimension) = Eigen::Map<const Vector>(nodes[i].moved.data(), dimension);
  }
  if (nodes.front().axisymmetric) motion.col(0).setZero(), motion.col(2).setZero();  // it only moves along the axis
  const SingularValues parts = singularValues(motion.transpose() * motion);
  const Vector along = parts.u.transpose() * (motion.transpose() * moved);
  Vector found = Vector::Zero(amplitudes);
  for (Eigen::Index k = 0; k < amplitudes; ++k)
    if (parts.values[k] > 1e-12 * parts.values[0]) found += along[k] / parts.values[k] * parts.v.col(k);
  RigidGroupMotion all;
  all.condition = nodes.front().condition;
  all.point = nodes.front().point;
  Point shift, turn;
  splitAmplitudes(found, dimension, shift, turn);
  all.rotation = scaled(1.0 / frame.radius, turn);
  all.displacement = rigidDisplacement(shift, all.rotation, minus(all.point, frame.centre));
  // Beside the motion of the mesh from the drawn body, which a solution leaves only a small rest of.
  all.point = minus(all.point, nodes.front().shifted);
  all.displacement = plus(all.displacement, nodes.front().shifted);
  all.rotation = plus(all.rotation, nodes.front().turned);
  return all;
}

}  // namespace

std::vector<RigidGroupMotion> rigidGroupMotions(const Comm& comm, const std::vector<SubdomainMesh>& meshes,
                                                const std::vector<Vector>& displacement) {
  std::vector<Member> mine;
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    const SubdomainMesh& mesh = meshes[s];
    for (const RigidGroup& group : mesh.rigidGroups)
      for (const int node : group.nodes) {
        if (!counts(mesh, node)) continue;
        Member& one = mine.emplace_back();
        one.condition = group.condition;
        one.dimension = mesh.dimension;
        one.axisymmetric = mesh.axisymmetric;
        one.node = mesh.globalNodes[static_cast<std::size_t>(node)];
        one.point = group.point;
        one.shifted = group.moved;
        one.turned = group.turned;
        one.place = mesh.point(node);
        for (int k = 0; k < mesh.dimension; ++k)
          one.moved[static_cast<std::size_t>(k)] = mesh.total(displacement[s], Eigen::Index(node) * mesh.dimension + k);
      }
  }
  std::vector<Member> all = joinOnRoot(comm, mine);
  std::sort(all.begin(), all.end(),
            [](const Member& a, const Member& b) { return std::tie(a.condition, a.node) < std::tie(b.condition, b.node); });
  std::map<int, std::vector<Member>> groups;
  for (const Member& one : all) groups[one.condition].push_back(one);
  std::vector<RigidGroupMotion> motions;
  for (const auto& entry : groups) motions.push_back(motionOf(entry.second));
  return motions;
}

}  // namespace suture
