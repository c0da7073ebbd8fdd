#include <suture/base/Gather.hpp>
#include <suture/base/Point.hpp>
#include <suture/report/StressAxes.hpp>
#include <suture/report/answers/ProbeValues.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

namespace suture {

namespace {

/// A side of a group, between two nodes of the mesh. Trivially copyable.
struct GroupSide {
  GlobalId first, second, between;  ///< between: -1 for a straight side

  bool operator<(const GroupSide& other) const { return std::tie(first, second) < std::tie(other.first, other.second); }
};

/// Stresses of a mesh's elements at their centroids, in the axes of the run, computed on first use.
class Centroids {
 public:
  Centroids(const Run& run, int mesh) : run_(run), mesh_(mesh) {}
  std::array<double, 6> at(int element) {
    if (!stresses_) {
      const SubdomainMesh& mesh = run_.subdomains[mesh_];
      const auto own = run_.solution.ownStresses.find(mesh_);
      stresses_ = inStressAxes(
          run_, mesh,
          own != run_.solution.ownStresses.end() ? own->second : elementStresses(mesh, run_.model, run_.solution.displacement[mesh_]));
    }
    std::array<double, 6> stress{};
    for (Eigen::Index k = 0; k < stresses_->cols(); ++k) stress[std::size_t(k)] = (*stresses_)(element, k);
    return stress;
  }

 private:
  const Run& run_;
  int mesh_;
  std::optional<Matrix> stresses_;
};

class Values {
 public:
  Values(const Run& run, const std::vector<Matrix>& nodal) : run_(run) {
    for (std::size_t m = 0; m < run.subdomains.size(); ++m) centroids_.emplace_back(run, static_cast<int>(m));
    for (std::size_t m = 0; m < nodal.size(); ++m) nodal_.push_back(inStressAxes(run, run.subdomains[m], nodal[m]));
  }

  /// \param weights  of the nodes of the element
  ProbeValue of(int m, int element, const std::vector<double>& weights) {
    const SubdomainMesh& mesh = run_.subdomains[m];
    const Span<const int> nodes = mesh.nodesOf(element);
    ProbeValue row;
    row.body = mesh.body;
    const bool recovered = !nodal_.empty() && !run_.solution.ownStresses.count(m);
    if (!recovered) row.stress = centroids_[m].at(element);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      if (weights[a] == 0.0) continue;
      row.place = plus(row.place, scaled(weights[a], mesh.point(nodes[a])));
      for (int k = 0; k < mesh.dimension; ++k)
        row.displacement[k] += weights[a] * mesh.fromDrawn(run_.solution.displacement[m], Eigen::Index(nodes[a]) * mesh.dimension + k);
      for (Eigen::Index k = 0; recovered && k < nodal_[m].cols(); ++k) row.stress[std::size_t(k)] += weights[a] * nodal_[m](nodes[a], k);
    }
    return row;
  }

 private:
  const Run& run_;
  std::vector<Matrix> nodal_;
  std::vector<Centroids> centroids_;
};

std::vector<ProbeValue> rowsOfPoints(const Run& run, const Probe& probe, const FoundPoints& found, Values& values) {
  std::vector<ProbeValue> rows;
  for (std::size_t i = 0; i < probe.points.size(); ++i) {
    const PointInElement& here = found.here[i];
    if (here.mesh < 0) continue;
    const SubdomainMesh& mesh = run.subdomains[here.mesh];
    ShapeJet jets[kMostCellNodes];
    shapeJets(mesh.cells[here.element], here.at, jets);
    std::vector<double> weights;
    for (std::size_t a = 0; a < mesh.nodesOf(here.element).size(); ++a) weights.push_back(jets[a].value);
    ProbeValue row = values.of(here.mesh, here.element, weights);
    row.order = static_cast<GlobalId>(i);
    row.place = probe.points[i].place;
    row.arc = norm(minus(row.place, probe.points[0].place));
    rows.push_back(row);
  }
  return rows;
}

/// One row per node and side; in 2D also collects this rank's sides of the group.
std::vector<ProbeValue> rowsOfGroup(const Run& run, const Probe& probe, Values& values, std::vector<GroupSide>& sides) {
  std::vector<ProbeValue> rows;
  for (std::size_t m = 0; m < run.subdomains.size(); ++m) {
    const SubdomainMesh& mesh = run.subdomains[m];
    const auto group = mesh.sideGroups.find(probe.group);
    if (group == mesh.sideGroups.end()) continue;
    for (const Side& side : group->second) {
      const std::vector<int>& corners = cellInfo(mesh.cells[side.element]).sideNodes[side.side];
      const Span<const int> nodes = mesh.nodesOf(side.element);
      const auto global = [&](std::size_t k) { return k < corners.size() ? mesh.globalNodes[nodes[corners[k]]] : GlobalId(-1); };
      if (mesh.dimension == 2) sides.push_back({global(0), global(1), global(2)});
      for (std::size_t k = 0; k < corners.size(); ++k) {
        std::vector<double> weights(nodes.size(), 0.0);
        weights[corners[k]] = 1.0;
        rows.push_back(values.of(static_cast<int>(m), side.element, weights));
        rows.back().order = global(k);
      }
    }
  }
  return rows;
}

/// Nodes ordered along the sides, chain by chain; a chain starts at an end, or at its lowest node if it is closed.
std::vector<GlobalId> ordered(std::vector<GroupSide> sides) {
  std::sort(sides.begin(), sides.end());  // independent of the order of ranks
  std::map<GlobalId, std::vector<std::size_t>> at;
  for (std::size_t i = 0; i < sides.size(); ++i) at[sides[i].first].push_back(i), at[sides[i].second].push_back(i);
  std::vector<char> done(sides.size(), 0);
  std::vector<GlobalId> nodes;
  const auto walk = [&](GlobalId node) {
    nodes.push_back(node);
    while (true) {
      const std::vector<std::size_t>& own = at.at(node);
      const auto isNext = [&](std::size_t i) { return !done[i] && sides[i].first == node; };
      auto next = std::find_if(own.begin(), own.end(), isNext);
      if (next == own.end()) next = std::find_if(own.begin(), own.end(), [&](std::size_t i) { return !done[i]; });
      if (next == own.end()) return;
      const GroupSide& side = sides[*next];
      done[*next] = 1;
      if (side.between >= 0) nodes.push_back(side.between);
      node = side.first == node ? side.second : side.first;
      nodes.push_back(node);
    }
  };
  const auto hasMore = [&](const std::vector<std::size_t>& own) {
    return std::any_of(own.begin(), own.end(), [&](std::size_t i) { return !done[i]; });
  };
  // An open chain with the body on its left starts at a node where a side begins and none ends.
  for (const auto& [node, own] : at)
    if (own.size() == 1 && sides[own[0]].first == node && hasMore(own)) walk(node);
  for (const auto& [node, own] : at)
    if (hasMore(own)) walk(node);
  return nodes;
}

/// One row per node: in 2D ordered along the sides, on a surface by number.
std::vector<ProbeValue> ofNodes(const std::vector<ProbeValue>& all, const std::vector<GroupSide>& sides) {
  std::map<GlobalId, std::pair<ProbeValue, int>> means;  // over the sides at a node
  for (const ProbeValue& row : all) {
    auto& [mean, count] = means.try_emplace(row.order, row, 0).first->second;
    if (count++ > 0)
      for (std::size_t k = 0; k < row.stress.size(); ++k) mean.stress[k] += row.stress[k];
  }
  std::vector<GlobalId> nodes = ordered(sides);
  if (sides.empty())
    for (const auto& entry : means) nodes.push_back(entry.first);
  std::vector<ProbeValue> rows;
  for (const GlobalId node : nodes) {
    const auto& [mean, count] = means.at(node);
    rows.push_back(mean);
    for (double& one : rows.back().stress) one /= count;
    if (rows.size() > 1 && !sides.empty()) {
      const ProbeValue& before = rows[rows.size() - 2];
      rows.back().arc = before.arc + norm(minus(rows.back().place, before.place));
    }
  }
  return rows;
}

/// Adds gap and pressure at the nodes that carry pairs. On rank 0.
void addPairs(const Solution& solution, std::vector<ProbeValue>& rows) {
  std::map<GlobalId, const PairResult*> pairs;
  for (const auto* list : {&solution.pairs, &solution.onAxis})
    for (const PairResult& pair : *list) pairs[pair.node] = &pair;
  for (ProbeValue& row : rows) {
    const auto pair = pairs.find(row.order);
    if (pair == pairs.end()) continue;
    row.gap = pair->second->gap;
    row.pressure = pair->second->pressure;
  }
}

}  // namespace

std::vector<std::vector<ProbeValue>> probeValues(const Run& run, const std::vector<Probe>& probes, const std::vector<Matrix>& nodal) {
  const std::vector<FoundPoints> found = locateProbes(run.comm, run.subdomains, run.model.bodies, probes);
  Values values(run, nodal);
  std::vector<std::vector<ProbeValue>> all;
  for (std::size_t p = 0; p < probes.size(); ++p) {
    const Probe& probe = probes[p];
    std::vector<ProbeValue> mine;
    std::vector<GroupSide> sides;
    collectively(run.comm, "evaluating the probe '" + probe.name + "'",
                 [&] { mine = probe.group.empty() ? rowsOfPoints(run, probe, found[p], values) : rowsOfGroup(run, probe, values, sides); });
    std::vector<ProbeValue> rows = joinOnRoot(run.comm, mine);
    const std::vector<GroupSide> ofAll = joinOnRoot(run.comm, sides);
    collectivelyOnRoot(run.comm, "evaluating the probe '" + probe.name + "'", [&] {
      if (probe.group.empty()) {
        std::sort(rows.begin(), rows.end(), [](const ProbeValue& a, const ProbeValue& b) { return a.order < b.order; });
      } else {
        rows = ofNodes(rows, ofAll);
        addPairs(run.solution, rows);
      }
    });
    all.push_back(std::move(rows));
  }
  return all;
}

PrincipalExtremes principalExtremes(const ProbeValue& value, int dimension) {
  Matrix stress(1, dimension == 2 ? 4 : 6);
  for (Eigen::Index k = 0; k < stress.cols(); ++k) stress(0, k) = value.stress[std::size_t(k)];
  const Matrix principal = principalStresses(stress);
  const bool inPlane = dimension == 2;  // the out-of-plane stress is one of them
  return {vonMises(stress)[0], inPlane ? std::max(principal(0, 0), value.stress[2]) : principal(0, 0),
          inPlane ? std::min(principal(0, 1), value.stress[2]) : principal(0, 2)};
}

}  // namespace suture
