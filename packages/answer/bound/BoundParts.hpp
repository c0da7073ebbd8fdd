#pragma once
#include <suture/answer/bound/BoundElements.hpp>
#include <suture/answer/bound/ErrorBound.hpp>

#include <set>
#include <string>
#include <vector>

namespace suture {

/// A side of an element of this rank at the boundary of the bodies.
struct PlaceOfSide {
  int mesh = -1, element = -1;
  int opposite = -1;  ///< vertex of the simplex (BoundElement) opposite to the side
};

/// Input of an error bound: simplices of this rank and conditions at the boundary, without the pressures of contacts.
template <int D>
struct BoundParts {
  int degree = 1;
  std::vector<BoundElement<D>> elements;
  std::vector<std::vector<int>> ofMesh;  ///< number of the simplex of each element of each mesh
  std::vector<SideCondition<D>> boundary;
  std::vector<PlaceOfSide> places;  ///< place of each entry of `boundary`
  /// Entries of `boundary` on each contact (place in BoundaryParts::touching), on sides A and B.
  std::vector<std::vector<int>> onA, onB;
  double solutionNorm = 0.0;      ///< square over this rank [energy]
  double oscillation = 0.0;       ///< square over this rank, estimated [energy]
  std::set<std::string> reasons;  ///< why the bound is not strict, found on this rank
};

/// Local. \param parts  the same on all ranks \param degree  of all elements \throws InputError  a folded element
template <int D>
BoundParts<D> boundParts(const BoundedSolution& solution, const BoundaryParts& parts, int degree);

/// Squares of the energy norm of the displacements of some nodes, for each simplex. Local. \param lifts  node of the mesh -> displacement
template <int D>
Vector liftEnergies(const BoundParts<D>& parts, const BoundedSolution& solution, const std::map<GlobalId, Point>& lifts);

/// True if all cells of this rank are triangles or tetrahedra. Local. \param degrees  the least and the largest order: extended by the
/// cells
bool areSimplices(const std::vector<SubdomainMesh>& meshes, std::array<int, 2>& degrees);

}  // namespace suture
