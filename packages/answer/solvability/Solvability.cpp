#include <suture/algebra/SparseNullSpace.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/algebra/dense/NonnegativeLeastSquares.hpp>
#include <suture/answer/solvability/Solvability.hpp>
#include <suture/base/Errors.hpp>
#include <suture/constraints/ContactRows.hpp>
#include <suture/elasticity/loads/NodalLoads.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/pairs/PairFrame.hpp>
#include <suture/search/PadModel.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace suture {

namespace {

constexpr double noWork = 1e-9;    // relative to the forces on the part
constexpr double noMotion = 1e-8;  // relative to a unit amplitude
// Largest change of a gap, relative to the amplitude of the motion, that counts as zero: a round body that turns in its seat changes gaps
// by the inaccuracy of mesh coordinates (normals of nodes that Gmsh puts on circles are accurate to 1e-8).
constexpr double noOpening = 1e-6;
constexpr double kBalanced = 1e-9;  // imbalance of pads, relative to the loads, at which they prove that contact holds all bodies

// The simplest motion in a space of amplitudes (orthonormal columns): a translation if there is one, along an axis if possible.
std::string inWords(const RigidPart& part, const Matrix& space, int dimension) {
  const Matrix rotations = space.bottomRows(space.rows() - dimension);
  const Matrix translations = space * nullSpace(rotations, noMotion);
  if (translations.cols() == 0) return inWords(part, Vector(space.col(0)), dimension);
  if (translations.cols() == dimension) return "move in any direction";
  Eigen::Index axis = 0;
  translations.topRows(dimension).rowwise().norm().maxCoeff(&axis);
  return inWords(part, Vector(translations * translations.row(axis).transpose()), dimension);
}

// Orthonormal basis of the motions of one part, from columns over all parts, without negligible ones.
Matrix spanOf(const Matrix& columns) {
  const SingularValues svd = singularValues(columns);
  return svd.u.leftCols((svd.values.array() > noMotion).count());
}

struct Modes {
  std::vector<int> first;  // column of each part's first motion
  int count = 0;
};

/// Possible forces of pairs, as generators: contact can exert their nonnegative combinations.
struct ContactForces {
  std::vector<int> pair;         // pair of each generator
  std::vector<Point> direction;  // direction of the force on side B
};

/// Adds the forces that a pair's law allows: the normal; the edges of the friction cone, in 3D of a pyramid of sixteen planes around it;
/// tangents of unlimited size if slip has a bound without pressure (the solver checks the bound); both signs if the sides are glued.
void addForces(const ContactPair& pair, const ContactLaw& law, int dimension, ContactForces& forces) {
  const auto add = [&](const Point& direction) {
    forces.pair.push_back(pair.id);
    forces.direction.push_back(direction);
  };
  if (!law.separates()) add(scaled(-1.0, pair.normal));
  if (law.rows(dimension) == 1) {
    add(pair.normal);
    return;
  }
  const std::vector<Point> frame = pairFrame(pair.normal, dimension);
  const int edges = dimension == 2 ? 2 : 16;
  ContactTrial trial;
  trial.force = {1.0, 0.0, 0.0};
  trial.place = pair.position;
  trial.size = pair.length;
  bool inside = false;  // true if the normal is a combination of edges
  for (int edge = 0; edge < edges; ++edge) {
    const double angle = 2.0 * M_PI * edge / edges;
    const double along = dimension == 2 ? (edge == 0 ? 1.0 : -1.0) : std::cos(angle), across = dimension == 2 ? 0.0 : std::sin(angle);
    Point tangent = scaled(along, frame[1]);
    if (dimension == 3) tangent = plus(tangent, scaled(across, frame[2]));
    constexpr double beyond = 1e150;  // a jump beyond any finite bound
    trial.jump = {0.0, beyond * along, beyond * across};
    const ContactState state = law.project(trial, PairStatus::Slip);
    if (state.status == PairStatus::Stick || (state.status == PairStatus::Slip && state.bound > 0.0)) add(tangent);
    if (state.status != PairStatus::Slip || state.friction <= 0.0) continue;
    add(plus(pair.normal, scaled(state.friction / (dimension == 2 ? 1.0 : std::cos(M_PI / edges)), tangent)));
    inside = true;
  }
  if (!inside) add(pair.normal);
}

ContactForces contactForces(const Mesh& mesh, const Constraints& constraints) {
  ContactForces forces;
  for (const ContactPair& pair : constraints.pairs) addForces(pair, constraints.laws.of(pair.line), mesh.dimension, forces);
  return forces;
}

/// Negative work of the pairs' forces on side A in each motion.
SparseRows contactRows(const Mesh& mesh, const Constraints& constraints, const ContactForces& forces, const RigidParts& rigid,
                       const Modes& modes) {
  const int dimension = mesh.dimension;
  std::vector<Eigen::Triplet<double, int>> entries;
  for (std::size_t p = 0; p < forces.pair.size(); ++p) {
    for (const auto& [node, weight] : constraints.pairs[forces.pair[p]].ends) {
      const int part = rigid.partOfNode[node];
      const RigidPart& r = rigid.parts[part];
      if (r.free.cols() == 0) continue;
      const Vector effect =
          weight * r.free.transpose() *
          (r.at(mesh.point(node), dimension).transpose() * Eigen::Map<const Vector>(forces.direction[p].data(), dimension));
      for (int k = 0; k < int(effect.size()); ++k) entries.emplace_back(int(p), modes.first[part] + k, effect[k]);
    }
  }
  SparseRows rows(Eigen::Index(forces.pair.size()), modes.count);
  rows.setFromTriplets(entries.begin(), entries.end());
  rows.prune(0.0);
  return rows;
}

/// Appends the forces of prescribed means to the rows: each in both senses.
void appendMeans(const Mesh& mesh, const std::vector<PrescribedMean>& means, const RigidParts& rigid, const Modes& modes,
                 SparseRows& rows) {
  if (means.empty()) return;
  std::vector<Eigen::Triplet<double, int>> entries;
  const int before = int(rows.rows());
  for (std::size_t m = 0; m < means.size(); ++m)
    for (const auto& [node, weight] : means[m].nodes) {
      const int part = rigid.partOfNode[std::size_t(node)];
      const RigidPart& r = rigid.parts[std::size_t(part)];
      if (r.free.cols() == 0) continue;
      const Vector effect = weight * (r.at(mesh.point(node), mesh.dimension).row(means[m].component) * r.free).transpose();
      for (int k = 0; k < int(effect.size()); ++k)
        for (const int sense : {0, 1})
          entries.emplace_back(before + 2 * int(m) + sense, modes.first[std::size_t(part)] + k, sense == 0 ? effect[k] : -effect[k]);
    }
  for (int row = 0; row < before; ++row)
    for (SparseRows::InnerIterator entry(rows, row); entry; ++entry) entries.emplace_back(row, int(entry.col()), entry.value());
  rows.resize(before + 2 * Eigen::Index(means.size()), modes.count);
  rows.setFromTriplets(entries.begin(), entries.end());
}

/// Motions that keep all gaps and means: orthonormal columns. Their part of the rows is mesh inaccuracy and is removed, except from rows of
/// many bodies, which must stay sparse.
Matrix slidingMotions(SparseRows& rows) {
  if (rows.cols() > kMostDense) return sparseNullSpace(rows, noOpening);
  const SingularValues svd = singularValues(Matrix(rows));
  Eigen::Index held = std::min(rows.rows(), rows.cols());
  while (held > 0 && (rows * svd.v.col(held - 1)).lpNorm<Eigen::Infinity>() <= noOpening) --held;
  const Matrix sliding = svd.v.rightCols(rows.cols() - held);
  rows = Matrix(Matrix(rows) - (rows * sliding) * sliding.transpose()).sparseView();
  return sliding;
}

/// The loads' work that contact forces p >= 0 with the least remainder leave unbalanced. No contact force balances loads along sliding
/// motions. \param contact  receives p
Vector unbalancedWork(const SparseRows& rows, const Matrix& sliding, const Vector& work, Vector& contact) {
  const auto along = [&](const Vector& v) { return Vector(sliding * (sliding.transpose() * v)); };
  const Vector free = along(work), stopped = work - free;
  const auto remainder = [&] {
    const Vector rest = stopped - rows.transpose() * contact;
    return Vector(rest - along(rest));
  };
  if (rows.cols() <= kMostDense) {
    contact = nonnegativeLeastSquares(Matrix(rows).transpose(), stopped);
    return remainder() + free;
  }
  // Many bodies: elastic pads, which prove an equilibrium to more digits than the least remainder.
  const PadModel::Equilibrium pads = PadModel::unilateral(rows, stopped, Vector::Zero(rows.rows()), Vector::Ones(rows.rows()));
  contact = pads.force.col(0);
  if (pads.found && remainder().norm() <= kBalanced * work.norm()) return remainder() + free;
  contact = PadModel::leastRemainder(rows, stopped);
  if (contact.size() == 0) {  // nothing is proved
    contact = Vector::Zero(rows.rows());
    return free;
  }
  const Vector rest = remainder();
  return rest.norm() <= PadModel::kUnbalanced * work.norm() ? free : Vector(rest + free);
}

void checkPrescribedPairs(const Mesh& mesh, const Constraints& constraints, Problems& problems) {
  const int dimension = mesh.dimension;
  std::vector<int> ruleOf(mesh.nodes(), -1);
  for (std::size_t r = 0; r < constraints.rules.size(); ++r) ruleOf[constraints.rules[r].node] = int(r);
  const RigidGroupNodes rigid(constraints.rigidGroups, dimension);
  for (const ContactPair& pair : constraints.pairs) {
    double bound = pair.gap, size = std::abs(pair.gap) + pair.length;
    bool free = false;
    for (const auto& [node, weight] : pair.ends) {
      if (ruleOf[node] < 0) {
        free = true;
        break;
      }
      const NodeRule& rule = constraints.rules[ruleOf[node]];
      free = free || rigid.moves(node);
      for (int k = 0; k < dimension; ++k) {
        double along = 0;
        for (int c = 0; c < dimension; ++c) along += rule.axes[k][c] * pair.normal[c];
        if (!rule.fixed[k]) {
          free = free || std::abs(along) > 1e-14;
        } else {
          bound -= weight * along * rule.value[k];
          size = std::max(size, std::abs(rule.value[k]));
        }
      }
    }
    if (free || bound >= -1e-10 * size) continue;
    std::ostringstream text;
    text << "at " << placeText(pair.position, mesh.dimension) << " the prescribed displacements of both sides overlap by " << -bound
         << ". Prescribe them so that the gap stays positive, or leave one side free";
    problems.add("Contact", text.str());
    return;
  }
}

constexpr std::size_t kNamed = 20;  // bodies of which each motion is described; of a wall that topples, hundreds move in similar ways

/// Refused bodies: the first ones with their motions, the others by name.
class Refusals {
 public:
  explicit Refusals(Problems& problems) : problems_(problems) {}

  void add(const std::string& body, const std::string& message) {
    if (++count_ <= kNamed)
      problems_.add("Bodies/" + body, "body '" + body + "'" + message);
    else
      others_.push_back(body);
  }
  /// \throws InputError  if there are any problems
  void throwIfAny() {
    if (!others_.empty()) problems_.add("Bodies", std::to_string(others_.size()) + " more bodies are not held: " + joinNames(others_));
    problems_.throwIfAny();
  }

 private:
  Problems& problems_;
  std::size_t count_ = 0;
  std::vector<std::string> others_;
};

}  // namespace

void checkSolvability(const Mesh& mesh, const Constraints& constraints, const Vector& forces, const RigidParts& rigid,
                      const std::vector<PrescribedMean>& means) {
  const int dimension = mesh.dimension, parts = int(rigid.parts.size());
  Problems problems;
  checkPrescribedPairs(mesh, constraints, problems);

  std::vector<char> inContact(parts, 0), hasMean(parts, 0);
  for (const ContactPair& pair : constraints.pairs)
    for (const PairEnd& end : pair.ends) inContact[rigid.partOfNode[end.node]] = 1;
  for (const PrescribedMean& mean : means)
    for (const auto& entry : mean.nodes) hasMean[rigid.partOfNode[std::size_t(entry.first)]] = 1;
  Refusals refusals(problems);
  const auto name = [&](int part) { return mesh.bodies[rigid.parts[part].body]; };

  Modes modes;
  for (int part = 0; part < parts; ++part) {
    modes.first.push_back(modes.count);
    modes.count += int(rigid.parts[part].free.cols());
    const RigidPart& r = rigid.parts[part];
    if (inContact[part] || hasMean[part] || r.free.cols() == 0) continue;
    refusals.add(name(part),
                 (r.free.cols() == r.free.rows()
                      ? std::string(" is not held: it has no prescribed displacement, no Elastic Support and no contact")
                      : " can " + inWords(r, r.free, dimension) +
                            ": it has no contact, and no prescribed displacement or Elastic Support prevents this motion") +
                     ". Prescribe displacements on it, make one of its sides Bilateral or an Elastic Support, or bring it into contact");
  }
  if (modes.count == 0 || !problems.empty()) {
    refusals.throwIfAny();
    return;
  }

  // Work of the loads in each motion, and reference forces for this work.
  Vector work = Vector::Zero(modes.count), force = Vector::Zero(parts);
  for (int i = 0; i < mesh.nodes(); ++i) {
    const int part = rigid.partOfNode[i];
    const RigidPart& r = rigid.parts[part];
    const auto f = forces.segment(Eigen::Index(i) * dimension, dimension);
    if (r.free.cols() == 0 || f.isZero(0.0)) continue;
    force[part] += f.norm();
    work.segment(modes.first[part], r.free.cols()) += (f.transpose() * r.at(mesh.point(i), dimension) * r.free).transpose();
  }
  const ContactForces generators = contactForces(mesh, constraints);
  SparseRows rows = contactRows(mesh, constraints, generators, rigid, modes);
  appendMeans(mesh, means, rigid, modes, rows);
  const Matrix sliding = slidingMotions(rows);
  const double loads = force.sum();
  if (loads > 0) {
    Vector contact;
    const Vector escape = unbalancedWork(rows, sliding, work / loads, contact);
    for (std::size_t p = 0; p < generators.pair.size(); ++p)
      for (const PairEnd& end : constraints.pairs[generators.pair[p]].ends)
        force[rigid.partOfNode[end.node]] += loads * contact[Eigen::Index(p)] * std::abs(end.weight);
    for (int part = 0; part < parts; ++part) {
      const RigidPart& r = rigid.parts[part];
      const Vector own = escape.segment(modes.first[part], r.free.cols());
      if (own.norm() <= std::max(noWork * force[part] / loads, 1e-13) || own.norm() < 1e-3 * escape.norm()) continue;
      refusals.add(name(part),
                   " can " + inWords(r, Vector(r.free * own), dimension) +
                       ": the loads push it there and neither a prescribed displacement nor contact stops it. Prescribe a displacement "
                       "that holds it, or load it against its contact");
    }
    refusals.throwIfAny();
  }

  for (int part = 0; part < parts && sliding.cols() > 0; ++part) {
    const RigidPart& r = rigid.parts[part];
    if (r.free.cols() == 0) continue;
    const Matrix own = spanOf(sliding.middleRows(modes.first[part], r.free.cols()));
    if (own.cols() == 0) continue;
    if (hasMean[part] && !inContact[part]) {
      refusals.add(name(part), " can " + inWords(r, Matrix(r.free * own), dimension) +
                                   ": it has no contact, and neither a prescribed displacement, an Elastic Support nor a Mean Displacement "
                                   "prevents this motion. Prescribe that displacement, or the mean displacement of another group");
      continue;
    }
    refusals.add(name(part),
                 " can " + inWords(r, Matrix(r.free * own), dimension) +
                     " without opening its contacts: nothing holds it and no load pushes it, so that its place is not determined. "
                     "Prescribe that displacement somewhere on it");
  }
  refusals.throwIfAny();
}

void checkSolvability(const Mesh& mesh, const Constraints& constraints, const ElasticModel& model, bool bodiesAreConnected) {
  const std::vector<PrescribedMean> means = prescribedMeans(mesh, model);
  Problems problems;
  checkMeans(mesh, constraints, model, means, problems);
  problems.throwIfAny();
  checkSolvability(mesh, constraints, nodalLoads(mesh, model), freeRigidMotions(mesh, constraints, bodiesAreConnected), means);
}

}  // namespace suture
