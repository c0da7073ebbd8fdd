#include <suture/answer/verdict/NodalForces.hpp>
#include <suture/answer/verdict/PathWork.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Point.hpp>
#include <suture/motion/BodyFrame.hpp>
#include <suture/partition/TurnFromDrawn.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace suture {

double PathWork::imbalance() const { return size > 0.0 ? std::abs(external - stored - normal - tangential) / size : 0.0; }

double PathWork::stepError() const { return size > 0.0 ? (std::abs(normal) + std::abs(dissipated - tangential)) / size : 0.0; }

namespace {

/// Forces of loads that are none of the scene, at a node.
Vector correctionAt(const ElasticModel& model, const SubdomainMesh& mesh, int node) {
  Vector sum = Vector::Zero(mesh.dimension);
  for (const Load& load : model.loads) {
    if (!load.isCorrection) continue;
    const auto found = load.forces.find(mesh.globalNodes[static_cast<std::size_t>(node)]);
    if (found == load.forces.end()) continue;
    for (int k = 0; k < mesh.dimension; ++k) sum[k] += load.factor * found->second[static_cast<std::size_t>(k)];
  }
  return sum;
}

/// Rotation vector of a rotation in two or three dimensions.
Point rotationOf(const Matrix& turn) {
  if (turn.isIdentity(0.0)) return {0, 0, 0};
  Eigen::Matrix3d whole = Eigen::Matrix3d::Identity();
  whole.topLeftCorner(turn.rows(), turn.cols()) = turn;
  return rotationVector(Eigen::Quaterniond(whole));
}

}  // namespace

WorkMeter::End WorkMeter::endOf(const Answer& answer) const {
  const SeamExchange seams(comm_, answer.meshes);
  const NodalForces forces = nodalForces(comm_, answer, seams);
  End end;
  end.pairs = answer.pairs;
  double stored = 0.0;
  for (std::size_t i = 0; i < answer.meshes.size(); ++i) {
    const SubdomainMesh& mesh = answer.meshes[i];
    const int d = mesh.dimension;
    const NodalRows rows{d};
    const Eigen::Map<const Matrix> u(answer.displacement[i].data(), d, mesh.nodes());
    std::vector<const NodeRule*> ruleOf(mesh.nodes(), nullptr);
    for (const NodeRule& rule : mesh.rules) ruleOf[rule.node] = &rule;
    const RigidGroupNodes rigid(mesh.rigidGroups, d);
    const Matrix none = Matrix::Zero(d, mesh.nodes());
    Matrix load = none, held = none, moved = none;
    for (int node = 0; node < mesh.nodes(); ++node) {
      if (!counts(mesh, node)) continue;
      const auto sums = forces.nodes[i].col(node);
      const Vector internal = sums.segment(rows.internal(), d), applied = sums.segment(rows.applied(), d),
                   lacking = internal - applied - sums.segment(rows.contact(), d);
      for (int k = 0; k < d; ++k)
        moved(k, node) = mesh.drawn.empty() ? u(k, node) : mesh.fromDrawn(answer.displacement[i], Eigen::Index(node) * d + k);
      load.col(node) = applied - correctionAt(answer.model, mesh, node);
      stored += 0.5 * internal.dot(u.col(node));
      const NodeRule* rule = ruleOf[node];
      for (int k = 0; rule && k < d; ++k) {
        if (!rule->fixed[k] && !rigid.contains(node)) continue;
        const Eigen::Map<const Vector> axis(rule->axes[k].data(), d);
        held.col(node) += axis.dot(lacking) * axis;  // force of the prescribed displacement, or of a rigid group
      }
    }
    end.load.push_back(std::move(load));
    end.held.push_back(std::move(held));
    end.turn.push_back(turnFromDrawn(mesh));
    end.displacement.push_back(std::move(moved));
  }
  Teuchos::reduceAll(comm_, Teuchos::REDUCE_SUM, stored, Teuchos::outArg(end.stored));
  return end;
}

void WorkMeter::goOnFrom(const Answer& answer, const PathWork& soFar) {
  before_ = endOf(answer);
  work_ = soFar;
  // Energy that parts of the scene contain which exist no more, or not yet, is not part of the balance.
  work_.external += before_.stored - work_.stored;
  work_.stored = before_.stored;
}

/// Work of loads, and of prescribed motions, on this rank in the step that ends with `now`.
std::pair<double, double> WorkMeter::externalWork(const End& now) const {
  const bool first = before_.load.empty();
  std::pair<double, double> work{0.0, 0.0};
  for (std::size_t i = 0; i < now.load.size(); ++i) {
    const Matrix moved = first ? now.displacement[i] : Matrix(now.displacement[i] - before_.displacement[i]);
    const Matrix turn = first ? now.turn[i] : Matrix(now.turn[i] * before_.turn[i].transpose());
    const Matrix load = first ? now.load[i] : Matrix(now.load[i] + before_.load[i]),
                 held = first ? now.held[i] : Matrix(now.held[i] + turn * before_.held[i]);
    work.first += 0.5 * load.cwiseProduct(moved).sum();
    const Point rotation = rotationOf(turn);
    const auto d = static_cast<int>(moved.rows());
    for (Eigen::Index node = 0; node < moved.cols(); ++node) {
      if (held.col(node).isZero(0.0)) continue;
      const Point way = endOfArc(pointOf(moved.col(node).data(), d), rotation);
      work.second += 0.5 * dot(pointOf(held.col(node).data(), d), way);
    }
  }
  return work;
}

void WorkMeter::add(const Answer& answer) {
  End now = endOf(answer);
  double mine[4] = {0.0, 0.0, 0.0, 0.0}, all[4];  // work of loads and of prescribed motions, normal and tangential
  std::tie(mine[0], mine[1]) = externalWork(now);
  // New pairs of bodies that move far begin with no force, at an unknown gap.
  int moves = 0;
  const int mineMoves =
      std::any_of(answer.meshes.begin(), answer.meshes.end(), [](const SubdomainMesh& mesh) { return !mesh.drawn.empty(); });
  Teuchos::reduceAll(comm_, Teuchos::REDUCE_MAX, mineMoves, Teuchos::outArg(moves));
  const std::vector<const PairResult*> before = predecessors(before_.pairs, now.pairs);
  for (std::size_t i = 0; i < now.pairs.size(); ++i) {
    const PairResult &pair = now.pairs[i], *last = before[i];
    const double force = pair.force + (last ? last->force : 0.0), closed = (last    ? last->gap
                                                                            : moves ? pair.gap
                                                                                    : pair.initialGap) -
                                                                           pair.gap;
    const Point tangential = last ? plus(pair.tangential, last->tangential) : pair.tangential;
    mine[2] += 0.5 * force * closed;
    mine[3] += 0.5 * dot(tangential, pair.stepSlip());
  }
  Teuchos::reduceAll(comm_, Teuchos::REDUCE_SUM, 4, mine, all);
  work_.external += all[0] + all[1];
  work_.normal += all[2];
  work_.tangential += all[3];
  work_.size += std::max(std::abs(all[0]) + std::abs(all[1]), std::abs(now.stored - work_.stored));
  work_.stored = now.stored;
  double dissipated = 0.0;
  for (const PairResult& pair : now.pairs) dissipated += pair.dissipated - pair.past.dissipated;
  broadcastBytes(comm_, &dissipated, sizeof dissipated);
  work_.dissipated += dissipated;
  before_ = std::move(now);
}

}  // namespace suture
