#pragma once
#include <suture/adapt/Bisection.hpp>
#include <suture/adapt/EdgeNodes.hpp>
#include <suture/adapt/MarkedSimplex.hpp>
#include <suture/adapt/TwinEdges.hpp>

#include <vector>

namespace suture {

/// Finds all edges that one level of bisection splits: marked elements are bisected D times, and an element with a split edge is bisected
/// until none of its parts has one. The parts of an element are never stored: they follow from the split edges. Local (rank 0).
template <int D>
class SplitEdges {
 public:
  /// \param marked  by element
  SplitEdges(const RefinableMesh& coarse, const std::vector<char>& marked);

  /// Node in the middle of an edge, -1 if it is not split.
  int middle(int p, int q) const { return middles_.at(p, q); }
  /// True if a part, or the element itself, has to be bisected.
  bool isSplit(const MarkedSimplex<D>& part) const;
  /// False: the element certainly stays whole.
  bool mayBeSplit(int element) const { return touchedVertices(element, 1) >= 2; }
  /// The element as a simplex, without tags.
  MarkedSimplex<D> simplex(int element) const;
  /// Number of nodes: those of the coarse mesh and the new vertices. In meshes of second order the new vertices are mid-side nodes of the
  /// coarse mesh, except where new edges are split.
  int nodes() const { return nodes_; }
  /// The two ends of each new vertex's edge, by number - coarse nodes.
  const std::vector<std::array<int, 2>>& ends() const { return ends_; }
  const TwinEdges& twins() const { return twins_; }

 private:
  void close(const std::vector<char>& marked);
  void split(int element, const MarkedSimplex<D>& part, int depth, int required);
  int touchedVertices(int element, int since) const;
  int split(int p, int q, int known);
  int coarseMiddle(int element, int p, int q) const;
  const Carrier carrierOf(int vertex) const;
  void touch(const Carrier& carrier);

  const RefinableMesh& coarse_;
  TwinEdges twins_;
  EdgeNodes middles_;
  int nodes_;
  int round_ = 1;
  std::vector<int> touched_;  ///< last round in which an edge at the vertex, or between others of its elements, was split
  std::vector<std::array<int, 2>> ends_;
  std::vector<int> carrier_;  ///< place in carriers_, or -1 for coarse vertices
  std::vector<Carrier> carriers_;
};

}  // namespace suture
