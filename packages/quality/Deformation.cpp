#include <suture/base/RigidValues.hpp>
#include <suture/quality/Deformation.hpp>
#include <suture/quality/Findings.hpp>
#include <suture/quality/PairResult.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

template <int width>
using Sums = std::vector<std::array<double, width>>;

template <int width>
Sums<width> reduced(const Comm& comm, const Sums<width>& mine, Teuchos::EReductionType how) {
  Sums<width> all(mine.size());
  if (!mine.empty()) Teuchos::reduceAll(comm, how, int(mine.size()) * width, mine.front().data(), all.front().data());
  return all;
}

/// visit(body, place, displacement) at every node, once over all ranks.
template <typename Visit>
void forEachNode(const std::vector<SubdomainMesh>& meshes, const std::vector<Vector>& displacement, const Visit& visit) {
  for (std::size_t i = 0; i < meshes.size(); ++i)
    for (int node = 0; node < meshes[i].nodes(); ++node) {
      if (!counts(meshes[i], node)) continue;
      Point u{0, 0, 0};
      for (int k = 0; k < meshes[i].dimension; ++k) u[k] = displacement[i][Eigen::Index(node) * meshes[i].dimension + k];
      visit(meshes[i].body, meshes[i].point(node), u);
    }
}

constexpr double kExplained = 100.0;  // ratio of a body's motion in a turn to the largest deformation of any body: levers have less

struct Motion {
  Point shift{0, 0, 0};
  double turn = 0.0;
};

}  // namespace

std::vector<Deformation> deformations(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<Vector>& displacement,
                                      int bodies) {
  std::vector<Deformation> all(bodies);
  std::vector<Motion> motion(bodies);
  Sums<5> means(bodies, {0, 0, 0, 0, 0});
  forEachNode(meshes, displacement, [&](int body, const Point& x, const Point& u) {
    auto& sum = means[body];
    sum[0] += 1.0;
    for (int k = 0; k < 2; ++k) sum[1 + k] += x[k], sum[3 + k] += u[k];
  });
  means = reduced<5>(comm, means, Teuchos::REDUCE_SUM);
  Sums<1> revolved(1, {0.0});
  for (const SubdomainMesh& mesh : meshes) revolved[0][0] = std::max(revolved[0][0], mesh.axisymmetric ? 1.0 : 0.0);
  const bool axisymmetric = reduced<1>(comm, revolved, Teuchos::REDUCE_MAX)[0][0] > 0.0;
  for (int b = 0; b < bodies; ++b)
    for (int k = 0; k < 2 && means[b][0] > 0.0; ++k) {
      all[b].centre[k] = means[b][1 + k] / means[b][0];
      motion[b].shift[k] = axisymmetric && k == 0 ? 0.0 : means[b][3 + k] / means[b][0];
    }
  // A second pass corrects the mean: the first one has rounded as often as there are nodes.
  Sums<4> turns(bodies, {0, 0, 0, 0});
  forEachNode(meshes, displacement, [&](int body, const Point& x, const Point& u) {
    const Point arm = minus(x, all[body].centre), rest = minus(u, motion[body].shift);
    turns[body][0] += dot(arm, arm);
    turns[body][1] += cross(arm, rest)[2];
    for (int k = 0; k < 2; ++k) turns[body][2 + k] += rest[k];
  });
  turns = reduced<4>(comm, turns, Teuchos::REDUCE_SUM);
  for (int b = 0; b < bodies; ++b) {
    for (int k = axisymmetric ? 1 : 0; k < 2 && means[b][0] > 0.0; ++k) motion[b].shift[k] += turns[b][2 + k] / means[b][0];
    if (!axisymmetric && turns[b][0] > 0.0) motion[b].turn = turns[b][1] / turns[b][0];
  }
  Sums<4> largest(bodies, {0, 0, 0, 0});
  forEachNode(meshes, displacement, [&](int body, const Point& x, const Point& u) {
    const Point arm = minus(x, all[body].centre);
    const Motion& rigid = motion[body];
    const Point rest = minus(minus(u, rigid.shift), rigidDisplacement<double>({0, 0, 0}, {0, 0, rigid.turn}, arm));
    auto& own = largest[body];
    own[0] = std::max(own[0], length(rest[0], rest[1]));
    own[1] = std::max({own[1], std::abs(u[0]), std::abs(u[1])});
    own[2] = std::max(own[2], length(arm[0], arm[1]));
  });
  for (const SubdomainMesh& mesh : meshes)
    for (const NodeRule& rule : mesh.rules)
      for (int k = 0; k < mesh.dimension; ++k)
        if (rule.fixed[k] && rule.value[k] != 0.0) largest[mesh.body][3] = 1.0;
  largest = reduced<4>(comm, largest, Teuchos::REDUCE_MAX);
  for (int b = 0; b < bodies; ++b) {
    all[b].largest = largest[b][0];
    all[b].moved = largest[b][1];
    all[b].extent = largest[b][2];
    all[b].isMoved = largest[b][3] > 0.0;
    all[b].turn = std::abs(motion[b].turn);
  }
  return all;
}

double unexplainedTurn(const std::vector<Deformation>& all, int body) {
  double around = 0.0;
  for (const Deformation& other : all) {
    if (other.isMoved) return 0.0;
    around = std::max(around, other.largest);
  }
  return all[body].turn * all[body].extent > kExplained * around ? all[body].turn : 0.0;
}

}  // namespace suture
