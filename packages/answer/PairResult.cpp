#include <suture/answer/PairResult.hpp>
#include <suture/base/Gather.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <map>

namespace suture {

namespace {

constexpr double kOneSided = 0.5;  // sum of a pair's weights, one in magnitude with an obstacle and zero within a body

struct EndShare {
  int pair, end, body;
  Point displacement;  // without the lift
  Point motion;        // motion of the lift
  Point onBody;        // displacement of the node under a coating, or of the node itself
};

/// A pair with its past slip and its gap as in the scene, without lift, and the properties of its law.
struct Carried {
  ContactPair pair;
  double gap;
  PairKind kind;
  GlobalId node;  // node of the body

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.pair), each(self.gap), each(self.kind), each(self.node);
  }
};

}  // namespace

void PairResult::open() {
  state = PairStatus::Open;
  force = pressure = bound = 0.0;
  dissipated = past.dissipated;
  tangential = {0, 0, 0};
}

Point slipOf(const ContactPair& pair, const std::vector<Point>& ofEnds) {
  double sum = 0.0, size = 0.0;
  for (const PairEnd& end : pair.ends) sum += end.weight, size += std::abs(end.weight);
  const Point common = std::abs(sum) <= kBalanced * size ? ofEnds.front() : Point{0, 0, 0};
  Point jump{0, 0, 0};
  for (std::size_t end = 0; end < pair.ends.size(); ++end) jump = plus(jump, scaled(pair.ends[end].weight, minus(ofEnds[end], common)));
  return slidingPart(pair, jump);
}

PairResult pairResult(const ContactPair& pair, const PairForce& force, const std::vector<Point>& ofEnds, const PairKind& kind,
                      const std::vector<Point>& ofLift) {
  PairResult result;
  result.kind = kind;
  result.past = pair.past;
  result.tangential = force.tangential;
  result.slip = slipOf(pair, ofEnds);
  result.id = pair.id;
  result.node = pair.node();
  result.line = pair.line;
  result.piece = pair.piece;
  result.state = force.state;
  result.initialGap = result.gap = pair.gap;
  for (std::size_t end = 0; end < pair.ends.size(); ++end)
    for (int k = 0; k < 3; ++k) result.gap -= pair.ends[end].weight * ofEnds[end][k] * pair.normal[k];
  result.force = force.force;
  result.pressure = pair.length > 0.0 ? force.force / pair.length : 0.0;
  result.length = pair.length;
  result.arc = pair.arc;
  result.position = pair.position;
  result.displacement = ofEnds.front();
  if (!ofLift.empty()) {
    result.displacement = plus(result.displacement, ofLift.front());
    result.slip = plus(result.slip, slipOf(pair, ofLift));
  }
  result.normal = pair.normal;
  if (result.isBounded()) result.bound = force.state.largest(force.force);
  result.dissipated = pair.past.dissipated;
  if (force.state.status == PairStatus::Slip) result.dissipated += dot(result.tangential, result.stepSlip());
  return result;
}

std::vector<const PairResult*> predecessors(const std::vector<PairResult>& before, const std::vector<PairResult>& now) {
  const auto placeOf = [](const PairResult& pair) { return std::pair(pair.line, pair.node); };
  std::map<std::pair<int, GlobalId>, const PairResult*> of;
  for (const PairResult& pair : before) of[placeOf(pair)] = &pair;
  std::vector<const PairResult*> all;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (i < before.size() && placeOf(before[i]) == placeOf(now[i])) {  // pairs that did not change
      all.push_back(&before[i]);
      continue;
    }
    const auto found = of.find(placeOf(now[i]));
    all.push_back(found == of.end() ? nullptr : found->second);
  }
  return all;
}

std::vector<PairResult> axisResults(const std::vector<ContactPiece>& pieces, const std::vector<PairResult>& pairs) {
  std::vector<PairResult> results;
  for (const ContactPiece& piece : pieces)
    for (const AxisPoint& point : piece.onAxis) {
      const PairResult &near = pairs.at(point.pairs[0]), &far = pairs.at(point.pairs[1]);
      PairResult result = near;
      result.id = -1;
      result.node = point.node;
      result.arc = point.arc;
      result.position = point.position;
      result.normal = point.normal;
      result.force = result.dissipated = 0.0;
      result.tangential = result.slip = {0, 0, 0};  // all radial directions are equivalent
      const bool bothClosed = near.state.closed() && far.state.closed();
      if (bothClosed) result.pressure = std::max(0.0, point.pressure[0] * near.pressure + point.pressure[1] * far.pressure);
      const auto at = [&](double a, double b) { return point.value[0] * a + point.value[1] * b; };
      result.initialGap = at(near.initialGap, far.initialGap);
      result.gap = at(near.gap, far.gap);
      for (int k = 0; k < 3; ++k) result.displacement[k] = at(near.displacement[k], far.displacement[k]);
      result.displacement[0] = 0.0;  // on the axis
      results.push_back(result);
    }
  return results;
}

std::vector<PairResult> pairResults(const Comm& comm, const std::vector<const SubdomainMesh*>& meshes,
                                    const std::vector<Vector>& displacement, const std::vector<PairForce>& forces) {
  std::vector<EndShare> ends;
  std::map<int, Carried> carried;  // the pairs whose carrying node this rank counts
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const SubdomainMesh& mesh = *meshes[i];
    std::map<int, const ContactRow*> known;
    for (const ContactRow& row : mesh.contactRows) known[row.pair.id] = &row;
    const std::map<int, int> under = nodesUnderCoatings(mesh);
    for (const SubdomainMesh::ContactEnd& end : mesh.contactEnds) {
      if (!counts(mesh, end.node)) continue;
      EndShare share{end.pair, end.end, mesh.body, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
      const auto inner = under.find(end.node);
      const int onBody = inner == under.end() ? end.node : inner->second;
      for (int k = 0; k < mesh.dimension; ++k) {
        const Eigen::Index at = Eigen::Index(end.node) * mesh.dimension + k;
        share.displacement[k] = displacement[i][at];
        share.onBody[k] = displacement[i][Eigen::Index(onBody) * mesh.dimension + k];
        if (mesh.lift.motion.size() > 0) share.motion[k] = mesh.lift.motion[at];
      }
      ends.push_back(share);
      if (end.end != 0) continue;
      const ContactRow& row = *known.at(end.pair);
      const auto before = mesh.lift.gaps.find(end.pair);
      Carried& own = carried[end.pair] = {row.pair, before == mesh.lift.gaps.end() ? row.pair.gap : before->second, PairKind(row),
                                          mesh.globalNodes[static_cast<std::size_t>(onBody)]};
      own.pair.past.slip = mesh.pastSlip(row.pair);
    }
  }
  Packer packer;
  packer.put(carried);
  std::map<int, Carried> pairs;
  for (const std::string& bytes : gatherOnRoot(comm, packer.bytes())) pairs.merge(Unpacker(bytes).get<std::map<int, Carried>>());
  const std::vector<EndShare> allEnds = joinOnRoot(comm, ends);
  std::vector<PairForce> allForces = joinOnRoot(comm, forces);

  std::vector<PairResult> results;
  collectivelyOnRoot(comm, "gathering the contact pairs", [&] {
    std::sort(allForces.begin(), allForces.end(), [](const PairForce& a, const PairForce& b) { return a.id < b.id; });
    if (allForces.size() != pairs.size()) throw InternalError("the numbers of contact forces and pairs differ");
    std::map<int, double> shortening;
    std::map<int, Point> ofCarriers;                    // displacement of the body at the carrying node
    std::map<int, std::vector<Point>> ofEnds, motions;  // without the lift, and of the lift if there is one
    std::map<int, std::map<int, double>> weights;       // sum of each body's weights; individual mortar weights may have either sign
    for (const auto& [id, carrier] : pairs) ofEnds[id].resize(carrier.pair.ends.size());
    for (const EndShare& end : allEnds) {
      ofEnds.at(end.pair).at(end.end) = end.displacement;
      const ContactPair& pair = pairs.at(end.pair).pair;
      shortening[end.pair] -= pair.ends.at(end.end).weight * dot(pair.normal, minus(end.displacement, end.onBody));
      if (end.end == 0) ofCarriers[end.pair] = plus(end.onBody, end.motion);
      weights[end.pair][end.body] += pairs.at(end.pair).pair.ends.at(end.end).weight;
      if (end.motion != Point{0, 0, 0}) {
        std::vector<Point>& motion = motions[end.pair];
        motion.resize(ofEnds.at(end.pair).size());
        motion[end.end] = end.motion;
      }
    }
    for (const PairForce& force : allForces) {
      const auto pair = pairs.find(force.id);
      if (pair == pairs.end()) throw InternalError("a contact force for an unknown pair");
      const auto motion = motions.find(force.id);
      PairResult& result = results.emplace_back(pairResult(pair->second.pair, force, ofEnds.at(force.id), pair->second.kind,
                                                           motion == motions.end() ? std::vector<Point>() : motion->second));
      result.initialGap = pair->second.gap;
      result.node = pair->second.node;
      result.displacement = ofCarriers.at(force.id);
      result.shortening = shortening.at(force.id);
      const std::map<int, double>& ofBodies = weights.at(force.id);
      for (const auto& [body, weight] : ofBodies) result.bodies[weight > 0.0 ? 0 : 1] = body;
      // A body on both sides: its weights sum to zero.
      if (ofBodies.size() == 1 && std::abs(ofBodies.begin()->second) < kOneSided)
        result.bodies = {ofBodies.begin()->first, ofBodies.begin()->first};
    }
  });
  return results;
}

}  // namespace suture
