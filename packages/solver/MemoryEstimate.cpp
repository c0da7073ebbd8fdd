#include <suture/algebra/CostModel.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Memory.hpp>
#include <suture/base/MpiHandle.hpp>
#include <suture/solver/MemoryEstimate.hpp>

#include <mpi.h>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace suture {

namespace {

constexpr double kProgram = 55.0;  // megabytes in use when the estimate is made

// Pairs of nodes of an element, weighted by the share of this element: one inside, one half on a side, and on an edge in 3D the typical
// value in meshes of hexahedra or tetrahedra.
double pairsOf(Cell cell) {
  const CellInfo& info = cellInfo(cell);
  std::map<std::pair<int, int>, int> sides;  // pair of nodes -> number of sides with both
  for (const auto& nodes : info.sideNodes)
    for (const int a : nodes)
      for (const int b : nodes)
        if (a < b) ++sides[{a, b}];
  double sum = 0.5 * static_cast<double>(info.nodes * (info.nodes - 1));
  for (const auto& entry : sides) sum -= entry.second == 1 ? 0.5 : isSimplex(cell) ? 0.8 : 0.75;
  return sum;
}

// Number of pairs of nodes that share an element.
double couplings(const SubdomainMesh& mesh) {
  double sum = 0.0;
  for (std::size_t begin = 0, end = 0; begin < mesh.cells.size(); begin = end) {  // runs of one shape
    while (end < mesh.cells.size() && mesh.cells[end] == mesh.cells[begin]) ++end;
    sum += static_cast<double>(end - begin) * pairsOf(mesh.cells[begin]);
  }
  return sum;
}

/// Contact rows of a rank.
struct Rows {
  std::unordered_map<GlobalId, int> unknownsOf;  // node of the mesh -> number of its unknowns in rows
  double bytes = 0.0;                            // bytes of the rows in all subdomains; each has all rows of its clusters
  double terms = 0.0, squares = 0.0;             // sum of the numbers of terms of mortar rows, and of their squares

  explicit Rows(const std::vector<SubdomainMesh>& meshes) {
    std::unordered_set<int> pairs;
    std::unordered_set<GlobalId> unknowns;
    for (const SubdomainMesh& mesh : meshes)
      for (const ContactRow& row : mesh.contactRows) {
        bytes += sizeof(ContactRow) + row.pair.ends.size() * sizeof(PairEnd);
        const bool isNew = pairs.insert(row.pair.id).second;
        for (const ContactRow::Equation& equation : row.equations) {
          bytes += sizeof equation + equation.dofs.size() * (sizeof(GlobalId) + sizeof(double) + sizeof(Point));
          if (!isNew) continue;
          const auto size = static_cast<double>(equation.dofs.size());
          if (size > 2) terms += size, squares += size * size;
          for (const GlobalId unknown : equation.dofs)
            if (unknowns.insert(unknown).second) ++unknownsOf[unknown / mesh.dimension];
        }
      }
  }
};

/// Unknowns of a subdomain at seams and in contact rows.
double boundaryUnknowns(const SubdomainMesh& mesh, const Rows& rows) {
  std::vector<char> counted(mesh.nodes(), 0);
  double sum = 0.0;
  for (int node = 0; node < mesh.nodes(); ++node)
    if (!mesh.others(node).empty()) {
      counted[node] = 1;
      sum += mesh.dimension;
    }
  for (const SubdomainMesh::ContactEnd& end : mesh.contactEnds) {
    if (counted[end.node]) continue;
    counted[end.node] = 1;
    if (const auto found = rows.unknownsOf.find(mesh.globalNodes[end.node]); found != rows.unknownsOf.end()) sum += found->second;
  }
  return sum;
}

}  // namespace

double estimatedMegabytes(const std::vector<SubdomainMesh>& meshes) {
  const Rows rows(meshes);
  double bytes = 0.0;
  for (const SubdomainMesh& mesh : meshes) {
    const double nodes = mesh.nodes(), d = mesh.dimension, n = std::max(2.0, nodes * d);
    const double b = boundaryUnknowns(mesh, rows), c = couplings(mesh);
    bytes += 12 * (d * d * c + d * (d + 1) / 2 * nodes);
    if (mesh.dimension == 3) {
      const CostModel cost(3);
      bytes += cost.factorBytes(std::max(2.0, n - b), 2.2) + cost.factorBytes(n, 8.6);
      continue;
    }
    bytes += 130 * n + 6 * c * d * std::log2(n) + 6.6 * b * b + 200 * b;
  }
  if (!meshes.empty() && meshes.front().dimension == 3) bytes += rows.bytes + 100 * rows.terms + 19 * rows.squares;
  return kProgram + bytes / (1 << 20);
}

double estimatedMonolithicMegabytes(GlobalId unknowns, int dimension) {
  constexpr double kAnEntry = 14.2;
  const auto n = static_cast<double>(unknowns);
  return kProgram + (CostModel(dimension).factorBytes(n, kAnEntry) + 500 * n) / (1 << 20);
}

double checkMemory(const Comm& comm, double mine, double limit) {
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(mpiComm(comm), MPI_COMM_TYPE_SHARED, comm.getRank(), MPI_INFO_NULL, &machine);
  double sum = 0.0, most = 0.0;
  int ranks = 0;
  MPI_Allreduce(&mine, &sum, 1, MPI_DOUBLE, MPI_SUM, machine);
  MPI_Allreduce(&mine, &most, 1, MPI_DOUBLE, MPI_MAX, machine);
  MPI_Comm_size(machine, &ranks);
  MPI_Comm_free(&machine);
  collectively(comm, "estimating the memory", [&] {
    const double have = limit > 0.0 ? limit : availableMegabytes();
    if (const double own = mine - kProgram; own > addressSpaceLeft())
      throw EnvironmentError("the run is estimated to take " + gigabytes(own) + " of memory on rank " + std::to_string(comm.getRank()) +
                             " beyond the program itself; the limit of its address space (ulimit -v) leaves " +
                             gigabytes(addressSpaceLeft()) + ". Raise the limit, or use more ranks or a coarser mesh");
    if (sum <= have) return;
    throw EnvironmentError("the run is estimated to take " + gigabytes(sum) + " of memory on this machine (" + std::to_string(ranks) +
                           (ranks == 1 ? " rank" : " ranks, the largest " + gigabytes(most)) + "), which " +
                           (limit > 0.0 ? "is more than Subdomain/Memory Limit, " : "has only ") + gigabytes(have) +
                           (limit > 0.0 ? "" : " left") +
                           ". Use more machines, more and smaller subdomains (Partition/METIS/Subdomains), or a coarser mesh");
  });
  double all = 0.0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

double programMegabytes() { return kProgram; }

}  // namespace suture
