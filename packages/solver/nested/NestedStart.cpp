#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/BoxTree.hpp>
#include <suture/partition/RigidLift.hpp>
#include <suture/solver/nested/NestedStart.hpp>
#include <suture/solver/nested/TriangleSearch.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <map>

namespace suture {

namespace {

struct Query {
  Point point;
  int body;
};

struct Answer {
  double outside = 1e300;  // how far the point is from the cell, in the cell's size; none found: infinity
  Point value{0, 0, 0};
};

/// State at a place of a contact: that of the nearest pair of another mesh there.
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
  Packer packer;
  std::vector<Query> mine;
  for (std::size_t k = 0; k < points.size(); ++k) mine.push_back({points[k], bodies[k]});
  packer.put(mine);
  const std::vector<std::string> queries = allGather(comm, packer.bytes());

  // Every rank answers everybody's queries from its own cells.
  std::map<int, std::string> answers;
  collectively(comm, "interpolating the coarse solution", [&] {
    std::vector<TriangleSearch> search;
    for (std::size_t s = 0; s < coarse.meshes.size(); ++s) search.emplace_back(coarse.meshes[s]);
    for (std::size_t rank = 0; rank < queries.size(); ++rank) {
      std::vector<Answer> found;
      for (const Query& query : Unpacker(queries[rank]).get<std::vector<Query>>()) {
        Answer best;
        for (std::size_t s = 0; s < search.size(); ++s) {
          if (coarse.meshes[s].body != query.body) continue;
          const TriangleSearch::Place place = search[s].find(query.point);
          if (place.outside >= best.outside) continue;
          best.outside = place.outside;
          best.value = {0, 0, 0};
          for (int corner = 0; corner < 3; ++corner)
            for (int k = 0; k < 2; ++k)
              best.value[k] += place.weights[corner] * coarse.meshes[s].total(coarse.solution.displacement[s], place.nodes[corner] * 2 + k);
        }
        found.push_back(best);
      }
      Packer reply;
      reply.put(found);
      answers[static_cast<int>(rank)] = reply.bytes();
    }
  });
  Matrix values = Matrix::Zero(static_cast<int>(points.size()), 2);
  std::vector<double> best(points.size(), 1e300);
  for (const auto& [rank, bytes] : swapWithNeighbours(comm, answers)) {
    const auto found = Unpacker(bytes).get<std::vector<Answer>>();
    for (std::size_t k = 0; k < found.size(); ++k)
      if (found[k].outside < best[k]) {
        best[k] = found[k].outside;
        for (int c = 0; c < 2; ++c) values(static_cast<int>(k), c) = found[k].value[c];
      }
  }
  return values;
}

Start nestedStart(const Comm& comm, const CoarseAnswer& coarse, const std::vector<SubdomainMesh>& meshes) {
  // The interface lies at nodes that several subdomains hold, and on contact lines; nothing else is asked for.
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

  const NearestState coarseState(onAllRanks(comm, coarse.solution.pairs));
  for (const SubdomainMesh& mesh : meshes)
    for (const ContactRow& row : mesh.contactRows)
      if (const ContactState* state = coarseState.at(row.pair.line, row.pair.position)) start.status[row.pair.id] = *state;
  return start;
}

}  // namespace suture
