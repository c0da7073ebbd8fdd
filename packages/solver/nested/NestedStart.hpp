#pragma once
#include <suture/answer/Solution.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/solver/Method.hpp>

#include <vector>

namespace suture {

/// Solution of the same scene (same bodies and contacts) on a coarser mesh.
struct CoarseAnswer {
  std::vector<SubdomainMesh> meshes;  ///< subdomains of this rank
  Solution solution;
};

/// Initial state on a fine mesh: displacements interpolated from the coarse mesh by the shape functions of each cell, and contact states
/// from the nearest coarse pair of the same contact; the discretisation error follows from that of the coarse mesh, if it is known. Forces
/// follow from both. Only interface points are exchanged between ranks;
/// displacements inside subdomains are zero. Collective. \param meshes  fine meshes of this rank
Start nestedStart(const Comm& comm, const CoarseAnswer& coarse, const std::vector<SubdomainMesh>& meshes);

/// Displacements (Cartesian, a row of three per point) of a coarse solution at points of given bodies: from the cell that contains the
/// point, or the nearest cell if a curved side leaves the point outside. Each rank passes its points and receives their values. Collective.
Matrix interpolate(const Comm& comm, const CoarseAnswer& coarse, const std::vector<Point>& points, const std::vector<int>& bodies);

}  // namespace suture
