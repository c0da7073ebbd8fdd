#pragma once
#include <suture/answer/error/PatchExchange.hpp>
#include <suture/answer/error/VertexPatches.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/StressVector.hpp>

#include <vector>

namespace suture {

/// Squares of energy norms, element by element. [force x length]
struct ElementErrors {
  Vector error;  ///< norm of recovered minus computed stresses: integral of (s* - s).D^-1 (s* - s), the estimate of the error
  Vector norm;   ///< norm of the computed stresses without initial states, but at least 1e-16 of the total norm
};

/// Superconvergent patch recovery of Zienkiewicz and Zhu (Int. J. Num. Meth. Eng. 33, 1331-1382, 1992) on one block of elements.
///
/// The patch of a vertex consists of all elements of one material around it: stresses may jump between materials, and bodies share no
/// nodes, so that patches also end at contacts. A polynomial of the cells' order in coordinates about the vertex is fitted by least squares
/// to the stresses at the superconvergent points (`Rule::Sampling`) of its elements, if the points determine it well at the vertex.
/// Otherwise (mostly on the boundary of the material) the points of the patches at the other ends of its edges are added with the smallest
/// weight for which the value at the vertex is well determined: the patch stays one-sided, and takes from others only what its own points
/// do not determine. (The mean of the neighbours' extrapolated polynomials, as in the paper, makes the error of quadratic quadrilaterals at
/// the end of contact up to 1.6 times too large, and the recovered stress along smooth boundaries half as accurate.) A corner, or in 3D
/// also an edge of the body, whose edges lead to no patch with its own polynomial takes the mean of the polynomials of the vertices that
/// share elements with it; if these have none either (thin strips), the patch is enlarged by theirs, and the order is lowered until the
/// polynomial is determined. The recovered stress s* has the cells' shape functions; at mid-side nodes it is the mean of the polynomials of
/// the ends, at the centres of sides and cells the mean over all of their vertices.
///
/// Everything that a patch needs consists of sums over elements: see recoverPatches().
class PatchRecovery {
 public:
  using Materials = std::function<const Material&(int element)>;

  using Patch = VertexPatches::Patch;

  /// Local. `block` must outlive this object. A lambda for the materials must declare `-> const Material&`. `displacement`: node-major,
  /// Cartesian.
  PatchRecovery(const CellBlock& block, Materials materialOf, PlaneModel plane, Vector displacement, InitialState initial = InitialState());

  const std::vector<Patch>& patches() const { return patches_.all; }
  const VertexPatches& vertices() const { return patches_; }
  /// Call after recoverPatches(). \throws InputError  if an element is folded
  ElementErrors errors() const;
  /// Call after recoverPatches(): the recovered stresses at all nodes, each element's with the shape functions of its cell, summed over the
  /// elements that meet there (materials may differ, and then their stresses), and the number of elements. (components + 1) x nodes. Local.
  Matrix nodalSums() const;

 private:
  friend void recoverPatches(std::vector<PatchRecovery>& blocks, const PatchExchange& exchange);

  enum class Origin : char { None, Own, Neighbours };

  int order() const;  // largest order of the cells
  // D: dimension of the block
  template <int D>
  static void recover(std::vector<PatchRecovery>& blocks, const PatchExchange& exchange);
  template <int D>
  Matrix moments() const;
  template <int D>
  void fitAlone(const Matrix& moments);
  template <int D>
  Matrix acrossEdges(const Matrix& moments) const;
  template <int D>
  void fitJoined(const Matrix& moments, const Matrix& neighbours);
  template <int D>
  Matrix fromNeighbours() const;
  void takeFromNeighbours(const Matrix& sums);
  template <int D>
  Matrix enlarged(const Matrix& moments) const;
  template <int D>
  void fitEnlarged(const Matrix& moments);
  bool unfitted() const;
  Span<const int> patchesOf(int element) const { return patches_.of(element); }
  template <int D>
  using Nodal = Eigen::Matrix<double, stressComponents<D>, mostNodes<D>>;
  template <int D>
  void nodalOf(int element, Nodal<D>& nodal) const;
  template <int D>
  Matrix sumsAtNodes() const;
  template <int D>
  ElementErrors errorsOfElements() const;
  Point placeOf(int patch) const { return block_->point(patches_.all[patch].node); }

  const CellBlock* block_;
  Materials materialOf_;
  PlaneModel plane_;
  Vector displacement_;
  InitialState initial_;
  VertexPatches patches_;
  std::vector<Origin> origin_;  // origin of each patch's polynomial
  Matrix polynomials_;          // (terms x components) x patches, about the patch's vertex
  int order_ = 1;               // order of the polynomials, over all blocks
};

/// Fits the patches of all blocks; every rank calls it with its own blocks, possibly none. Collective if the exchange is.
void recoverPatches(std::vector<PatchRecovery>& blocks, const PatchExchange& exchange = PatchExchange());

}  // namespace suture
