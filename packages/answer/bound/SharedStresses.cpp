#include <suture/answer/bound/SharedStresses.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Gather.hpp>
#include <suture/base/Point.hpp>
#include <suture/partition/SubdomainRanks.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <unordered_map>

namespace suture {

namespace {

// Vertices of a side, the stress about their mean, the number of the material.
constexpr int kSentNumbers = 25;

bool hasFourVertices(const CellInfo& cell, int side) {
  const auto& nodes = cell.sideNodes[side];
  return std::count_if(nodes.begin(), nodes.end(), [&](int node) { return node < cell.vertices; }) == 4;
}

std::array<GlobalId, 4> fourVerticesOfSide(const SubdomainMesh& mesh, int element, int side) {
  const auto& nodes = cellInfo(mesh.cells[element]).sideNodes[side];
  std::array<GlobalId, 4> key;
  for (int i = 0; i < 4; ++i) key[i] = mesh.globalNodes[mesh.nodesOf(element)[nodes[i]]];
  std::sort(key.begin(), key.end());
  return key;
}

}  // namespace

SharedStresses::SharedStresses(const Comm& comm, const BoundedSolution& solution, const BoundKind& kind) {
  collectively(comm, "averaging stresses", [&] {
    std::set<std::string> unused;
    for (std::size_t m = 0; m < solution.meshes.size(); ++m) {
      const SubdomainMesh& mesh = solution.meshes[m];
      numbers_.emplace_back(std::size_t(mesh.elements()) * kMostSides, -1);
      BoundedField<3> field(solution, int(m), kind, unused);
      for (int e = 0; e < mesh.elements(); ++e) {
        if (isSimplex(mesh.cells[e])) continue;
        const CellInfo& cell = cellInfo(mesh.cells[e]);
        const SimplexLaw<3>& law = field.lawOf(e);
        Eigen::Vector3d centre;
        const LinearStress stress = field.linearStressOf(e, law, centre);
        const Material& material = solution.model.materialOf(mesh, e, mesh.body);
        const double number = law.compliance.sum() * (1.0 + material.density.value_or(0.0));
        for (int s = 0; s < int(cell.sideNodes.size()); ++s) {
          if (!hasFourVertices(cell, s)) continue;
          OfSide own{fourVerticesOfSide(mesh, e, s), stress, number};
          Eigen::Vector3d arm = -centre;
          for (int i = 0; i < 4; ++i) {
            const Point p = mesh.point(mesh.nodesOf(e)[cell.sideNodes[s][i]]);
            for (int k = 0; k < 3; ++k) arm[k] += 0.25 * p[k];
          }
          own.stress.col(0) += stress.rightCols<3>() * arm;
          numbers_.back()[std::size_t(e) * kMostSides + s] = int(sides_.size());
          sides_.push_back(own);
        }
      }
    }
    joinHere();
  });
  exchange(comm, solution);
}

void SharedStresses::join(OfSide& one, const LinearStress& stress, double material) {
  one.stress = 0.5 * (one.stress + stress);
  one.isOneMaterial = one.material == material;
}

/// Joins the sides of two cells of this rank.
void SharedStresses::joinHere() {
  std::vector<int> order(sides_.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return sides_[a].key < sides_[b].key; });
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    OfSide &one = sides_[order[i]], &other = sides_[order[i + 1]];
    if (one.key != other.key) continue;
    const LinearStress stress = one.stress;
    join(one, other.stress, other.material);
    join(other, stress, one.material);
    ++i;
  }
}

/// Joins those of cells of two ranks.
void SharedStresses::exchange(const Comm& comm, const BoundedSolution& solution) {
  const std::unordered_map<int, int> rankOf = ranksOfSubdomains(comm, solution.meshes);
  std::map<int, std::vector<GlobalId>> keys;
  std::map<int, std::vector<double>> values;
  std::map<Key, int> mine;
  for (std::size_t m = 0; m < solution.meshes.size(); ++m)
    for (const SubdomainMesh::SeamSide& seam : solution.meshes[m].seamSides) {
      const int rank = rankOf.at(seam.neighbour);
      if (rank == comm.getRank()) continue;
      std::vector<GlobalId>& own = keys[rank];
      const int number = numbers_[m][std::size_t(seam.element) * kMostSides + seam.side];
      if (number < 0) continue;
      const OfSide& side = sides_[number];
      mine[side.key] = number;
      own.insert(own.end(), side.key.begin(), side.key.end());
      values[rank].insert(values[rank].end(), side.stress.data(), side.stress.data() + side.stress.size());
      values[rank].push_back(side.material);
    }
  std::map<int, std::string> messages;
  for (const auto& [rank, own] : keys) {
    Packer packer;
    packer.put(own);
    packer.put(values[rank]);
    messages[rank] = std::move(packer).bytes();
  }
  for (const auto& [rank, bytes] : swapWithNeighbours(comm, messages)) {
    Unpacker unpacker(bytes);
    const auto received = unpacker.get<std::vector<GlobalId>>();
    const auto numbers = unpacker.get<std::vector<double>>();
    for (std::size_t i = 0; 4 * i < received.size(); ++i) {
      const auto found = mine.find({received[4 * i], received[4 * i + 1], received[4 * i + 2], received[4 * i + 3]});
      if (found == mine.end()) continue;
      const double* next = numbers.data() + kSentNumbers * i;
      join(sides_[found->second], Eigen::Map<const LinearStress>(next), next[24]);
    }
  }
}

}  // namespace suture
