#pragma once
#include <suture/base/CopyOnWrite.hpp>
#include <suture/base/Types.hpp>
#include <suture/interface/Coupling.hpp>
#include <suture/interface/InterfaceLayout.hpp>
#include <suture/interface/TpetraTypes.hpp>

#include <array>
#include <memory>
#include <vector>

namespace suture {

/// A vertex, edge or face of the interface: a connected set of unknowns with the same sharers.
struct InterfaceEntity {
  EntityKind kind;
  std::vector<int> sharers;   ///< ids of the local problems, ascending, two or more
  std::vector<int> unknowns;  ///< places in overlap(), in an order common to all sharers
  std::vector<int> ends;      ///< an edge's unknowns at ends without a vertex
  bool contact = false;       ///< consists of closed pairs
};

/// An unknown expressed by others: x[unknown] = sum of coefficients * x[others]. Places in overlap().
struct InterfaceRelation {
  int unknown;
  std::vector<int> others;
  std::vector<double> coefficients;
  double size = 1.0;  ///< tributary length or area of the unknown
};

/// The space of traces on the interface: a Tpetra map in which each unknown is owned by one rank, the coupling R_i of each local problem of
/// this rank, and the entities of the decomposition (vertices, edges, faces) that unknowns belong to. Immutable.
///
/// related() derives a space in which some unknowns are expressed by others: closed contact pairs identify two of them. With the matrix T
/// of these relations the couplings become R_i T. The map stays the same; an expressed unknown remains in it as an unused zero. T is
/// applied only where values of owned unknowns are distributed (gather) and, transposed, where contributions are summed (scatterAdd).
class InterfaceSpace {
 public:
  /// Collective.
  InterfaceSpace(CommPtr comm, const InterfaceLayout& layout);

  /// The space with relations. An unknown may be expressed once, by others that are not expressed; each rank that sees the unknown must
  /// give the same relation and see all of the others. Local.
  /// \param neighbours  in 2D chains of unknowns of neighbouring closed pairs along contact lines: neighbours with the same two sharers
  /// form an edge. In 3D the unknowns around each cell of contact surfaces, -1 where a pair is open: neighbours with the same two sharers
  /// form a face, with the same three or more an edge. An expressed unknown is replaced by the one that expresses it. An unknown whose
  /// sharers change and that lies on no such edge or face becomes a vertex, and so does an unknown in a relation of several terms.
  std::shared_ptr<const InterfaceSpace> related(std::vector<InterfaceRelation> relations,
                                                const std::vector<std::vector<int>>& neighbours) const;

  /// The space in which some unknowns vanish. Each rank that sees such an unknown must name it; expressed unknowns are not allowed. Local.
  std::shared_ptr<const InterfaceSpace> without(const std::vector<int>& places) const;

  const MapPtr& map() const { return map_; }          ///< owned, one to one
  const MapPtr& overlap() const { return overlap_; }  ///< all unknowns of this rank's local problems, and their partners in relations
  const CommPtr& comm() const { return comm_; }
  int dimension() const { return dimension_; }  ///< dimension of the scene, also on a rank without local problems
  GlobalId size() const;                        ///< over all ranks, including unused unknowns
  int overlapSize() const { return static_cast<int>(ownedRows_->size()); }
  int locals() const { return static_cast<int>(couplings_->size()); }
  int localId(int local) const { return (*localIds_)[local]; }
  const Coupling& coupling(int local) const { return (*couplings_)[local]; }
  /// Largest number of rows of a coupling, for work space. Local.
  int mostRows() const;

  // For each unknown of overlap(), by place:
  GlobalId id(int place) const { return unknown(place).id; }
  int ownedRow(int place) const { return (*ownedRows_)[place]; }  ///< in map(); -1: another rank owns the unknown
  const Point& point(int place) const { return unknown(place).point; }
  const Point& direction(int place) const { return unknown(place).direction; }  ///< see InterfaceLayout::Unknown
  const Point& moment(int place) const { return unknown(place).moment; }  ///< values under unit rotations about point(); zero for a point
  double flux(int place) const { return unknown(place).flux; }            ///< see InterfaceLayout::Unknown
  /// The relation that expresses the unknown, or null.
  const InterfaceRelation* relation(int place) const { return relationOf_[place] < 0 ? nullptr : &relations_[relationOf_[place]]; }
  /// The relations that this rank sees, in an order independent of the rank.
  const std::vector<InterfaceRelation>& relations() const { return relations_; }
  /// The space without relations of several terms, and without relations of one term that use an unknown of these: expressed unknowns of a
  /// mortar are free, and only the local problems of the same body share them. Null if this rank sees no such relation, because the space
  /// would be the same.
  const std::shared_ptr<const InterfaceSpace>& broken() const { return broken_; }
  /// True if a relation is missing in the broken space.
  bool isBroken(const InterfaceRelation& relation) const { return broken_ && broken_->relationOf_[relation.unknown] < 0; }
  /// Ids of the local problems that depend on the unknown, ascending; empty for an expressed one.
  const std::vector<int>& sharers(int place) const { return (*sharers_)[place]; }
  /// Entities that touch local problems of this rank, none empty and no two with a common unknown. Ranks that share several entities list
  /// them in the same order.
  const std::vector<InterfaceEntity>& entities() const { return *entities_; }
  /// The entity of each unknown; -1: none.
  std::vector<int> entityOfPlaces() const;

  /// overlap <- T owned. Collective.
  void gather(const MultiVector& owned, Matrix& overlap) const;
  /// owned <- T^T of the overlap's values summed over ranks. Collective.
  /// \param test  relations of T instead of the space's own, for the same unknowns; null: its own
  void scatterAdd(const Matrix& overlap, MultiVector& owned, const std::vector<InterfaceRelation>* test = nullptr) const;
  /// overlap <- T T^T of the overlap's values summed over ranks. Collective.
  void sum(Matrix& overlap) const;
  /// overlap <- for each unknown, the sum over ranks, and over unknowns expressed by it alone, of values times squared coefficients. An
  /// expressed unknown gets the value of the unknown that expresses it, or zero if there are several. For weights: a partition of unity in
  /// R_i T. Collective.
  void sumDensities(Matrix& overlap) const;

  /// Applies T to overlap values: fills expressed unknowns. Local.
  void unfold(LocalView overlap) const;
  /// Applies T^T to overlap values: empties expressed unknowns. Local. \param test  as in scatterAdd()
  void fold(LocalView overlap, const std::vector<InterfaceRelation>* test = nullptr) const;

  MultiVectorPtr vector(int columns = 1) const;  ///< new, zero

 private:
  void exchangeSharers(const InterfaceLayout& layout);
  const InterfaceLayout::Unknown& unknown(int place) const { return (*unknowns_)[place]; }
  void addEntities(const InterfaceLayout& layout);
  std::shared_ptr<InterfaceSpace> withRelations(std::vector<InterfaceRelation> relations, const std::vector<std::vector<int>>& neighbours,
                                                const std::vector<int>& inRows = {}) const;
  void leaveEntities(const std::vector<char>& leaves);
  MultiVector& overlapping(std::size_t columns) const;

  CommPtr comm_;
  MapPtr map_, overlap_;
  Teuchos::RCP<const Import> import_;
  mutable MultiVectorPtr work_;  // for gather() and scatterAdd(), which PCG calls twice per iteration
  mutable MultiVectorPtr sum_;   // for sum()
  // Related spaces share everything that relations do not change.
  CopyOnWrite<std::vector<int>> localIds_;
  CopyOnWrite<std::vector<Coupling>> couplings_;
  CopyOnWrite<std::vector<InterfaceLayout::Unknown>> unknowns_;  // in the order of overlap_
  CopyOnWrite<std::vector<int>> ownedRows_;
  int dimension_;
  CopyOnWrite<std::vector<std::vector<int>>> sharers_;
  CopyOnWrite<std::vector<InterfaceEntity>> entities_;
  std::vector<InterfaceRelation> relations_;
  std::vector<int> relationOf_;
  std::shared_ptr<const InterfaceSpace> broken_;
};

/// View of a vector's values on this rank as an Eigen matrix. Local.
Eigen::Map<Matrix, 0, Eigen::OuterStride<>> localView(MultiVector& x);
Eigen::Map<const Matrix, 0, Eigen::OuterStride<>> localView(const MultiVector& x);

/// Collective.
double dot(const MultiVector& a, const MultiVector& b);

}  // namespace suture
