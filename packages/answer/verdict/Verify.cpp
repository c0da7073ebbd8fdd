#include <suture/answer/verdict/Deformation.hpp>
#include <suture/answer/verdict/NodalForces.hpp>
#include <suture/answer/verdict/Verify.hpp>
#include <suture/answer/verdict/VerifyLift.hpp>
#include <suture/answer/verdict/VerifyPairs.hpp>
#include <suture/answer/verdict/VerifyPlaces.hpp>
#include <suture/base/Gather.hpp>
#include <suture/pairs/PairFrame.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <limits>
#include <map>

namespace suture {

namespace {

/// Sums over the nodes of one body.
struct BodySums {
  double loads = 0.0, contact = 0.0, reactions = 0.0, residual = 0.0, rounding = 0.0, roundingSquared = 0.0;
  Point resultant{0, 0, 0}, moment{0, 0, 0};
  static constexpr int count = 12;
};
static_assert(sizeof(BodySums) == BodySums::count * sizeof(double));

class Verifier {
 public:
  Verifier(const Comm& comm, const Answer& answer);
  Verification run();

 private:
  std::vector<std::vector<double>> cellsAlongContact(const SeamExchange& seams, bool hasRigidGroups) const;
  void gatherEnds(const std::vector<std::vector<double>>& cells);
  void sumBodies();
  void judgeBodies();
  void judgeNodes();
  void judgeSeams(const SeamExchange& seams);
  Verification conclude();

  /// A force at a node, starting at a row of NodalRows.
  Point at(int mesh, int node, int row) const { return pointOf(&nodes_[mesh](row, node), rows_.dimension); }
  Point moved(int mesh, int node) const { return vectorAt(answer_.displacement[mesh], node); }
  double lifted(const SubdomainMesh& mesh, int node) const {
    return mesh.lift.motion.size() > 0 ? length(vectorAt(mesh.lift.motion, node)) : 0.0;
  }
  Point vectorAt(const Vector& values, int node) const {
    return pointOf(values.data() + Eigen::Index(node) * rows_.dimension, rows_.dimension);
  }
  Finding place(int mesh, int node) const {
    Finding where;
    where.body = answer_.meshes[mesh].body;
    where.place = answer_.meshes[mesh].point(node);
    return where;
  }
  /// Component of load + contact - internal forces along the free axes of a node. `support` receives the unbalanced force in all axes.
  Point residual(int mesh, int node, const NodeRule* rule) const;

  const Comm& comm_;
  const Answer& answer_;
  const int bodies_;
  const double tolerance_;
  bool axisymmetric_ = false;
  NodalRows rows_;
  std::vector<Matrix> nodes_;                        // by mesh: NodalRows x nodes, summed over subdomains
  std::vector<Matrix> masters_;                      // likewise MasterRows x nodes; empty: no rigid groups
  std::vector<std::vector<const NodeRule*>> rules_;  // by mesh and node; null: free
  std::vector<RigidGroupNodes> rigid_;               // by mesh
  std::vector<PairEndShare> ends_;                   // on rank 0: of all ranks
  std::vector<Deformation> deformation_;
  std::vector<BodySums> sums_;
  std::vector<BodyScale> scales_;
  std::vector<BodyForces> now_;
  std::vector<Finding> worstNode_;  // per body: where the residual is largest on this rank
  Findings findings_;
  Balance balance_;
  Reactions reactions_;
};

Verifier::Verifier(const Comm& comm, const Answer& answer)
    : comm_(comm), answer_(answer), bodies_(int(answer.model.bodies.size())), tolerance_(answer.tolerance) {
  int mine[2] = {2, 0}, all[2];
  for (const SubdomainMesh& mesh : answer.meshes) {
    mine[0] = std::max(mine[0], mesh.dimension);
    mine[1] = std::max(mine[1], int(mesh.axisymmetric));
    rules_.emplace_back(mesh.nodes(), nullptr);
    for (const NodeRule& rule : mesh.rules) rules_.back()[rule.node] = &rule;
    rigid_.emplace_back(mesh.rigidGroups, mesh.dimension);
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 2, mine, all);
  rows_.dimension = all[0];
  axisymmetric_ = all[1] > 0;
}

/// Sizes of the cells at the nodes of each mesh. A subdomain that counts a master may have no element there: the others know the size.
std::vector<std::vector<double>> Verifier::cellsAlongContact(const SeamExchange& seams, bool hasRigidGroups) const {
  std::vector<std::vector<double>> all;
  for (const SubdomainMesh& mesh : answer_.meshes) all.push_back(edgesAlongContact(mesh));
  if (!hasRigidGroups) return all;
  std::vector<Matrix> sums;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Matrix& own = sums.emplace_back(Matrix::Zero(2, answer_.meshes[i].nodes()));
    for (std::size_t node = 0; node < all[i].size(); ++node)
      if (all[i][node] > 0.0) own.col(Eigen::Index(node)) << all[i][node], 1.0;
  }
  seams.sum(sums);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t node = 0; node < all[i].size(); ++node)
      if (const double count = sums[i](1, Eigen::Index(node)); count > 0.0) all[i][node] = sums[i](0, Eigen::Index(node)) / count;
  return all;
}

void Verifier::gatherEnds(const std::vector<std::vector<double>>& cells) {
  std::vector<PairEndShare> mine;
  for (std::size_t i = 0; i < answer_.meshes.size(); ++i) {
    const SubdomainMesh& mesh = answer_.meshes[i];
    std::map<int, const ContactRow*> rows;
    for (const ContactRow& row : mesh.contactRows) rows[row.pair.id] = &row;
    const std::vector<double>& edges = cells[i];
    for (const SubdomainMesh::ContactEnd& end : mesh.contactEnds) {
      if (!counts(mesh, end.node)) continue;
      const ContactRow& row = *rows.at(end.pair);
      const ContactPair& pair = row.pair;
      const Point u = moved(int(i), end.node);
      const double weight = pair.ends[end.end].weight;
      const Point whole = mesh.lift.motion.size() > 0 ? plus(u, vectorAt(mesh.lift.motion, end.node)) : u;
      Point shift{0, 0, 0};
      const Point past = mesh.pastSlip(pair);
      const double slidBefore = end.end == 0 ? norm(past) : 0.0;
      if (row.restrictsSliding()) {
        shift = scaled(weight, whole);
        if (end.end == 0) shift = minus(shift, past);
      }
      mine.push_back({end.pair, end.end, mesh.body, weight * dot(u, pair.normal), std::abs(weight) * length(u),
                      std::abs(weight) * lifted(mesh, end.node) + slidBefore, weight, nodes_[i](rows_.stiffness(), end.node),
                      nodes_[i](rows_.rounding(), end.node), pair.gap, pair.position, pair.normal, slidingPart(pair, shift), PairKind(row),
                      scaled(weight, whole), scaled(weight, mesh.point(end.node)), edges[end.node]});
    }
  }
  ends_ = joinOnRoot(comm_, mine);
}

Point Verifier::residual(int mesh, int node, const NodeRule* rule) const {
  if (rigid_[mesh].contains(node)) return pointOf(&masters_[mesh](MasterRows{rows_.dimension}.rest(), node), rows_.dimension);
  const Point outer = plus(at(mesh, node, rows_.applied()), at(mesh, node, rows_.contact())),
              rest = minus(outer, at(mesh, node, rows_.internal()));
  if (!rule) return rest;
  Point free{0, 0, 0};
  for (int k = 0; k < rows_.dimension; ++k)
    if (!rule->fixed[k]) free = plus(free, scaled(dot(rest, rule->axes[k]), rule->axes[k]));
  return free;
}

void Verifier::sumBodies() {
  sums_.assign(bodies_, {});
  scales_.assign(bodies_, {});
  now_.assign(bodies_, {});
  worstNode_.assign(bodies_, {});
  std::vector<double> prescribed(bodies_, 0.0), largestContact(bodies_, 0.0), largestNodal(bodies_, 0.0);
  for (std::size_t i = 0; i < answer_.meshes.size(); ++i) {
    const SubdomainMesh& mesh = answer_.meshes[i];
    BodySums& body = sums_[mesh.body];
    const Deformation& deformation = deformation_[mesh.body];
    for (int node = 0; node < mesh.nodes(); ++node) {
      if (!counts(mesh, node)) continue;
      const NodeRule* rule = rules_[i][node];
      const Point load = at(int(i), node, rows_.applied()), contact = at(int(i), node, rows_.contact());
      const Point support = minus(minus(at(int(i), node, rows_.internal()), load), contact);
      const Point rest = residual(int(i), node, rule), x = mesh.point(node);
      const bool isRigid = rigid_[i].contains(node);
      balance_.addNode(load, support, rule, rows_.dimension, isRigid);
      body.loads += length(load);
      body.contact += length(contact);
      largestContact[mesh.body] = std::max(largestContact[mesh.body], length(contact));
      largestNodal[mesh.body] = std::max({largestNodal[mesh.body], length(load), length(contact)});
      if (rule) body.reactions += length(isRigid ? support : plus(support, rest));
      if (rule)
        for (int k = 0; k < rows_.dimension; ++k)
          if (rule->fixed[k]) prescribed[mesh.body] = std::max(prescribed[mesh.body], std::abs(rule->value[k]));
      const double size = length(rest), rounding = nodes_[i](rows_.rounding(), node);
      body.residual += size;
      body.rounding += rounding;
      body.roundingSquared += rounding * rounding;
      body.resultant = plus(body.resultant, rest);
      body.moment = plus(body.moment, cross(minus(x, deformation.centre), rest));
      if (!(size <= worstNode_[mesh.body].value)) {
        worstNode_[mesh.body] = place(int(i), node);
        worstNode_[mesh.body].value = size;
      }
    }
  }
  std::vector<BodySums> all(bodies_);
  if (bodies_ > 0) Teuchos::reduceAll(comm_, Teuchos::REDUCE_SUM, bodies_ * BodySums::count, &sums_.front().loads, &all.front().loads);
  sums_ = all;
  const auto largest = [&](const std::vector<double>& mine) {
    std::vector<double> most(bodies_);
    if (bodies_ > 0) Teuchos::reduceAll(comm_, Teuchos::REDUCE_MAX, bodies_, mine.data(), most.data());
    return most;
  };
  prescribed = largest(prescribed);
  largestContact = largest(largestContact);
  largestNodal = largest(largestNodal);
  balance_.finish(comm_, axisymmetric_);
  reactions_.finish(comm_, axisymmetric_);
  for (int b = 0; b < bodies_; ++b) {
    const double force = 0.5 * (sums_[b].loads + sums_[b].contact + sums_[b].reactions);
    scales_[b] = {sums_[b].loads,
                  sums_[b].contact,
                  sums_[b].reactions,
                  largestContact[b],
                  largestNodal[b],
                  prescribed[b],
                  force,
                  deformation_[b].largest,
                  0.0,
                  0.0,
                  0.0,
                  sums_[b].residual,
                  sums_[b].rounding,
                  std::sqrt(sums_[b].roundingSquared)};
    now_[b] = {sums_[b].loads, prescribed[b], force, deformation_[b].largest};
  }
  if (comm_.getRank() == 0) scaleForces(ends_, now_, answer_.past, scales_);
  broadcast(comm_, scales_);
}

void Verifier::judgeBodies() {
  for (int b = 0; b < bodies_; ++b) {
    const BodySums& sums = sums_[b];
    const double force = scales_[b].force, extent = deformation_[b].extent, roundings = scales_[b].roundings();
    const double rounded = roundings * scales_[b].spread;
    const double allowed = Bounds::resultant.at(tolerance_) * force + rounded + Bounds::resultant.ofRounding(scales_[b]);
    Finding where = worstNode_[b];
    where.body = b;
    findings_.take(Quantity::Forces, axisymmetric_ ? std::abs(sums.resultant[1]) : length(sums.resultant), allowed, force, where);
    if (!axisymmetric_) findings_.take(Quantity::Moments, length(sums.moment), allowed * extent, force * extent, where);
    const double allowedSum = Bounds::residual.at(tolerance_) * force + roundings * sums.rounding + Bounds::residual.ofRounding(scales_[b]);
    findings_.take(Quantity::Residual, sums.residual, allowedSum, force, where);
    if (force > scales_[b].rounded + scales_[b].places && !scales_[b].carriesNothing())
      findings_.take(Quantity::Digits, rounded, Bounds::digits * force, force, where);
    if (const double turn = unexplainedTurn(deformation_, b); turn > 0.0)
      findings_.take(Quantity::Rotation, turn, Bounds::rotation, 1.0, where);
  }
}

void Verifier::judgeNodes() {
  for (std::size_t i = 0; i < answer_.meshes.size(); ++i) {
    const SubdomainMesh& mesh = answer_.meshes[i];
    const BodyScale& body = scales_[mesh.body];
    const double contact = std::max(body.largestContact, Bounds::idle * body.force);
    std::map<int, const ContactRow*> rows;
    for (const ContactRow& row : mesh.contactRows) rows[row.pair.id] = &row;
    std::vector<std::vector<Point>> taken(mesh.nodes());  // directions along which contact forces act
    for (const SubdomainMesh::ContactEnd& end : mesh.contactEnds) {
      const ContactRow& row = *rows.at(end.pair);
      if (!row.restrictsSliding()) {
        taken[end.node].push_back(row.pair.normal);
        continue;
      }
      const std::vector<Point> frame = pairFrame(row.pair, mesh.dimension);
      taken[end.node].insert(taken[end.node].end(), frame.begin(), frame.end());
    }
    for (int node = 0; node < mesh.nodes(); ++node) {
      if (!counts(mesh, node)) continue;
      const NodeRule* rule = rules_[i][node];
      const Point rest = residual(int(i), node, rule), u = moved(int(i), node);
      const bool isMaster = rigid_[i].contains(node) && masters_[i](MasterRows{rows_.dimension}.stiffness(), node) > 0.0;
      const double stiffness = isMaster ? masters_[i](MasterRows{rows_.dimension}.stiffness(), node) : nodes_[i](rows_.stiffness(), node),
                   rounding = isMaster ? masters_[i](MasterRows{rows_.dimension}.rounding(), node) : nodes_[i](rows_.rounding(), node),
                   rounded = body.roundings() * (body.carriesNothing() ? body.spread : rounding) / stiffness +
                             Bounds::node.ofRounding(body) / stiffness;
      Point along = rest;  // without directions of contact: checked by Contact and the pairs, and affected by round-off of stiff neighbours
      for (const Point& n : taken[node]) along = minus(along, scaled(dot(along, n), n));
      const double alone = length(along) / stiffness,
                   scale = std::max({body.deformation, body.lent / stiffness, body.largestNodal / stiffness}),
                   allowed = Bounds::node.at(tolerance_) * scale + rounded;
      if (findings_.isWorse(Quantity::Nodes, alone, allowed)) findings_.take(Quantity::Nodes, alone, allowed, scale, place(int(i), node));
      if (!taken[node].empty())
        findings_.take(Quantity::Contact, length(rest),
                       Bounds::contact.at(tolerance_) * contact + rounded * stiffness + Bounds::contact.ofRounding(body), contact,
                       place(int(i), node));
      if (!rule) continue;
      for (int k = 0; k < rows_.dimension; ++k) {
        if (!rule->fixed[k]) continue;
        double apart = dot(rule->axes[k], u) - rule->value[k], size = length(u) + std::abs(rule->value[k]);
        rigid_[i].forEachMaster(node, k, [&](int master, int component, double coefficient) {
          const double follows = coefficient * dot(rigid_[i].axis(master, component), moved(int(i), master));
          apart -= follows;
          size += std::abs(follows);
        });
        findings_.take(Quantity::Prescribed, std::abs(apart), Bounds::geometry * body.deformation + 8 * unitRoundoff * size,
                       body.deformation, place(int(i), node));
      }
    }
  }
}

void Verifier::judgeSeams(const SeamExchange& seams) {
  std::vector<Matrix> displacement;
  for (std::size_t i = 0; i < answer_.meshes.size(); ++i)
    displacement.emplace_back(Eigen::Map<const Matrix>(answer_.displacement[i].data(), rows_.dimension, answer_.meshes[i].nodes()));
  for (const SeamExchange::Difference& difference : seams.differences(displacement)) {
    const double deformation = scales_[answer_.meshes[difference.mesh].body].deformation;
    const Point u = moved(difference.mesh, difference.node);
    findings_.take(Quantity::Seams, difference.size, Bounds::geometry * deformation + 8 * unitRoundoff * length(u), deformation,
                   place(difference.mesh, difference.node));
  }
}

Verification Verifier::conclude() {
  Packer packer;
  packer.put(findings_);
  packer.put(worstNode_);
  Findings all = findings_;
  std::vector<Finding> worst = worstNode_;
  for (const std::string& bytes : gatherOnRoot(comm_, packer.bytes())) {
    Unpacker unpacker(bytes);
    all.take(unpacker.get<Findings>());
    const auto other = unpacker.get<std::vector<Finding>>();
    for (int b = 0; b < bodies_; ++b)
      if (!(other[b].value <= worst[b].value)) worst[b] = other[b];
  }
  // Sums of a body are reported at its worst node.
  for (const Quantity sum : {Quantity::Forces, Quantity::Moments, Quantity::Residual, Quantity::Digits})
    if (Finding& finding = all.all[std::size_t(sum)]; finding.body >= 0) finding.place = worst[finding.body].place;
  Packer verdict;
  for (int q = 0; q < kQuantities; ++q) {
    verdict.put(all.all[q].made);
    verdict.put(all.all[q].made ? all.all[q].value : 0.0);
    verdict.put(all.all[q].bound);
    verdict.put(whereText(all.all[q], answer_.model.bodies, answer_.pieces, rows_.dimension));
  }
  Unpacker unpacker(broadcast(comm_, verdict.bytes()));
  Verification result;
  result.balance = balance_;
  result.reactions = reactions_;
  result.forces = now_;
  for (int q = 0; q < kQuantities; ++q) {
    const auto made = unpacker.get<bool>();
    Check check;
    check.name = nameOf(Quantity(q));
    check.advice = adviceOf(Quantity(q), answer_.byMonolithic, answer_.converged);
    unpacker.get(check.value);
    unpacker.get(check.bound);
    unpacker.get(check.where);
    if (made || Quantity(q) < Quantity::Friction) result.checks.push_back(std::move(check));
  }
  return result;
}

Verification Verifier::run() {
  const SeamExchange seams(comm_, answer_.meshes);
  deformation_ = deformations(comm_, answer_.meshes, answer_.displacement, bodies_);
  NodalForces forces = nodalForces(comm_, answer_, seams);
  nodes_ = std::move(forces.nodes);
  masters_ = std::move(forces.masters);
  balance_ = forces.balance;
  reactions_ = std::move(forces.reactions);
  gatherEnds(cellsAlongContact(seams, forces.hasRigidGroups));
  sumBodies();
  judgeBodies();
  judgeNodes();
  judgeSeams(seams);
  verifyLift(comm_, answer_, seams, findings_);
  const std::vector<Deformation> motions = wholeMotions(comm_, answer_, deformation_);
  if (comm_.getRank() == 0) {
    verifyPairs(ends_, answer_.pairs, scales_, tolerance_, findings_);
    verifyPlaces({ends_, answer_.pairs, answer_.pieces, scales_, motions, Bounds::pair.at(tolerance_)}, findings_);
  }
  return conclude();
}

}  // namespace

Verification verify(const Comm& comm, const Answer& answer) { return Verifier(comm, answer).run(); }

}  // namespace suture
