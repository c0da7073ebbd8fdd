#pragma once
#include <suture/base/Types.hpp>
#include <suture/interface/Coupling.hpp>
#include <suture/interface/TpetraTypes.hpp>

#include <vector>

namespace suture {

/// The space of traces on the interface: one Tpetra map, each unknown owned by one rank, and the coupling R_i of every local problem of
/// this rank. Immutable.
class InterfaceSpace {
 public:
  /// Unknowns are the distinct numbers in the boundaries of all local problems; a boolean coupling each. Collective.
  /// \param boundaries  of this rank's local problems, in their order
  /// \param points      coordinates of the unknowns, in the same shape, and `components` their component (0, 1: in the axes of the node)
  InterfaceSpace(CommPtr comm, const std::vector<std::vector<GlobalId>>& boundaries, const std::vector<std::vector<Point>>& points,
                 const std::vector<std::vector<int>>& components);

  const MapPtr& map() const { return map_; }          ///< owned, one to one
  const MapPtr& overlap() const { return overlap_; }  ///< all that this rank's local problems touch
  const CommPtr& comm() const { return comm_; }
  GlobalId size() const;  ///< over all ranks
  int locals() const { return static_cast<int>(couplings_.size()); }
  const Coupling& coupling(int local) const { return couplings_[local]; }

  /// Of the unknowns of overlap(), by local index.
  const Point& point(int overlapIndex) const { return points_[overlapIndex]; }
  int component(int overlapIndex) const { return components_[overlapIndex]; }

  /// overlap <- owned values. Collective.
  void gather(const MultiVector& owned, Matrix& overlap) const;
  /// owned <- sums over ranks of the overlap's values. Collective.
  void scatterAdd(const Matrix& overlap, MultiVector& owned) const;
  /// overlap <- sums over ranks of the overlap's values. Collective.
  void sum(Matrix& overlap) const;

  MultiVectorPtr vector(int columns = 1) const;  ///< a new one, zero

 private:
  CommPtr comm_;
  MapPtr map_, overlap_;
  Teuchos::RCP<const Import> import_;
  std::vector<Coupling> couplings_;
  std::vector<Point> points_;
  std::vector<int> components_;
};

/// View of a vector's values on this rank as an Eigen matrix. Local.
Eigen::Map<Matrix, 0, Eigen::OuterStride<>> localView(MultiVector& x);
Eigen::Map<const Matrix, 0, Eigen::OuterStride<>> localView(const MultiVector& x);

/// Collective.
double dot(const MultiVector& a, const MultiVector& b);

}  // namespace suture
