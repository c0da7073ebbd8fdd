#pragma once
#include <suture/answer/bound/BoundElements.hpp>
#include <suture/answer/bound/ErrorBound.hpp>
#include <suture/answer/bound/SimplexField.hpp>

#include <array>
#include <set>
#include <string>
#include <vector>

namespace suture {

/// A side of an element of this rank at the boundary of the bodies.
struct PlaceOfSide {
  int mesh = -1, element = -1;
  int simplex = -1;   ///< BoundElement of which it is a side
  int opposite = -1;  ///< vertex of the simplex opposite to the side
};

/// Input of an error bound: simplices of this rank and conditions at the boundary, without the pressures of contacts.
template <int D>
struct BoundParts {
  BoundKind kind;
  std::vector<BoundElement<D>> elements;
  /// Simplices of the elements of each mesh: those of element e are ofMesh[m][e] to ofMesh[m][e + 1] - 1.
  std::vector<std::vector<int>> ofMesh;
  /// For each element of each mesh 2 (J(u_h) - J(v)), v the interpolant of u_h on its simplices; empty for meshes of simplices. In 3D
  /// the sum over all elements is meant. [energy]
  std::vector<Vector> interpolation;
  double uncertainty = 0.0;  ///< by how much the sum of `interpolation` over this rank may be too large [energy]
  std::vector<SideCondition<D>> boundary;
  std::vector<PlaceOfSide> places;  ///< place of each entry of `boundary`
  /// Entries of `boundary` on each contact (place in BoundaryParts::touching), on sides A and B.
  std::vector<std::vector<int>> onA, onB;
  double solutionNorm = 0.0;      ///< square over this rank [energy]
  double oscillation = 0.0;       ///< square over this rank, estimated [energy]
  double energyOfForm = 0.0;      ///< potential energy of u_h minus that of the form of the elements, over this rank [energy]
  std::set<std::string> reasons;  ///< why the bound is not strict, found on this rank
};

class SharedStresses;

/// Local. \param parts  the same on all ranks \param kind  of all elements \param shared  null if all cells in 3D are tetrahedra
/// \throws InputError  a folded element
template <int D>
BoundParts<D> boundParts(const BoundedSolution& solution, const BoundaryParts& parts, const BoundKind& kind,
                         const SharedStresses* shared = nullptr);

/// Nodes of the mesh at the nodes of a simplex; -1: none, as in the middle of the diagonals of most cells. Local.
template <int D>
std::array<int, SimplexNodes<D>::most> nodesOfSimplex(const BoundParts<D>& parts, const SubdomainMesh& mesh, const PlaceOfSide& place);

/// Nodal forces of the stresses and the source of a simplex alone. Local.
template <int D>
typename SimplexField<D>::Nodal forcesOfStresses(const BoundElement<D>& element, const BoundKind& kind);

/// Nodal forces of an element, which are in balance, are added to those of its simplices. Local. \param forces  D x nodes of the element
template <int D>
void addForcesOf(const SubdomainMesh& mesh, int m, int e, const Matrix& forces, BoundParts<D>& parts);

/// Values at the nodes of the sides at the boundary, of the degree of the elements, are completed to the degree of the stresses. Local.
void raiseDegree(BoundParts<2>& parts);

/// True if all cells of this rank are triangles or tetrahedra. Local. \param orders  the least and the largest order: extended by the cells
bool hasOnlySimplices(const std::vector<SubdomainMesh>& meshes, std::array<int, 2>& orders);

}  // namespace suture
