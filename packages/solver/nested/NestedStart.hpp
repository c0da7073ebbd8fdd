#pragma once
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/solver/Method.hpp>
#include <suture/solver/Solution.hpp>

#include <vector>

namespace suture {

/// The solution of a scene on a coarser mesh, with the bodies and contacts of the fine one.
struct CoarseAnswer {
  std::vector<SubdomainMesh> meshes;  ///< subdomains of this rank
  Solution solution;
};

/// Where to begin on a fine mesh: displacements interpolated from the coarse one, by the shape functions of each cell, and the set of
/// closed pairs from the nearest coarse pair of the same contact. Forces follow from both. Only points on the interface travel between
/// ranks; displacements inside subdomains are zero. Collective. \param meshes  the fine ones of this rank
Start nestedStart(const Comm& comm, const CoarseAnswer& coarse, const std::vector<SubdomainMesh>& meshes);

/// Displacements (Cartesian, one row of three a point) of a coarse answer at points of given bodies: from the cell that holds the point, or
/// the nearest one where a curved side leaves it outside. Every rank gives points of its own and gets theirs. Collective.
Matrix interpolate(const Comm& comm, const CoarseAnswer& coarse, const std::vector<Point>& points, const std::vector<int>& bodies);

}  // namespace suture
