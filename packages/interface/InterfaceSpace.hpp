#pragma once
#include <suture/base/Types.hpp>
#include <suture/interface/Coupling.hpp>
#include <suture/interface/InterfaceLayout.hpp>
#include <suture/interface/TpetraTypes.hpp>

#include <array>
#include <memory>
#include <vector>

namespace suture {

/// An edge of the interface: what two local problems, and only they, share between two corners.
struct InterfaceEdge {
  std::array<int, 2> locals;  ///< ids of the two, ascending
  std::vector<int> unknowns;  ///< places in overlap(); in an order that both sides share
  bool contact = false;       ///< closed pairs of a contact line
};

/// An unknown that is expressed by others: x[unknown] = sum of coefficients * x[others]. Places in overlap().
struct InterfaceRelation {
  int unknown;
  std::vector<int> others;
  std::vector<double> coefficients;
};

/// The space of traces on the interface: one Tpetra map, each unknown owned by one rank, the coupling R_i of every local problem of this
/// rank, and which entity of the decomposition (corner, edge) an unknown belongs to. Immutable.
///
/// related() derives the space in which some unknowns are expressed by others: closed contact pairs identify two of them. With T the
/// matrix of these relations the couplings become R_i T. The map stays the same: an expressed unknown stays in it, idle, as a zero. T is
/// applied where values of owned unknowns become values of all (gather) and, transposed, where contributions are summed (scatterAdd), so
/// that nobody else need know of it.
class InterfaceSpace {
 public:
  /// Collective.
  InterfaceSpace(CommPtr comm, const InterfaceLayout& layout);

  /// The space with relations. Every expressed unknown at most once, its `others` not expressed themselves; every rank that sees the
  /// unknown gives the same relation and sees all the others. Local.
  /// \param chains  unknowns along contact lines, those of neighbouring closed pairs one after the other: what two local problems share of
  ///                one becomes an edge whose end points are corners. Expressed unknowns stand for what expresses them.
  std::shared_ptr<const InterfaceSpace> related(std::vector<InterfaceRelation> relations,
                                                const std::vector<std::vector<int>>& chains) const;

  const MapPtr& map() const { return map_; }          ///< owned, one to one
  const MapPtr& overlap() const { return overlap_; }  ///< all that this rank's local problems touch, and their partners in relations
  const CommPtr& comm() const { return comm_; }
  GlobalId size() const;  ///< over all ranks, idle ones included
  int overlapSize() const { return static_cast<int>(points_.size()); }
  int locals() const { return static_cast<int>(couplings_.size()); }
  int localId(int local) const { return localIds_[local]; }
  const Coupling& coupling(int local) const { return couplings_[local]; }
  /// The most rows that one of them has: work space that serves all. Local.
  int mostRows() const;

  // For each unknown of overlap(), by place.
  GlobalId id(int place) const { return ids_[place]; }
  int ownedRow(int place) const { return ownedRows_[place]; }  ///< in map(); -1: another rank owns it
  const Point& point(int place) const { return points_[place]; }
  const Point& direction(int place) const { return directions_[place]; }  ///< along which it displaces; see InterfaceLayout::Unknown
  double moment(int place) const { return moments_[place]; }              ///< value under a unit rotation about point(); zero for a point
  double flux(int place) const { return fluxes_[place]; }                 ///< see InterfaceLayout::Unknown
  /// The relation that expresses it, or null.
  const InterfaceRelation* relation(int place) const { return relationOf_[place] < 0 ? nullptr : &relations_[relationOf_[place]]; }
  /// Ids of the local problems that feel it, ascending; none for an expressed one.
  const std::vector<int>& sharers(int place) const { return sharers_[place]; }
  bool isCorner(int place) const { return corner_[place] != 0; }
  /// Edges that touch local problems of this rank; no unknown in two of them.
  const std::vector<InterfaceEdge>& edges() const { return edges_; }

  /// overlap <- T owned. Collective.
  void gather(const MultiVector& owned, Matrix& overlap) const;
  /// owned <- T^T of the sums over ranks of the overlap's values. Collective.
  void scatterAdd(const Matrix& overlap, MultiVector& owned) const;
  /// overlap <- T T^T of the sums over ranks of the overlap's values. Collective.
  void sum(Matrix& overlap) const;
  /// overlap <- for each unknown the sum, over ranks and over what is expressed by it alone, of values times squared coefficients; an
  /// expressed one gets that of what expresses it, zero if that is several. For weights: a partition of unity in R_i T. Collective.
  void sumDensities(Matrix& overlap) const;

  /// T on overlap values: fills the expressed ones. Local.
  void unfold(LocalView overlap) const;
  /// T^T on overlap values: empties the expressed ones. Local.
  void fold(LocalView overlap) const;

  MultiVectorPtr vector(int columns = 1) const;  ///< a new one, zero

 private:
  void exchangeSharers(const InterfaceLayout& layout);
  void importPoints(const InterfaceLayout& layout);
  void cutChain(const std::vector<int>& chain);
  MultiVector& overlapping(std::size_t columns) const;

  CommPtr comm_;
  MapPtr map_, overlap_;
  Teuchos::RCP<const Import> import_;
  mutable MultiVectorPtr work_;  // of gather() and scatterAdd(), which PCG calls twice an iteration
  mutable MultiVectorPtr sum_;   // of sum()
  std::vector<int> localIds_;
  std::vector<Coupling> couplings_;
  std::vector<GlobalId> ids_;
  std::vector<int> ownedRows_;
  std::vector<Point> points_, directions_;
  std::vector<double> moments_, fluxes_;
  std::vector<std::vector<int>> sharers_;
  std::vector<char> corner_;
  std::vector<InterfaceEdge> edges_;
  std::vector<InterfaceRelation> relations_;
  std::vector<int> relationOf_;
};

/// View of a vector's values on this rank as an Eigen matrix. Local.
Eigen::Map<Matrix, 0, Eigen::OuterStride<>> localView(MultiVector& x);
Eigen::Map<const Matrix, 0, Eigen::OuterStride<>> localView(const MultiVector& x);

/// Collective.
double dot(const MultiVector& a, const MultiVector& b);

}  // namespace suture
