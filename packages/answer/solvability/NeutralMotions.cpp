#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/algebra/dense/NonnegativeLeastSquares.hpp>
#include <suture/answer/solvability/NeutralMotions.hpp>
#include <suture/answer/solvability/PairClasses.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/elasticity/loads/NodalLoads.hpp>
#include <suture/motion/RigidMotionLifting.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kNoMotion = 1e-8;         // amplitude, relative to one, that counts as zero
constexpr double kMotionRounding = 1e-14;  // remainder of a displacement that consisted of one motion alone, relative to it
constexpr double kNothing = 1e-15;         // motion, relative to a body's size, below the accuracy of coordinates
constexpr double kAsItIs = 1e-9;           // motion, relative to the displacements, that is not applied

std::vector<char> loadedParts(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                              const ContactBodies& bodies, const ClosedSet& carrying) {
  std::vector<int> mine(bodies.parts().size(), 0), all(mine);
  for (std::size_t s = 0; s < meshes.size(); ++s)
    if (!subdomainLoads(meshes[s], model).isZero(0.0)) mine[bodies.partOf(static_cast<int>(s))] = 1;
  for (int i = 0; i < bodies.rigid().pairs(); ++i)
    if (carrying[i])
      for (const int part : bodies.rigid().data().bodies[i]) mine[part] = 1;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, static_cast<int>(mine.size()), mine.data(), all.data());
  return {all.begin(), all.end()};
}

/// Parts without load, pair force and nonzero prescribed displacement have moved as rigid bodies. Their deformation is an error of the
/// iterative solver and is removed.
/// \return whether there are such parts
bool straighten(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const ContactBodies& bodies,
                const ClosedSet& carrying, std::vector<Vector>& displacement) {
  const std::size_t parts = bodies.parts().size();
  std::vector<char> idle(parts, 1);
  for (std::size_t i = 0; i < carrying.size(); ++i)
    if (carrying[i])
      for (const int part : bodies.rigid().data().bodies[i]) idle[part] = 0;
  if (std::none_of(idle.begin(), idle.end(), [](char one) { return one != 0; })) return false;

  std::vector<int> mine(parts, 0), acted(parts, 0);
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    int& own = mine[bodies.partOf(static_cast<int>(s))];
    for (const NodeRule& rule : meshes[s].rules)
      for (int k = 0; k < meshes[s].dimension; ++k)
        if (rule.fixed[k] && rule.value[k] != 0.0) own = 1;
    if (own == 0 && !subdomainLoads(meshes[s], model).isZero(0.0)) own = 1;
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, static_cast<int>(parts), mine.data(), acted.data());
  bool any = false;
  for (std::size_t p = 0; p < parts; ++p) {
    if (!idle[p] || acted[p] != 0) continue;
    any = true;
    const RigidPart& part = bodies.parts()[p];
    const Eigen::Index k = part.free.cols();
    Matrix own = Matrix::Zero(k, k + 1), all = own;
    const auto forEachNode = [&](const auto& take) {
      for (std::size_t s = 0; s < meshes.size(); ++s) {
        if (bodies.partOf(static_cast<int>(s)) != static_cast<int>(p)) continue;
        const int d = meshes[s].dimension;
        for (int node = 0; node < meshes[s].nodes(); ++node)
          take(Matrix(part.at(meshes[s].point(node), d) * part.free), displacement[s].segment(Eigen::Index(node) * d, d));
      }
    };
    forEachNode([&](const Matrix& moved, const auto& u) {
      own.leftCols(k) += moved.transpose() * moved;
      own.col(k) += moved.transpose() * u;
    });
    Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, static_cast<int>(own.size()), own.data(), all.data());
    Vector amplitudes(k);
    if (k > 0) amplitudes = solvePositive(all.leftCols(k), all.col(k));
    if (amplitudes.norm() <= kNothing * part.radius) amplitudes.setZero();
    forEachNode([&](const Matrix& moved, auto&& u) { u = moved * amplitudes; });
  }
  return any;
}

/// Motions of parts as columns of nodal displacements, and their contribution to solutions.
class Least {
 public:
  Least(const Comm& comm, std::vector<SubdomainMesh>& meshes, const ContactBodies& bodies, const Matrix& motions)
      : comm_(comm), meshes_(meshes), bodies_(bodies), motions_(motions) {}

  /// Moves the displacements to the least ones; false: nothing to change.
  bool settle(const PairsAtSolution& pairs, const ClosedSet& carrying, std::vector<Vector>& displacement) const {
    const Eigen::Index k = motions_.cols();
    Matrix mine = Matrix::Zero(k, k + 1), all = mine;  // Z^T Z, Z^T u
    double largest = 0.0, overall = 0.0;
    forEachNode([&](std::size_t s, int node, const Matrix& moved) {
      const int d = meshes_[s].dimension;
      Vector u = displacement[s].segment(Eigen::Index(node) * d, d);
      if (const Vector& lift = meshes_[s].lift.motion; lift.size() > 0) u += lift.segment(Eigen::Index(node) * d, d);
      mine.leftCols(k) += moved.transpose() * moved;
      mine.col(k) += moved.transpose() * u;
      largest = std::max(largest, u.norm());
    });
    Teuchos::reduceAll(comm_, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
    Teuchos::reduceAll(comm_, Teuchos::REDUCE_MAX, largest, Teuchos::outArg(overall));
    Matrix lower;
    if (!choleskyFactor(all.leftCols(k), lower)) return false;
    // With y = L^-T (v - L^-1 b) the norm of v is minimised; gaps allow rows y <= gap.
    const Vector shift = lower.triangularView<Eigen::Lower>().solve(all.col(k));
    const auto back = [&](const Matrix& v) { return Matrix(lower.transpose().triangularView<Eigen::Upper>().solve(v)); };
    std::vector<int> open;
    const RigidBodyModel::Pairs& data = bodies_.rigid().data();
    for (int i = 0; i < bodies_.rigid().pairs(); ++i)
      if (data.canChange[i] && !carrying[i] && !Vector(data.rows.row(i) * motions_).isZero(kNoMotion)) open.push_back(i);
    const Matrix rows = rowsAt(data.rows, open) * motions_;
    const Matrix g = -lower.triangularView<Eigen::Lower>().solve(rows.transpose()).transpose();
    const Vector room = Vector(pairs.gap(open)).cwiseMax(0.0);
    const Vector v = leastDistance(g, g * shift - room);
    const Vector y = back(v - shift);
    double change = 0.0, most = 0.0;
    forEachNode([&](std::size_t, int, const Matrix& moved) { change = std::max(change, (moved * y).norm()); });
    Teuchos::reduceAll(comm_, Teuchos::REDUCE_MAX, change, Teuchos::outArg(most));
    double size = 0.0;
    for (const RigidPart& part : bodies_.parts()) size = std::max(size, part.radius);
    if (!(most > std::max(kAsItIs * overall, kNothing * size))) return false;
    if (isLifted()) {  // the lift takes up the motion without loss of accuracy
      std::vector<Vector> further;
      const Vector motion = motions_ * y;
      for (std::size_t p = 0; p < bodies_.parts().size(); ++p) further.push_back(bodies_.amplitudes(static_cast<int>(p), motion));
      moveFurther(comm_, meshes_, further);
      return true;
    }
    forEachNode([&](std::size_t s, int node, const Matrix& moved) {
      const int d = meshes_[s].dimension;
      const Vector shift = moved * y;
      auto u = displacement[s].segment(Eigen::Index(node) * d, d);
      u += shift;
      for (int c = 0; c < d; ++c)
        if (std::abs(u(c)) <= kMotionRounding * shift.norm()) u(c) = 0.0;  // it consisted of this motion alone
    });
    return true;
  }

 private:
  bool isLifted() const {
    int mine = 0, any = 0;
    for (const SubdomainMesh& mesh : meshes_) mine = mine || mesh.lift.motion.size() > 0;
    Teuchos::reduceAll(comm_, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
    return any != 0;
  }

  template <typename Take>
  void forEachNode(const Take& take) const {
    for (std::size_t s = 0; s < meshes_.size(); ++s) {
      const int p = bodies_.partOf(static_cast<int>(s));
      const RigidPart& part = bodies_.parts()[p];
      Matrix own(part.free.rows(), motions_.cols());
      for (Eigen::Index k = 0; k < motions_.cols(); ++k) own.col(k) = bodies_.amplitudes(p, motions_.col(k));
      if (part.free.cols() == 0 || own.isZero(kNoMotion)) continue;
      for (int node = 0; node < meshes_[s].nodes(); ++node) take(s, node, part.at(meshes_[s].point(node), meshes_[s].dimension) * own);
    }
  }

  const Comm& comm_;
  std::vector<SubdomainMesh>& meshes_;
  const ContactBodies& bodies_;
  const Matrix& motions_;
};

void addMotions(const ContactBodies& bodies, const Matrix& motions, bool bothSenses, const ElasticModel& model,
                const std::vector<char>& loaded, std::vector<NeutralMotion>& all) {
  for (std::size_t p = 0; p < bodies.parts().size(); ++p) {
    const RigidPart& part = bodies.parts()[p];
    Matrix own(part.free.rows(), motions.cols());
    for (Eigen::Index k = 0; k < motions.cols(); ++k) own.col(k) = bodies.amplitudes(static_cast<int>(p), motions.col(k));
    if (part.free.cols() == 0 || own.isZero(kNoMotion)) continue;
    const Matrix basis = orthonormalBasis(own, kNoMotion);
    for (Eigen::Index k = 0; k < basis.cols(); ++k)
      all.push_back({model.bodies.at(part.body), inWords(part, basis.col(k), bodies.dimension()), loaded[p] != 0, bothSenses});
  }
}

/// States of pairs as they hold bodies: a pair that slips under a force also holds transversely, for any solution method.
std::vector<ContactState> broadcastStates(const Comm& comm, const std::vector<PairResult>& pairs, int count) {
  std::vector<ContactState> states(std::size_t(comm.getRank() == 0 ? count : 0));
  if (comm.getRank() == 0)
    for (const PairResult& pair : pairs) {
      if (pair.id >= count) continue;
      ContactState& state = states[std::size_t(pair.id)] = pair.state;
      if (state.status == PairStatus::Slip && state.transverseStiffness == 0.0 && norm(pair.tangential) > 0.0)
        state.transverseStiffness = 1.0;
    }
  broadcast(comm, states);
  return states;
}

}  // namespace

void settleNeutralMotions(const Comm& comm, std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const ContactLaws& laws,
                          const std::vector<BodyForces>& carried, Solution& solution) {
  std::vector<const SubdomainMesh*> all;
  for (const SubdomainMesh& mesh : meshes) all.push_back(&mesh);
  ContactBodies bodies(comm, all, laws);
  bodies.remember(carried);
  const RigidBodyModel& rigid = bodies.rigid();
  const int count = rigid.pairs();
  if (count == 0) return;
  PairsAtSolution pairs = broadcastPairs(comm, solution.pairs, count);
  const ForceScales scales = forceScales(comm, meshes, model, bodies, solution.displacement);
  PairClasses classes = classify(bodies, pairs, scales);
  if (comm.getRank() == 0)
    for (PairResult& pair : solution.pairs)
      if (classes.idle[pair.id] && pair.kind.separates) pair.open();  // round-off; needs no note on pressures

  const auto take = [&] {  // update after a change of displacements
    std::vector<PairForce> forces;
    for (const PairResult& pair : solution.pairs) forces.push_back({pair.id, pair.state, pair.force, pair.tangential});
    solution.pairs = pairResults(comm, all, solution.displacement, forces);
    pairs.gap = broadcastPairs(comm, solution.pairs, count).gap;
    classes.touching = classify(bodies, pairs, scales).touching;
  };
  if (rigid.motions() > 0 && straighten(comm, meshes, model, bodies, classes.carrying, solution.displacement)) take();
  const auto markTouching = [&] {
    if (comm.getRank() == 0)
      for (PairResult& pair : solution.pairs) pair.touching = !pair.state.closed() && classes.touching[pair.id];
  };
  if (laws.restrictSliding()) {  // slip depends on the path: nothing is moved afterwards
    const Matrix free = rigid.motions() > 0 ? rigid.loose(broadcastStates(comm, solution.pairs, count)) : Matrix();
    if (free.cols() > 0)
      addMotions(bodies, free, true, model, loadedParts(comm, meshes, model, bodies, classes.carrying), solution.neutral);
    for (NeutralMotion& motion : solution.neutral) motion.least = false;
    markTouching();
    return;
  }
  const Matrix neutral = rigid.motions() > 0 ? rigid.neutral(classes.carrying, classes.touching) : Matrix();
  if (neutral.cols() > 0) {
    if (Least(comm, meshes, bodies, neutral).settle(pairs, classes.carrying, solution.displacement)) {
      take();
      // Pairs opened by the motion carry nothing: their forces were round-off of the moments of other forces.
      if (comm.getRank() == 0)
        for (PairResult& pair : solution.pairs)
          if (pair.state.closed() && !classes.carrying[pair.id] && !classes.touching[pair.id] && pair.kind.separates) pair.open();
    }
    const std::vector<char> loaded = loadedParts(comm, meshes, model, bodies, classes.carrying);
    ClosedSet holding = classes.carrying;
    for (int i = 0; i < count; ++i) holding[i] = holding[i] || classes.touching[i];
    const Matrix bothSenses = rigid.loose(holding);
    addMotions(bodies, bothSenses, true, model, loaded, solution.neutral);
    if (neutral.cols() > bothSenses.cols())
      addMotions(bodies, orthonormalBasis(neutral - bothSenses * (bothSenses.transpose() * neutral), kNoMotion), false, model, loaded,
                 solution.neutral);
  }
  markTouching();
}

std::string inWords(const NeutralMotion& motion) {
  return "body '" + motion.body + "' can " + motion.words + (motion.bothSenses ? "" : ", in one sense at least,") +
         " without changing any contact force" + (motion.loaded ? "" : ", and no force acts on it") +
         ": its place is not determined along that motion" + (motion.least ? "; the least displacement is kept" : "");
}

std::string undetermined(const std::vector<NeutralMotion>& motions) {
  std::string text;
  for (const NeutralMotion& motion : motions)
    if (motion.loaded && motion.bothSenses) text += (text.empty() ? "" : "; ") + ("body '" + motion.body + "' can " + motion.words);
  if (!text.empty())
    text +=
        ": the pairs that are closed at the solution do not hold it. Hold it, or choose Outer Solver/Neutral Motions = Least to keep the "
        "least "
        "displacement";
  return text;
}

}  // namespace suture
