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

/// A vertex, an edge or a face of the interface: a connected set of unknowns with the same sharers.
struct InterfaceEntity {
  EntityKind kind;
  std::vector<int> sharers;   ///< ids of the local problems, ascending, two or more
  std::vector<int> unknowns;  ///< places in overlap(); in an order that all sharers have in common
  std::vector<int> ends;      ///< those of an edge's unknowns where it ends at no vertex
  bool contact = false;       ///< closed pairs of a contact
};

/// An unknown that is expressed by others: x[unknown] = sum of coefficients * x[others]. Places in overlap().
struct InterfaceRelation {
  int unknown;
  std::vector<int> others;
  std::vector<double> coefficients;
  double size = 1.0;  ///< tributary length or area of the unknown
};

/// The space of traces on the interface: one Tpetra map, each unknown owned by one rank, the coupling R_i of every local problem of this
/// rank, and the entities of the decomposition (vertices, edges, faces) that unknowns belong to. Immutable.
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
  /// \param neighbours  in the plane unknowns along contact lines, those of neighbouring closed pairs one after the other: neighbours with
  ///                    the same two sharers make an edge. In space the unknowns around the cells of contact surfaces, -1 where a pair is
  ///                    open: neighbours with the same two sharers make a face, with the same three or more an edge. Expressed unknowns
  ///                    stand for what expresses them. An unknown whose sharers change and that lies on no such edge or face becomes a
  ///                    vertex, and so does one in a relation of several terms.
  std::shared_ptr<const InterfaceSpace> related(std::vector<InterfaceRelation> relations,
                                                const std::vector<std::vector<int>>& neighbours) const;

  /// The space in which some unknowns vanish. Every rank that sees one of them names it; none is expressed. Local.
  std::shared_ptr<const InterfaceSpace> without(const std::vector<int>& places) const;

  const MapPtr& map() const { return map_; }          ///< owned, one to one
  const MapPtr& overlap() const { return overlap_; }  ///< all that this rank's local problems touch, and their partners in relations
  const CommPtr& comm() const { return comm_; }
  int dimension() const { return dimension_; }  ///< of the scene, also on a rank without local problems
  GlobalId size() const;                        ///< over all ranks, idle ones included
  int overlapSize() const { return static_cast<int>(ownedRows_->size()); }
  int locals() const { return static_cast<int>(couplings_->size()); }
  int localId(int local) const { return (*localIds_)[local]; }
  const Coupling& coupling(int local) const { return (*couplings_)[local]; }
  /// The most rows that one of them has: work space that serves all. Local.
  int mostRows() const;

  // For each unknown of overlap(), by place.
  GlobalId id(int place) const { return unknown(place).id; }
  int ownedRow(int place) const { return (*ownedRows_)[place]; }  ///< in map(); -1: another rank owns it
  const Point& point(int place) const { return unknown(place).point; }
  const Point& direction(int place) const { return unknown(place).direction; }  ///< along which it displaces; see InterfaceLayout::Unknown
  const Point& moment(int place) const { return unknown(place).moment; }  ///< values under unit rotations about point(); zero for a point
  double flux(int place) const { return unknown(place).flux; }            ///< see InterfaceLayout::Unknown
  /// The relation that expresses it, or null.
  const InterfaceRelation* relation(int place) const { return relationOf_[place] < 0 ? nullptr : &relations_[relationOf_[place]]; }
  /// The relations that this rank sees, in an order that does not depend on the rank.
  const std::vector<InterfaceRelation>& relations() const { return relations_; }
  /// The space without the relations of several terms, and those of one term that name an unknown of these: what they express (the rows of
  /// a mortar) is free there, and its sharers are those of its own body. Null if this rank sees none of them: the space is as it would be.
  const std::shared_ptr<const InterfaceSpace>& torn() const { return torn_; }
  /// True if a relation is none in the torn space.
  bool isTorn(const InterfaceRelation& relation) const { return torn_ && torn_->relationOf_[relation.unknown] < 0; }
  /// Ids of the local problems that feel it, ascending; none for an expressed one.
  const std::vector<int>& sharers(int place) const { return (*sharers_)[place]; }
  /// Entities that touch local problems of this rank, none empty; no unknown in two of them. Ranks that know several of them list these in
  /// the same order.
  const std::vector<InterfaceEntity>& entities() const { return *entities_; }
  /// The entity that an unknown belongs to, -1: none.
  std::vector<int> entityOfPlaces() const;

  /// overlap <- T owned. Collective.
  void gather(const MultiVector& owned, Matrix& overlap) const;
  /// owned <- T^T of the sums over ranks of the overlap's values. Collective.
  /// \param test  relations of T in place of the space's own, of the same unknowns; null: its own
  void scatterAdd(const Matrix& overlap, MultiVector& owned, const std::vector<InterfaceRelation>* test = nullptr) const;
  /// overlap <- T T^T of the sums over ranks of the overlap's values. Collective.
  void sum(Matrix& overlap) const;
  /// overlap <- for each unknown the sum, over ranks and over what is expressed by it alone, of values times squared coefficients; an
  /// expressed one gets that of what expresses it, zero if that is several. For weights: a partition of unity in R_i T. Collective.
  void sumDensities(Matrix& overlap) const;

  /// T on overlap values: fills the expressed ones. Local.
  void unfold(LocalView overlap) const;
  /// T^T on overlap values: empties the expressed ones. Local. \param test  as in scatterAdd()
  void fold(LocalView overlap, const std::vector<InterfaceRelation>* test = nullptr) const;

  MultiVectorPtr vector(int columns = 1) const;  ///< a new one, zero

 private:
  void exchangeSharers(const InterfaceLayout& layout);
  const InterfaceLayout::Unknown& unknown(int place) const { return (*unknowns_)[place]; }
  void addEntities(const InterfaceLayout& layout);
  std::shared_ptr<InterfaceSpace> withRelations(std::vector<InterfaceRelation> relations, const std::vector<std::vector<int>>& neighbours,
                                                const std::vector<int>& inRows = {}) const;
  void leaveEntities(const std::vector<char>& leaves);
  /// Entity of closed pairs, by the places of their unknowns.
  struct ContactPlaces {
    EntityKind kind;
    std::vector<int> sharers, unknowns, ends;
  };
  int expressing(int named) const;
  std::vector<ContactPlaces> contactEdges(const std::vector<std::vector<int>>& chains, const std::vector<char>& apart) const;
  std::vector<ContactPlaces> contactFaces(const std::vector<std::vector<int>>& cells, const std::vector<char>& apart) const;
  void addContactEntities(const std::vector<std::vector<int>>& neighbours, std::vector<char> single);
  MultiVector& overlapping(std::size_t columns) const;

  CommPtr comm_;
  MapPtr map_, overlap_;
  Teuchos::RCP<const Import> import_;
  mutable MultiVectorPtr work_;  // of gather() and scatterAdd(), which PCG calls twice an iteration
  mutable MultiVectorPtr sum_;   // of sum()
  // Related spaces share all that relations do not change.
  CopyOnWrite<std::vector<int>> localIds_;
  CopyOnWrite<std::vector<Coupling>> couplings_;
  CopyOnWrite<std::vector<InterfaceLayout::Unknown>> unknowns_;  // unknowns of overlap_
  CopyOnWrite<std::vector<int>> ownedRows_;
  int dimension_;
  CopyOnWrite<std::vector<std::vector<int>>> sharers_;
  CopyOnWrite<std::vector<InterfaceEntity>> entities_;
  std::vector<InterfaceRelation> relations_;
  std::vector<int> relationOf_;
  std::shared_ptr<const InterfaceSpace> torn_;
};

/// View of a vector's values on this rank as an Eigen matrix. Local.
Eigen::Map<Matrix, 0, Eigen::OuterStride<>> localView(MultiVector& x);
Eigen::Map<const Matrix, 0, Eigen::OuterStride<>> localView(const MultiVector& x);

/// Collective.
double dot(const MultiVector& a, const MultiVector& b);

}  // namespace suture
