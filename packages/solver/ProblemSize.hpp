#pragma once
#include <suture/base/Types.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/partition/Partition.hpp>

namespace suture {

/// Sizes of the discrete problem, for the console and summary.json; the same on all ranks.
struct ProblemSize {
  GlobalId nodes = 0, elements = 0, dofs = 0;  ///< sizes of the mesh; dofs: only free ones
  GlobalId interfaceDofs = 0;                  ///< unknowns of the interface problem
  int subdomains = 0, groups = 0;
  int pairs = 0, pieces = 0;
};

/// Sizes of a scene, without the interface. Collective. \param mesh, constraints  on rank 0
ProblemSize problemSize(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const Partition& partition);

}  // namespace suture
