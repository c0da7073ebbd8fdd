#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/AgreedDimension.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/RigidValues.hpp>
#include <suture/interface/ContactBodies.hpp>
#include <suture/motion/BodyParts.hpp>
#include <suture/search/SoftBodies.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace suture {

namespace {

constexpr double kNoWork = 1e-12;  // relative to the sum of magnitudes: round-off of loads in equilibrium

/// Coefficient of one unknown in a pair's row, per amplitude of a part.
struct Term {
  int pair, part, component;
  GlobalId dof;
  double amplitudes[6];
};

struct PairData {
  int pair, line;
  double gap, stiffness;
  char canChange, bound;
};

using TermKey = std::tuple<int, int, GlobalId>;  // pair, component, unknown
constexpr double kKept = 1e-9;                   // change of a bound pair, for motions of order one, that counts as zero

}  // namespace

ContactBodies::ContactBodies(const Comm& comm, const std::vector<std::unique_ptr<Subdomain>>& subdomains,
                             const std::map<int, double>& pairStiffness, const ContactLaws& laws) {
  Meshes meshes;
  for (const auto& subdomain : subdomains) meshes.push_back(&subdomain->mesh());
  findParts(comm, meshes);
  RigidBodyModel::Pairs pairs = gatherPairs(comm, meshes, pairStiffness, laws, free_);
  pairs.work = work(comm, subdomains, free_);
  bind(pairs);
  rigid_ = std::make_unique<RigidBodyModel>(std::move(pairs));
  findSupportedMotions(comm, subdomains);
  findSoftMotions(comm, meshes, subdomains, pairStiffness, laws);
  findLoads(comm, subdomains);
  remember({});
}

ContactBodies::ContactBodies(const Comm& comm, const Meshes& meshes, const ContactLaws& laws) {
  findParts(comm, meshes);
  std::map<int, double> ones;
  for (const SubdomainMesh* mesh : meshes)
    for (const ContactRow& row : mesh->contactRows) ones[row.pair.id] = 1.0;
  RigidBodyModel::Pairs pairs = gatherPairs(comm, meshes, ones, laws, free_);
  pairs.work = Vector::Zero(free_.count);
  bind(pairs);
  rigid_ = std::make_unique<RigidBodyModel>(std::move(pairs));
}

void ContactBodies::findParts(const Comm& comm, const Meshes& meshes) {
  dimension_ = agreedDimensionOf(comm, meshes);
  BodyParts found(comm, meshes, dimension_);
  parts_ = std::move(found.parts);
  lift_ = std::move(found.lift);
  partOf_ = std::move(found.partOf);
  for (const RigidPart& part : parts_) free_.add(part.free);
}

void ContactBodies::Basis::add(Matrix ofPart) {
  first.push_back(count);
  count += static_cast<int>(ofPart.cols());
  motions.push_back(std::move(ofPart));
}

/// Finds the motions that only elastic supports hold. Collective.
void ContactBodies::findSupportedMotions(const Comm& comm, const std::vector<std::unique_ptr<Subdomain>>& subdomains) {
  const bool any = std::any_of(parts_.begin(), parts_.end(), [](const RigidPart& part) { return part.soft.cols() > 0; });
  if (!any || !rigid_->data().bound.empty()) return;
  const auto amplitudes = static_cast<Eigen::Index>(rigidMotions(dimension_));
  // A rigid motion deforms supports only: its energy is theirs.
  Matrix mine = Matrix::Zero(amplitudes, amplitudes * static_cast<Eigen::Index>(parts_.size())), energies = mine;
  for (std::size_t s = 0; s < subdomains.size(); ++s) {
    const Subdomain& subdomain = *subdomains[s];
    const RigidPart& part = parts_[partOf_[s]];
    if (part.soft.cols() == 0) continue;
    Matrix moved(subdomain.dofs(), part.soft.cols());
    for (int dof = 0; dof < subdomain.dofs(); ++dof)
      moved.row(dof) =
          along(part, subdomain.mesh().point(subdomain.nodeOf(dof)), subdomain.direction(dof), dimension_).transpose() * part.soft;
    mine.block(0, amplitudes * partOf_[s], part.soft.cols(), part.soft.cols()) += moved.transpose() * (subdomain.stiffness() * moved);
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), energies.data());
  supported_.resize(parts_.size());
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const Eigen::Index soft = parts_[p].soft.cols();
    supported_[p].motions = Matrix(amplitudes, soft);
    if (soft == 0) continue;
    const Eigenpairs axes = symmetricEigenpairs(energies.block(0, amplitudes * static_cast<Eigen::Index>(p), soft, soft));
    supported_[p].motions = parts_[p].soft * axes.vectors;
    supported_[p].stiffness = axes.values.cwiseMax(0.0);
  }
}

/// Sets the model with motions that only soft supports hold, if there are any. Only the search without friction uses it. Collective.
void ContactBodies::findSoftMotions(const Comm& comm, const Meshes& meshes, const std::vector<std::unique_ptr<Subdomain>>& subdomains,
                                    const std::map<int, double>& pairStiffness, const ContactLaws& laws) {
  if (supported_.empty() || laws.restrictSliding()) return;
  Basis basis;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    Matrix motions(parts_[p].free.rows(), parts_[p].free.cols() + supported_[p].motions.cols());
    motions << parts_[p].free, supported_[p].motions;
    basis.add(std::move(motions));
  }
  Vector springs = Vector::Zero(basis.count);
  for (std::size_t p = 0; p < parts_.size(); ++p)
    springs.segment(basis.first[p] + parts_[p].free.cols(), supported_[p].stiffness.size()) = supported_[p].stiffness;
  RigidBodyModel::Pairs pairs = gatherPairs(comm, meshes, pairStiffness, laws, basis);
  pairs.work = work(comm, subdomains, basis);
  const Vector pads = pairs.rows.cwiseAbs2().transpose() * pairs.stiffness;
  // Stiff supports hold their motions: the deformation of the body is not small compared with them.
  std::vector<int> kept;
  for (Eigen::Index k = 0; k < springs.size(); ++k)
    if (springs(k) <= SoftBodies::kSoft * pads(k)) kept.push_back(static_cast<int>(k));
  springs = springs(kept).eval();
  if (springs.isZero(0.0)) return;
  pairs.rows = columnsAt(pairs.rows, kept);
  for (SparseRows& tangent : pairs.tangents) tangent = columnsAt(tangent, kept);
  pairs.work = pairs.work(kept).eval();
  rigid_->setSoft(std::make_shared<SoftBodies>(std::move(pairs), std::move(springs)));
}

/// Reduces the motions to those common to bodies bound together by pairs.
void ContactBodies::bind(RigidBodyModel::Pairs& pairs) {
  if (pairs.bound.empty()) return;
  std::vector<int> bound;
  for (std::size_t i = 0; i < pairs.bound.size(); ++i)
    if (pairs.bound[i]) bound.push_back(static_cast<int>(i));
  const auto count = static_cast<Eigen::Index>(bound.size());
  std::vector<SparseRows*> components{&pairs.rows};
  for (SparseRows& tangent : pairs.tangents) components.push_back(&tangent);
  Matrix kept(count * static_cast<Eigen::Index>(components.size()), free_.count);
  for (std::size_t c = 0; c < components.size(); ++c)
    kept.middleRows(count * static_cast<Eigen::Index>(c), count) = rowsAt(*components[c], bound);
  if (free_.count > 0 && !kept.isZero(kKept)) {
    areBound_ = true;
    together_ = nullSpace(kept, kKept);
    for (SparseRows* rows : components) *rows = Matrix(*rows * together_).sparseView();
    pairs.work = together_.transpose() * pairs.work;
  }
  for (SparseRows* rows : components)
    rows->prune([&](Eigen::Index row, Eigen::Index, double) { return !pairs.bound[static_cast<std::size_t>(row)]; });
}

RigidBodyModel::Pairs ContactBodies::gatherPairs(const Comm& comm, const Meshes& meshes, const std::map<int, double>& pairStiffness,
                                                 const ContactLaws& laws, const Basis& basis) const {
  const int amplitudes = rigidMotions(dimension_);
  std::map<TermKey, Term> terms;
  std::map<int, PairData> own;
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    const SubdomainMesh& mesh = *meshes[s];
    std::map<int, const NodeRule*> ruleOf;
    for (const NodeRule& rule : mesh.rules) ruleOf[rule.node] = &rule;
    const auto direction = [&](int node, int component) {
      if (const auto rule = ruleOf.find(node); rule != ruleOf.end()) return rule->second->axes[component];
      Point axis{0, 0, 0};
      axis[component] = 1.0;
      return axis;
    };
    for (const ContactRow& row : mesh.contactRows) {
      if (const auto stiffness = pairStiffness.find(row.pair.id); stiffness != pairStiffness.end()) {
        const bool separates = laws.of(row.pair.line).separates();
        own.emplace(row.pair.id, PairData{row.pair.id, row.pair.line, row.normal().gap, stiffness->second, row.canChange() && separates,
                                          row.canChange() && !separates});
      }
      for (std::size_t component = 0; component < row.equations.size(); ++component) {
        const ContactRow::Equation& equation = row.equations[component];
        for (std::size_t i = 0; i < equation.dofs.size(); ++i) {
          const auto at = std::lower_bound(mesh.globalNodes.begin(), mesh.globalNodes.end(), equation.dofs[i] / dimension_);
          if (at == mesh.globalNodes.end() || *at != equation.dofs[i] / dimension_) continue;
          const int node = static_cast<int>(at - mesh.globalNodes.begin());
          Term term{row.pair.id, partOf_[s], static_cast<int>(component), equation.dofs[i], {}};
          const Point axis = direction(node, static_cast<int>(equation.dofs[i] % dimension_));
          const Vector moved = along(parts_[partOf_[s]], mesh.point(node), axis, dimension_);
          for (int k = 0; k < amplitudes; ++k) term.amplitudes[k] = equation.coefficients[i] * moved(k);
          terms.emplace(TermKey(row.pair.id, term.component, equation.dofs[i]), term);
        }
      }
    }
  }
  Packer packer;
  std::vector<Term> sent;
  std::vector<PairData> pairsSent;
  for (const auto& entry : terms) sent.push_back(entry.second);
  for (const auto& entry : own) pairsSent.push_back(entry.second);
  packer.put(sent);
  packer.put(pairsSent);
  terms.clear();
  own.clear();
  for (const std::string& bytes : allGather(comm, packer.bytes())) {
    Unpacker unpacker(bytes);
    for (const Term& term : unpacker.get<std::vector<Term>>()) terms.emplace(TermKey(term.pair, term.component, term.dof), term);
    for (const PairData& pair : unpacker.get<std::vector<PairData>>()) own.emplace(pair.pair, pair);
  }
  const int count = own.empty() ? 0 : own.rbegin()->first + 1;
  RigidBodyModel::Pairs pairs;
  pairs.penetration = Vector::Zero(count);
  pairs.stiffness = Vector::Ones(count);
  pairs.line.assign(count, -1);
  pairs.surfaces = dimension_ == 3;
  pairs.canChange.assign(count, 0);
  pairs.bodies.resize(count);
  for (const auto& [id, pair] : own) {
    pairs.penetration(id) = -pair.gap;
    pairs.stiffness(id) = pair.stiffness;
    pairs.line[id] = pair.line;
    pairs.canChange[id] = pair.canChange;
    if (!pair.bound) continue;
    pairs.bound.resize(count, 0);
    pairs.bound[id] = 1;
  }
  std::vector<std::vector<Eigen::Triplet<double, int>>> entries(static_cast<std::size_t>(dimension_));  // by component
  for (const auto& entry : terms) {
    const Term& term = entry.second;
    const Eigen::Map<const Vector> row(term.amplitudes, amplitudes);
    const Vector effect = basis.motions[term.part].transpose() * row;
    for (int k = 0; k < static_cast<int>(effect.size()); ++k)
      entries[static_cast<std::size_t>(term.component)].emplace_back(term.pair, basis.first[term.part] + k, effect(k));
    if (term.component > 0) {
      pairs.tangents.resize(static_cast<std::size_t>(dimension_ - 1));
      continue;
    }
    pairs.penetration(term.pair) += row.dot(lift_[term.part]);
    std::vector<int>& bodies = pairs.bodies[term.pair];
    if (std::find(bodies.begin(), bodies.end(), term.part) == bodies.end()) bodies.push_back(term.part);
  }
  const auto fill = [&](SparseRows& rows, std::size_t component) {
    rows.resize(count, basis.count);
    rows.setFromTriplets(entries[component].begin(), entries[component].end());
    rows.prune(0.0);
  };
  fill(pairs.rows, 0);
  for (std::size_t t = 0; t < pairs.tangents.size(); ++t) fill(pairs.tangents[t], t + 1);
  return pairs;
}

Vector ContactBodies::work(const Comm& comm, const std::vector<std::unique_ptr<Subdomain>>& subdomains, const Basis& basis) const {
  Matrix mine = Matrix::Zero(basis.count, 2), all = mine;  // work, and the sum of magnitudes of its terms
  for (std::size_t s = 0; s < subdomains.size(); ++s) {
    const Subdomain& subdomain = *subdomains[s];
    const RigidPart& part = parts_[partOf_[s]];
    const Matrix& motions = basis.motions[partOf_[s]];
    if (motions.cols() == 0) continue;
    for (int dof = 0; dof < subdomain.dofs(); ++dof) {
      if (subdomain.load()(dof) == 0.0) continue;
      const Vector own = subdomain.load()(dof) * (motions.transpose() * along(part, subdomain.mesh().point(subdomain.nodeOf(dof)),
                                                                              subdomain.direction(dof), dimension_));
      mine.col(0).segment(basis.first[partOf_[s]], own.size()) += own;
      mine.col(1).segment(basis.first[partOf_[s]], own.size()) += own.cwiseAbs();
    }
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  Vector work = all.col(0);
  for (int k = 0; k < basis.count; ++k)
    if (std::abs(work(k)) <= kNoWork * all(k, 1)) work(k) = 0.0;
  return work;
}

void ContactBodies::findLoads(const Comm& comm, const std::vector<std::unique_ptr<Subdomain>>& subdomains) {
  std::vector<double> mine(parts_.size(), 0.0);
  loads_ = mine;
  for (std::size_t s = 0; s < subdomains.size(); ++s) mine[partOf_[s]] += subdomains[s]->load().cwiseAbs().sum();
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), loads_.data());
  std::set<std::pair<int, int>> joined;
  for (const std::vector<int>& bodies : rigid_->data().bodies)
    for (const int one : bodies)
      for (const int other : bodies)
        if (one < other) joined.emplace(one, other);
  neighbours_.assign(joined.begin(), joined.end());
}

void ContactBodies::remember(const std::vector<BodyForces>& carried) {
  std::vector<BodyForces> now(parts_.size()), past(parts_.size());
  carriedEnergy_ = Vector::Zero(static_cast<Eigen::Index>(parts_.size()));
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    if (!loads_.empty()) now[p].loads = loads_[p];
    if (carried.empty()) continue;
    past[p] = carried.at(static_cast<std::size_t>(parts_[p].body));
    carriedEnergy_(static_cast<Eigen::Index>(p)) = past[p].energy();
  }
  idle_ = idleBodies(now, past);
  const std::vector<std::vector<int>>& bodies = rigid_->data().bodies;
  Vector rounding = Vector::Zero(static_cast<Eigen::Index>(bodies.size()));
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (const int p : bodies[i]) {
      double& own = rounding(static_cast<Eigen::Index>(i));
      own = std::max(own, kRoundedForce * past[static_cast<std::size_t>(p)].force);
    }
  rigid_->setRounding(std::move(rounding));
}

Vector ContactBodies::amplitudes(int part, const Vector& motion) const {
  if (!areBound()) return parts_[part].free * motion.segment(free_.first[part], parts_[part].free.cols());
  return parts_[part].free * (together_.middleRows(free_.first[part], parts_[part].free.cols()) * motion);
}

void ContactBodies::addMotion(int place, const Subdomain& subdomain, const Vector& motion, Vector& values) const {
  if (motion.size() == 0) return;
  const RigidPart& part = parts_[partOf_[place]];
  if (part.free.cols() == 0) return;
  const Vector own = amplitudes(partOf_[place], motion);
  for (int dof = 0; dof < subdomain.dofs(); ++dof) {
    const Point moved = part.displacement(subdomain.mesh().point(subdomain.nodeOf(dof)), own, subdomain.components());
    const Point along = subdomain.direction(dof);
    values(dof) += moved[0] * along[0] + moved[1] * along[1] + moved[2] * along[2];
  }
}

}  // namespace suture
