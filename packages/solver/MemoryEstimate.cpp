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

namespace suture {

namespace {

constexpr double kProgram = 55.0;  // megabytes that it has taken already when the estimate is made

// Pairs of nodes that have an element in common. Those on a side have two, as nearly all sides do; in space a pair of hexahedra has two
// elements in the mean, one of tetrahedra four.
double couplings(const SubdomainMesh& mesh) {
  const auto pairs = [](std::size_t nodes) { return 0.5 * static_cast<double>(nodes * (nodes - 1)); };
  std::map<Cell, double> elements;
  for (std::size_t begin = 0, end = 0; begin < mesh.cells.size(); begin = end) {  // of one shape, mostly
    while (end < mesh.cells.size() && mesh.cells[end] == mesh.cells[begin]) ++end;
    elements[mesh.cells[begin]] += static_cast<double>(end - begin);
  }
  double sum = 0.0;
  for (const auto& [cell, count] : elements) {
    const CellInfo& info = cellInfo(cell);
    if (info.dimension == 3)
      sum += count * pairs(info.nodes) * (isSimplex(cell) ? 0.25 : 0.5);
    else
      sum += count * (pairs(info.nodes) - 0.5 * static_cast<double>(info.sideNodes.size()) * pairs(info.sideNodes[0].size()));
  }
  return sum;
}

}  // namespace

double estimatedMegabytes(const std::vector<SubdomainMesh>& meshes) {
  double bytes = 0.0;
  for (const SubdomainMesh& mesh : meshes) {
    const double nodes = mesh.nodes(), d = mesh.dimension, n = std::max(2.0, nodes * d);
    int shared = 0;
    for (int node = 0; node < mesh.nodes(); ++node) shared += !mesh.others(node).empty();
    const double b = shared * d + static_cast<double>(mesh.contactEnds.size()), c = couplings(mesh);
    if (mesh.dimension == 3) {
      const CostModel cost(3);
      bytes += 180 * n + 12 * (9 * c + 6 * nodes) + cost.factorBytes(std::max(2.0, n - b), 5.0) + cost.factorBytes(n, 4.0) + 800 * b;
      continue;
    }
    bytes += 130 * n + 12 * (d * d * c + d * (d + 1) / 2 * nodes) + 6 * c * d * std::log2(n) + 6.6 * b * b + 200 * b;
  }
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
