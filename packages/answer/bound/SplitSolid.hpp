#pragma once
#include <suture/answer/bound/BoundedField.hpp>
#include <suture/answer/bound/CellParts.hpp>
#include <suture/answer/bound/SharedStresses.hpp>
#include <suture/answer/bound/SideConditions.hpp>
#include <suture/answer/bound/SolidField.hpp>
#include <suture/answer/bound/SplitSide.hpp>

#include <vector>

namespace suture {

/// A hexahedron, wedge or pyramid as tetrahedra, with the stresses of the interpolant v of u_h on them, and with nodal forces of which each
/// tetrahedron, and each node, is in balance.
///
/// Functions of the cell's nodes and of the tetrahedra's differ on sides with four vertices. On each such side the forces of one stress,
/// the same for both cells (SharedStresses), on the nodes of the cell are replaced by those on the nodes of the triangles; at the boundary
/// those of the given tractions, on contacts those of the mean pressure. For a constant stress both have the same resultants, even if the
/// side is warped. The least change of the nodal forces of the tetrahedra then balances each of them.
///
/// v and u_h differ on these sides too: their energies are compared over all cells together, and each cell has its part of the difference,
/// without work of these replaced forces, which cancels between cells. The difference is integrated with Gauss points: exactly on affine
/// cells, otherwise with a relative error of about 1e-6 of the energy of u_h without its affine part, of which 1e-4 is added. Local.
class SplitSolid {
 public:
  /// All arguments must outlive this object. \param m  subdomain of this rank
  SplitSolid(BoundedField<3>& field, int m, int element, const CellParts<3>& parts, const SideConditions<3>& conditions,
             const SharedStresses& shared);

  /// \param oscillation  BoundParts::oscillation, extended
  SplitElement<3> split(double& oscillation);

 private:
  using Forces = BoundedField<3>::Forces;
  struct OfSide {
    int number;              // in the cell
    std::vector<int> nodes;  // nodes of the cell, then of the triangles: the same without the centre, then the new one; -1: none
    SplitSide geometry;
  };
  void findSides();
  void makeSimplices(SplitElement<3>& result, double& oscillation);
  Eigen::Matrix3Xd valuesOnSimplices(const Forces& rest) const;
  Eigen::Vector3d atNewNode(const std::array<int, 2>& diagonal) const;
  void replaceInner(const OfSide& side, const Forces& rest, const Eigen::Matrix3Xd& values, Eigen::Matrix3Xd& forces, double& work) const;
  void replaceOuter(const OfSide& side, const Forces& rest, const Eigen::Matrix3Xd& values, Eigen::Matrix3Xd& forces, double& work,
                    double& supports) const;
  void addLens(const OfSide& side, Eigen::Matrix3Xd& forces) const;

  BoundedField<3>& field_;
  int m_, element_;
  const CellParts<3>& parts_;
  const SideConditions<3>& conditions_;
  const SharedStresses& shared_;
  const SubdomainMesh& mesh_;
  const CellInfo& cell_;
  Span<const int> nodes_;
  Eigen::Matrix3Xd places_;  // nodes of the cell, then the new ones
  std::vector<OfSide> sides_;
  SolidField solid_;
};

/// Moves forces at the centres of sides and of the cell (27 nodes) to the middles of diagonals, with the same resultants. Local.
/// \param places  of the nodes of the cell, then of the new ones \param forces  at the same nodes
void moveCentreForces(Cell cell, const CellParts<3>& parts, const Eigen::Matrix3Xd& places, Eigen::Matrix3Xd& forces);

/// Places of the nodes of a cell, then of the middles of its diagonals. Local.
Eigen::Matrix3Xd placesOfParts(const CellBlock& block, int element, const CellParts<3>& parts);

}  // namespace suture
