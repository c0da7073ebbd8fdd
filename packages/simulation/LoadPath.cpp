#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Numbers.hpp>
#include <suture/base/Point.hpp>
#include <suture/simulation/LoadPath.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace suture {

namespace {

struct PairPast {
  int pair;
  ContactPair::Past past;
};

}  // namespace

LoadPath::LoadPath(const Comm& comm, const LoadSteps& steps, const PrescribedParts& parts) : comm_(comm), steps_(steps) {
  Packer packer;
  packer.put(parts);
  Unpacker(broadcast(comm, packer.bytes())).get(parts_);
}

void LoadPath::setTime(double time, ElasticModel& model, std::vector<SubdomainMesh>& meshes, Constraints& constraints) {
  presentTime_ = time;
  const std::vector<double> factors = steps_.at(time);
  for (Load& load : model.loads) {
    const Release* release = releaseOf(load);
    load.factor = release ? release->remaining(time) : factors[static_cast<std::size_t>(steps_.factorOf(load.name))];
  }

  std::map<GlobalId, Point> values;
  std::map<int, std::array<double, 3>> closed;
  for (std::size_t f = 0; f < parts_.rules.size(); ++f) {
    for (const RuleValue& rule : parts_.rules[f]) {
      Point& sum = values.try_emplace(rule.node, Point{0, 0, 0}).first->second;
      sum = plus(sum, scaled(factors[f], rule.value));
    }
    for (const PrescribedParts::Closing& gap : parts_.gaps[f])
      closed[gap.pair][static_cast<std::size_t>(gap.equation)] += factors[f] * gap.value;
  }
  const auto valueAt = [&](GlobalId node) {
    const auto found = values.find(node);
    return found == values.end() ? Point{0, 0, 0} : found->second;
  };
  const auto pastOf = [&](int pair) {
    const auto found = past_.find(pair);
    return found == past_.end() ? ContactPair::Past() : found->second;
  };
  for (SubdomainMesh& mesh : meshes) {
    if (!parts_.empty())
      for (NodeRule& rule : mesh.rules) rule.value = valueAt(mesh.globalNodes[rule.node]);
    for (ContactRow& row : mesh.contactRows) {
      row.pair.past = pastOf(row.pair.id);
      const std::vector<Point> directions = rowDirections(row.pair, mesh.dimension);
      const auto closing = closed.find(row.pair.id);
      for (std::size_t k = 0; k < row.equations.size(); ++k) {
        if (k == 0 && parts_.empty()) continue;
        double& gap = row.equations[k].gap;
        gap = k == 0 ? row.pair.gap : dot(row.pair.past.slip, directions[k]);
        if (closing != closed.end()) gap -= closing->second[k];
      }
    }
  }
  if (!parts_.empty())
    for (NodeRule& rule : constraints.rules) rule.value = valueAt(rule.node);
  for (ContactPair& pair : constraints.pairs) pair.past = pastOf(pair.id);
}

void LoadPath::release(const Release& release, std::map<GlobalId, Point> forces, ElasticModel& model) {
  Load load;
  load.kind = Load::Kind::NodalForces;
  load.name = "forces of parts removed at t = " + realText(release.begin());
  load.forces = std::move(forces);
  releases_.insert_or_assign(load.name, release);
  model.loads.push_back(std::move(load));
}

const Release* LoadPath::releaseOf(const Load& load) const {
  const auto found = load.kind == Load::Kind::NodalForces ? releases_.find(load.name) : releases_.end();
  return found == releases_.end() ? nullptr : &found->second;
}

std::vector<double> LoadPath::factorsAt(double time) const {
  std::vector<double> all = steps_.at(time);
  for (const auto& entry : releases_) all.push_back(entry.second.remaining(time));
  return all;
}

void LoadPath::accept(const std::vector<PairResult>& pairs, const std::vector<BodyForces>& forces) {
  if (!forces.empty()) carried_.resize(forces.size());
  for (std::size_t b = 0; b < forces.size(); ++b) carried_[b].take(forces[b]);
  std::vector<PairPast> now;
  for (const PairResult& pair : pairs) {
    if (!pair.kind.restrictsSliding || !pair.kind.separates) continue;
    const bool slides = pair.state.status == PairStatus::Slip && norm(pair.stepSlip()) > 0.0;
    now.push_back({pair.id, {pair.slip, pair.past.slipped || slides, pair.dissipated}});
  }
  broadcast(comm_, now);
  for (const PairPast& pair : now) past_[pair.pair] = pair.past;
}

void LoadPath::goOnFrom(PathState state) {
  rows = std::move(state.rows);
  length = state.length;
  carried_ = state.carried;
  safety = std::move(state.safety);
  moved = std::move(state.moved);
  if (moved) return;  // the solver of bodies that move far keeps the histories of its pairs
  for (const PathState::Pair& pair : state.pairs) past_[pair.id] = pair.past;
}

PathState LoadPath::state(const std::vector<PairResult>& pairs) const {
  PathState state{rows, length, {}, carried_, safety};
  for (const PairResult& pair : pairs) {
    const auto past = past_.find(pair.id);
    state.pairs.push_back({pair.id, past == past_.end() ? ContactPair::Past() : past->second, pair.force, pair.tangential});
  }
  state.moved = moved;
  return state;
}

int changedPairs(const std::vector<PairResult>& before, const std::vector<PairResult>& now) {
  const std::vector<const PairResult*> last = predecessors(before, now);
  int changed = 0;
  for (std::size_t i = 0; i < now.size(); ++i) changed += last[i] && last[i]->state.status != now[i].state.status;
  return changed;
}

int changedWithin(const std::vector<PairResult>& before, const std::vector<PairResult>& now) {
  const std::vector<const PairResult*> last = predecessors(before, now);
  int stopped = 0;
  for (std::size_t i = 0; i < now.size(); ++i)
    stopped += last[i] && last[i]->state.status == PairStatus::Slip && now[i].state.status == PairStatus::Stick;
  return changedPairs(before, now) - stopped;
}

}  // namespace suture
