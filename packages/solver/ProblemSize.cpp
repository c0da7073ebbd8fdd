#include <suture/solver/ProblemSize.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>

namespace suture {

ProblemSize problemSize(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const Partition& partition) {
  GlobalId sizes[5] = {0, 0, 0, 0, 0};
  if (comm.getRank() == 0) {
    sizes[0] = mesh.nodes();
    sizes[1] = mesh.elements();
    sizes[2] = sizes[0] * mesh.dimension;
    for (const NodeRule& rule : constraints.rules) sizes[2] -= std::count(rule.fixed.begin(), rule.fixed.begin() + mesh.dimension, true);
    sizes[3] = static_cast<GlobalId>(constraints.pairs.size());
    sizes[4] = static_cast<GlobalId>(constraints.pieces.size());
  }
  Teuchos::broadcast(comm, 0, 5, sizes);
  ProblemSize size;
  size.nodes = sizes[0];
  size.elements = sizes[1];
  size.dofs = sizes[2];
  size.pairs = static_cast<int>(sizes[3]);
  size.pieces = static_cast<int>(sizes[4]);
  size.subdomains = partition.subdomains();
  size.groups = static_cast<int>(partition.groups.size());
  return size;
}

}  // namespace suture
