#pragma once
#include <suture/adapt/SizePlan.hpp>
#include <suture/answer/Solution.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// Error of the solution of one mesh in the energy norm.
struct LevelError {
  double error = 0.0;              ///< error of the whole solution [(force x length)^(1/2)]
  double norm = 0.0;               ///< energy norm of the solution, likewise
  bool strict = false;             ///< `error` is a bound, otherwise an estimate
  std::vector<Vector> ofElements;  ///< error of each element of each mesh of this rank
  double relative() const { return norm > 0.0 ? error / norm : 0.0; }
};

/// The error by which meshes are refined. Local, total and norm the same on all ranks. \throws InternalError  the solution has none
LevelError levelError(const Solution& solution);

/// Values of all elements on rank 0, by their numbers in the mesh. Collective. \param ofElements  of each mesh of this rank
/// \param elements  of the whole mesh, on rank 0
std::vector<double> valuesOnRoot(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<Vector>& ofElements,
                                 int elements);

/// Nodes of the mesh that face each other on contacts, on rank 0. Collective. \param whole  the mesh, on rank 0
/// \param results  of all pairs, on rank 0
std::vector<FacingNodes> facingNodes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Mesh& whole,
                                     const std::vector<PairResult>& results);

}  // namespace suture
