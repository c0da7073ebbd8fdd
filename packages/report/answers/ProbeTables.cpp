#include <suture/base/Gather.hpp>
#include <suture/base/Point.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/OutputFolder.hpp>
#include <suture/report/answers/Answers.hpp>
#include <suture/report/answers/Probes.hpp>
#include <suture/report/answers/Tables.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <tuple>

namespace suture {

namespace {

/// Values at a point. Trivially copyable, since it is sent as bytes.
struct Row {
  GlobalId order = 0;  ///< number of the point, or of the node in the mesh
  int body = -1, unused = 0;
  double arc = 0.0;
  Point place{0, 0, 0}, displacement{0, 0, 0};
  std::array<double, 6> stress{};  // as in StressVector.hpp; in 2D the last two are zero
};

/// A side of a group, between two nodes of the mesh. Trivially copyable.
struct GroupSide {
  GlobalId first, second, between;  ///< between: -1 for a straight side

  bool operator<(const GroupSide& other) const { return std::tie(first, second) < std::tie(other.first, other.second); }
};

/// Stresses of a mesh's elements at their centroids, computed on first use.
class Centroids {
 public:
  Centroids(const Run& run, int mesh) : run_(run), mesh_(mesh) {}
  std::array<double, 6> at(int element) {
    if (!stresses_) {
      const SubdomainMesh& mesh = run_.subdomains[mesh_];
      const auto own = run_.solution.ownStresses.find(mesh_);
      stresses_ =
          own != run_.solution.ownStresses.end() ? own->second : elementStresses(mesh, run_.model, run_.solution.displacement[mesh_]);
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
  explicit Values(const Run& run) : run_(run) {
    for (std::size_t m = 0; m < run.subdomains.size(); ++m) centroids_.emplace_back(run, static_cast<int>(m));
  }

  /// \param weights  of the nodes of the element
  Row of(int m, int element, const std::vector<double>& weights) {
    const SubdomainMesh& mesh = run_.subdomains[m];
    const Span<const int> nodes = mesh.nodesOf(element);
    Row row;
    row.body = mesh.body;
    const bool recovered = !run_.solution.nodalStresses.empty() && !run_.solution.ownStresses.count(m);
    if (!recovered) row.stress = centroids_[m].at(element);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      if (weights[a] == 0.0) continue;
      row.place = plus(row.place, scaled(weights[a], mesh.point(nodes[a])));
      for (int k = 0; k < mesh.dimension; ++k)
        row.displacement[k] += weights[a] * mesh.total(run_.solution.displacement[m], Eigen::Index(nodes[a]) * mesh.dimension + k);
      for (Eigen::Index k = 0; recovered && k < run_.solution.nodalStresses[m].cols(); ++k)
        row.stress[std::size_t(k)] += weights[a] * run_.solution.nodalStresses[m](nodes[a], k);
    }
    return row;
  }

 private:
  const Run& run_;
  std::vector<Centroids> centroids_;
};

std::vector<Row> rowsOfPoints(const Run& run, const Probe& probe, const FoundPoints& found, Values& values) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < probe.points.size(); ++i) {
    const PointInElement& here = found.here[i];
    if (here.mesh < 0) continue;
    const SubdomainMesh& mesh = run.subdomains[here.mesh];
    ShapeJet jets[kMostCellNodes];
    shapeJets(mesh.cells[here.element], here.at, jets);
    std::vector<double> weights;
    for (std::size_t a = 0; a < mesh.nodesOf(here.element).size(); ++a) weights.push_back(jets[a].value);
    Row row = values.of(here.mesh, here.element, weights);
    row.order = static_cast<GlobalId>(i);
    row.place = probe.points[i].place;
    row.arc = norm(minus(row.place, probe.points[0].place));
    rows.push_back(row);
  }
  return rows;
}

/// One row per node and side; in 2D also collects this rank's sides of the group.
std::vector<Row> rowsOfGroup(const Run& run, const Probe& probe, Values& values, std::vector<GroupSide>& sides) {
  std::vector<Row> rows;
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
std::vector<Row> ofNodes(const std::vector<Row>& all, const std::vector<GroupSide>& sides) {
  std::map<GlobalId, std::pair<Row, int>> means;  // over the sides at a node
  for (const Row& row : all) {
    auto& [mean, count] = means.try_emplace(row.order, row, 0).first->second;
    if (count++ > 0)
      for (std::size_t k = 0; k < row.stress.size(); ++k) mean.stress[k] += row.stress[k];
  }
  std::vector<GlobalId> nodes = ordered(sides);
  if (sides.empty())
    for (const auto& entry : means) nodes.push_back(entry.first);
  std::vector<Row> rows;
  for (const GlobalId node : nodes) {
    const auto& [mean, count] = means.at(node);
    rows.push_back(mean);
    for (double& one : rows.back().stress) one /= count;
    if (rows.size() > 1 && !sides.empty()) {
      const Row& before = rows[rows.size() - 2];
      rows.back().arc = before.arc + norm(minus(rows.back().place, before.place));
    }
  }
  return rows;
}

std::string textOf(const Run& run, const std::vector<Row>& rows, bool ofGroup) {
  std::map<GlobalId, const PairResult*> pairs;
  if (ofGroup)
    for (const auto* list : {&run.solution.pairs, &run.solution.onAxis})
      for (const PairResult& pair : *list) pairs[pair.node] = &pair;
  std::string text = "arc_length,x,y,z,body,ux,uy,uz,sxx,syy,szz,sxy,syz,sxz,von_mises,principal_1,principal_3,gap,pressure\n";
  double place = 0.0, displacement = 0.0, largest = 0.0, gap = 0.0, pressure = 0.0;  // largest value of each kind
  for (const Row& row : rows) {
    place = std::max({place, norm(row.place), row.arc});
    displacement = std::max(displacement, norm(row.displacement));
    for (const double one : row.stress) largest = std::max(largest, std::abs(one));
  }
  for (const PairResult& pair : run.solution.pairs) {
    gap = std::max({gap, std::abs(pair.gap), std::abs(pair.initialGap), norm(pair.displacement)});
    pressure = std::max(pressure, std::abs(pair.pressure));
  }
  for (const Row& row : rows) {
    Matrix stress(1, run.model.dimension == 2 ? 4 : 6);
    for (Eigen::Index k = 0; k < stress.cols(); ++k) stress(0, k) = row.stress[std::size_t(k)];
    const Matrix principal = principalStresses(stress);
    const bool inPlane = run.model.dimension == 2;  // the out-of-plane stress is one of them
    const double most = inPlane ? std::max(principal(0, 0), row.stress[2]) : principal(0, 0),
                 least = inPlane ? std::min(principal(0, 1), row.stress[2]) : principal(0, 2);
    text += csvNumber(row.arc, place).substr(1);
    for (const double one : row.place) text += csvNumber(one, place);
    text += "," + csvField(bodyName(run, row.body));
    for (const double one : row.displacement) text += csvNumber(one, displacement);
    for (const double one : row.stress) text += csvNumber(one, largest);
    for (const double one : {vonMises(stress)[0], most, least}) text += csvNumber(one, largest);
    const auto pair = pairs.find(row.order);
    text += pair == pairs.end() ? ",,\n" : csvNumber(pair->second->gap, gap) + csvNumber(pair->second->pressure, pressure) + "\n";
  }
  return text;
}

}  // namespace

void writeProbes(const Run& run, const std::vector<Probe>& probes, const std::string& folder) {
  const std::vector<FoundPoints> found = locateProbes(run.comm, run.subdomains, run.model.bodies, probes);
  Values values(run);
  for (std::size_t p = 0; p < probes.size(); ++p) {
    const Probe& probe = probes[p];
    std::vector<Row> mine;
    std::vector<GroupSide> sides;
    collectively(run.comm, "evaluating the probe '" + probe.name + "'",
                 [&] { mine = probe.group.empty() ? rowsOfPoints(run, probe, found[p], values) : rowsOfGroup(run, probe, values, sides); });
    std::vector<Row> rows = joinOnRoot(run.comm, mine);
    const std::vector<GroupSide> all = joinOnRoot(run.comm, sides);
    collectivelyOnRoot(run.comm, "writing probes", [&] {
      if (probe.group.empty())
        std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.order < b.order; });
      else
        rows = ofNodes(rows, all);
      writeTextFile((std::filesystem::path(folder) / probe.fileName()).string(), textOf(run, rows, !probe.group.empty()));
    });
  }
}

}  // namespace suture
