#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/answer/PairResult.hpp>
#include <suture/answer/verdict/Deformation.hpp>
#include <suture/answer/verdict/Findings.hpp>
#include <suture/base/RigidValues.hpp>

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

/// Calls visit(body, position, displacement) at every node, once over all ranks.
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

constexpr double kOnALine = 1e-12;  // fraction of the largest moment of inertia that counts as round-off: the nodes lie on the axis
// Ratio of a body's motion by rotation to the largest deformation or prescribed displacement of any body; levers have smaller ratios.
constexpr double kExplained = 100.0;

struct Motion {
  Point shift{0, 0, 0}, turn{0, 0, 0};
};

/// Sums over the vectors from a centre to the nodes, in this order: inertia (xx, yy, zz, xy, yz, xz) of unit masses, moment of
/// displacements, displacements.
using TurnSums = std::array<double, 12>;

void add(const Point& arm, const Point& displacement, TurnSums& sums) {
  const double xx = arm[0] * arm[0], yy = arm[1] * arm[1], zz = arm[2] * arm[2];
  const Point moment = cross(arm, displacement);
  sums[0] += yy + zz;
  sums[1] += xx + zz;
  sums[2] += xx + yy;
  sums[3] -= arm[0] * arm[1];
  sums[4] -= arm[1] * arm[2];
  sums[5] -= arm[0] * arm[2];
  for (int k = 0; k < 3; ++k) sums[6 + k] += moment[k], sums[9 + k] += displacement[k];
}

/// Best-fit rotation vector: inertia x turn = moment; none about a line that contains all nodes. In 2D about the third axis only.
Point turnOf(const TurnSums& sums, int dimension) {
  if (dimension == 2) return {0, 0, sums[2] > 0.0 ? sums[8] / sums[2] : 0.0};
  Matrix inertia(3, 3);
  inertia << sums[0], sums[3], sums[5], sums[3], sums[1], sums[4], sums[5], sums[4], sums[2];
  const Eigenpairs axes = symmetricEigenpairs(inertia);
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k)
    if (axes.values[k] > kOnALine * axes.values[2])
      turn += axes.vectors.col(k) * (axes.vectors.col(k).dot(Eigen::Map<const Eigen::Vector3d>(&sums[6])) / axes.values[k]);
  return {turn[0], turn[1], turn[2]};
}

}  // namespace

std::vector<Deformation> deformations(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<Vector>& displacement,
                                      int bodies) {
  std::vector<Deformation> all(bodies);
  std::vector<Motion> motion(bodies);
  Sums<7> means(bodies, {0, 0, 0, 0, 0, 0, 0});
  forEachNode(meshes, displacement, [&](int body, const Point& x, const Point& u) {
    auto& sum = means[body];
    sum[0] += 1.0;
    for (int k = 0; k < 3; ++k) sum[1 + k] += x[k], sum[4 + k] += u[k];
  });
  means = reduced<7>(comm, means, Teuchos::REDUCE_SUM);
  Sums<2> kind(1, {2.0, 0.0});
  for (const SubdomainMesh& mesh : meshes) kind[0] = {double(mesh.dimension), std::max(kind[0][1], mesh.axisymmetric ? 1.0 : 0.0)};
  kind = reduced<2>(comm, kind, Teuchos::REDUCE_MAX);
  const int dimension = int(kind[0][0]);
  const bool axisymmetric = kind[0][1] > 0.0;
  for (int b = 0; b < bodies; ++b)
    for (int k = 0; k < dimension && means[b][0] > 0.0; ++k) {
      all[b].centre[k] = means[b][1 + k] / means[b][0];
      motion[b].shift[k] = axisymmetric && k == 0 ? 0.0 : means[b][4 + k] / means[b][0];
    }
  // A second pass corrects the mean, because the first one accumulates one round-off per node.
  Sums<12> turns(bodies, TurnSums{});
  forEachNode(meshes, displacement, [&](int body, const Point& x, const Point& u) {
    add(minus(x, all[body].centre), minus(u, motion[body].shift), turns[body]);
  });
  turns = reduced<12>(comm, turns, Teuchos::REDUCE_SUM);
  for (int b = 0; b < bodies; ++b) {
    for (int k = axisymmetric ? 1 : 0; k < dimension && means[b][0] > 0.0; ++k) motion[b].shift[k] += turns[b][9 + k] / means[b][0];
    if (!axisymmetric) motion[b].turn = turnOf(turns[b], dimension);
  }
  Sums<4> largest(bodies, {0, 0, 0, 0});
  forEachNode(meshes, displacement, [&](int body, const Point& x, const Point& u) {
    const Point arm = minus(x, all[body].centre);
    const Motion& rigid = motion[body];
    const Point rest = minus(minus(u, rigid.shift), rigidDisplacement<double>({0, 0, 0}, rigid.turn, arm));
    auto& own = largest[body];
    own[0] = std::max(own[0], length(rest));
    own[1] = std::max({own[1], std::abs(u[0]), std::abs(u[1]), std::abs(u[2])});
    own[2] = std::max(own[2], length(arm));
  });
  for (const SubdomainMesh& mesh : meshes)
    for (const NodeRule& rule : mesh.rules) {
      double squared = 0.0;
      for (int k = 0; k < mesh.dimension; ++k)
        if (rule.fixed[k]) squared += rule.value[k] * rule.value[k];
      largest[mesh.body][3] = std::max(largest[mesh.body][3], std::sqrt(squared));
    }
  largest = reduced<4>(comm, largest, Teuchos::REDUCE_MAX);
  for (int b = 0; b < bodies; ++b) {
    all[b].largest = largest[b][0];
    all[b].moved = largest[b][1];
    all[b].extent = largest[b][2];
    all[b].prescribed = largest[b][3];
    all[b].turn = length(motion[b].turn);
    all[b].rotation = motion[b].turn;
  }
  return all;
}

double unexplainedTurn(const std::vector<Deformation>& all, int body) {
  double around = 0.0;
  for (const Deformation& other : all) around = std::max({around, other.largest, other.prescribed});
  return all[body].turn * all[body].extent > kExplained * around ? all[body].turn : 0.0;
}

}  // namespace suture
