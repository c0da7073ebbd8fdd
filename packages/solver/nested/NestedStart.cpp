#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/BoxTree.hpp>
#include <suture/mesh/CellSearch.hpp>
#include <suture/motion/RigidMotionLifting.hpp>
#include <suture/solver/nested/NestedStart.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace suture {

namespace {

struct Query {
  Point point;
  int body;
};

struct Answer {
  double outside =
      std::numeric_limits<double>::infinity();  // distance of the point from the cell, relative to its size; infinity: no cell found
  Point value{0, 0, 0};
};

enum class Where { InACell, NearestCell };

/// Coarse solution at points in this rank's subdomains.
class Interpolation {
 public:
  explicit Interpolation(const CoarseAnswer& coarse) : coarse_(coarse) {
    for (const SubdomainMesh& mesh : coarse.meshes) cells_.emplace_back(mesh);
  }

  Answer at(const Query& query, Where where) const {
    Answer best;
    for (std::size_t s = 0; s < cells_.size(); ++s) {
      if (coarse_.meshes[s].body != query.body) continue;
      const CellSearch::Place place = where == Where::InACell ? cells_[s].find(query.point) : cells_[s].nearest(query.point);
      if (place.outside < best.outside) best = {place.outside, valueAt(s, place)};
    }
    return best;
  }

 private:
  Point valueAt(std::size_t s, const CellSearch::Place& place) const {
    const SubdomainMesh& mesh = coarse_.meshes[s];
    const Span<const int> nodes = mesh.nodesOf(place.element);
    ShapeJet jets[kMostCellNodes];
    shapeJets(mesh.cells[place.element], place.at, jets);
    Point value{0, 0, 0};
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (int k = 0; k < mesh.dimension; ++k)
        value[k] += jets[a].value * mesh.total(coarse_.solution.displacement[s], Eigen::Index(nodes[a]) * mesh.dimension + k);
    return value;
  }

  const CoarseAnswer& coarse_;
  std::vector<CellSearch> cells_;
};

/// Best answer to each query of this rank; every rank evaluates all queries in its own cells. Collective.
std::vector<Answer> ask(const Comm& comm, const std::optional<Interpolation>& coarse, const std::vector<Query>& mine, Where where) {
  Packer packer;
  packer.put(mine);
  const std::vector<std::string> queries = allGather(comm, packer.bytes());
  std::map<int, std::string> answers;
  collectively(comm, "interpolating the coarse solution", [&] {
    for (std::size_t rank = 0; rank < queries.size(); ++rank) {
      std::vector<Answer> found;
      for (const Query& query : Unpacker(queries[rank]).get<std::vector<Query>>()) found.push_back(coarse->at(query, where));
      Packer reply;
      reply.put(found);
      answers[static_cast<int>(rank)] = reply.bytes();
    }
  });
  std::vector<Answer> best(mine.size());
  for (const auto& [rank, bytes] : swapWithNeighbours(comm, answers)) {
    const auto found = Unpacker(bytes).get<std::vector<Answer>>();
    for (std::size_t k = 0; k < found.size(); ++k)
      if (found[k].outside < best[k].outside) best[k] = found[k];
  }
  return best;
}

/// State at a point of a contact: that of the nearest pair of another mesh.
class NearestState {
 public:
  explicit NearestState(const std::vector<PairResult>& pairs) {
    std::map<int, std::vector<BoundingBox>> boxes;
    for (const PairResult& pair : pairs) {
      pairs_[pair.line].push_back(pair);
      boxes[pair.line].emplace_back();
      boxes[pair.line].back().include(pair.position);
    }
    for (const auto& [contact, own] : boxes) trees_.emplace(contact, BoxTree(own));
  }
  /// Null for a contact without pairs.
  const ContactState* at(int contact, const Point& place) const {
    const auto tree = trees_.find(contact);
    if (tree == trees_.end()) return nullptr;
    const std::vector<PairResult>& own = pairs_.at(contact);
    return &own[tree->second.nearest(place, [&](int i) { return norm(minus(own[i].position, place)); })].state;
  }

 private:
  std::map<int, std::vector<PairResult>> pairs_;  // by contact
  std::map<int, BoxTree> trees_;
};

std::vector<PairResult> onAllRanks(const Comm& comm, const std::vector<PairResult>& pairs) {
  std::vector<PairResult> all = pairs;
  broadcast(comm, all);
  return all;
}

}  // namespace

Matrix interpolate(const Comm& comm, const CoarseAnswer& coarse, const std::vector<Point>& points, const std::vector<int>& bodies) {
  std::vector<Query> mine, beside;
  for (std::size_t k = 0; k < points.size(); ++k) mine.push_back({points[k], bodies[k]});
  std::optional<Interpolation> interpolation;
  collectively(comm, "interpolating the coarse solution", [&] { interpolation.emplace(coarse); });
  std::vector<Answer> answers = ask(comm, interpolation, mine, Where::InACell);
  std::vector<std::size_t> missing;  // points outside a curved side of the coarse mesh
  for (std::size_t k = 0; k < answers.size(); ++k)
    if (!std::isfinite(answers[k].outside)) missing.push_back(k), beside.push_back(mine[k]);
  if (!unionOverRanks(comm, std::vector<int>(missing.empty() ? 0 : 1)).empty()) {
    const std::vector<Answer> nearest = ask(comm, interpolation, beside, Where::NearestCell);
    for (std::size_t k = 0; k < missing.size(); ++k) answers[missing[k]] = nearest[k];
  }
  Matrix values(static_cast<int>(points.size()), 3);
  for (std::size_t k = 0; k < answers.size(); ++k)
    for (int c = 0; c < 3; ++c) values(static_cast<int>(k), c) = answers[k].value[c];
  return values;
}

namespace {

/// Discretisation error of a finer mesh at the best possible rate, order / dimension; 0: that of the coarse mesh is unknown. Collective.
double predictedError(const Comm& comm, const CoarseAnswer& coarse, const std::vector<SubdomainMesh>& meshes) {
  if (!coarse.solution.discretisation) return 0.0;
  double mine[2] = {0.0, 0.0}, elements[2];
  int rate[2] = {1, 2}, largest[2];
  for (const SubdomainMesh& mesh : coarse.meshes) mine[0] += mesh.elements();
  for (const SubdomainMesh& mesh : meshes) {
    mine[1] += mesh.elements();
    rate[1] = mesh.dimension;
    for (const Cell cell : mesh.cells) rate[0] = std::max(rate[0], cellInfo(cell).order);
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 2, mine, elements);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 2, rate, largest);
  return coarse.solution.discretisation->energyNorm * std::pow(std::min(1.0, elements[0] / elements[1]), double(largest[0]) / largest[1]);
}

}  // namespace

Start nestedStart(const Comm& comm, const CoarseAnswer& coarse, const std::vector<SubdomainMesh>& meshes) {
  // Only interface values are needed: at nodes of several subdomains, and on contacts.
  std::vector<Point> points;
  std::vector<int> bodies;
  std::vector<std::vector<int>> nodes(meshes.size());
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    const SubdomainMesh& mesh = meshes[s];
    std::vector<char> wanted(mesh.nodes(), 0);
    for (int node = 0; node < mesh.nodes(); ++node) wanted[node] = !mesh.others(node).empty();
    for (const SubdomainMesh::ContactEnd& end : mesh.contactEnds) wanted[end.node] = 1;
    for (int node = 0; node < mesh.nodes(); ++node)
      if (wanted[node]) {
        nodes[s].push_back(node);
        points.push_back(mesh.point(node));
        bodies.push_back(mesh.body);
      }
  }
  const Matrix values = interpolate(comm, coarse, points, bodies);
  Start start;
  int row = 0;
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    const int d = meshes[s].dimension;
    Vector displacement = Vector::Zero(Eigen::Index(meshes[s].nodes()) * d);
    for (const int node : nodes[s]) {
      for (int k = 0; k < d; ++k) displacement(node * d + k) = values(row, k);
      ++row;
    }
    start.displacement.push_back(besideLift(meshes[s], std::move(displacement)));
  }

  start.predictedError = predictedError(comm, coarse, meshes);
  const NearestState coarseState(onAllRanks(comm, coarse.solution.pairs));
  for (const SubdomainMesh& mesh : meshes)
    for (const ContactRow& row : mesh.contactRows)
      if (const ContactState* state = coarseState.at(row.pair.line, row.pair.position)) start.status[row.pair.id] = *state;
  return start;
}

}  // namespace suture
