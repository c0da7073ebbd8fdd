#pragma once
#include <suture/answer/bound/BoundElements.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace suture {

/// The simplices of this rank and those of other ranks that share a node with them, so that the star of each vertex of an own simplex is
/// complete. Vertices are numbered in the order of their numbers in the mesh, so that the nodes of a side have the same order in both of
/// its simplices.
template <int D>
class StarMesh {
 public:
  using Nodes = SimplexNodes<D>;
  static constexpr int sidesOf = D + 1;

  /// Exchanges simplices with the ranks that share nodes with this one. Collective.
  /// \param meshes  of this rank \param kind  of the bound \param elements  simplices of this rank \param ofMesh  BoundParts::ofMesh
  /// \param boundary  SideCondition of all of them
  StarMesh(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const BoundKind& kind, std::vector<BoundElement<D>> elements,
           const std::vector<std::vector<int>>& ofMesh, std::vector<SideCondition<D>> boundary);

  const Comm& comm() const { return comm_; }
  int degree() const { return kind_.degree; }  ///< degree of stresses
  int order() const { return kind_.order; }    ///< degree of nodal forces
  int own() const { return own_; }             ///< the first simplices are those of this rank
  int elements() const { return static_cast<int>(elements_.size()); }
  const BoundElement<D>& element(int e) const { return elements_[e]; }
  int vertices() const { return vertexCount_; }
  int sides() const { return static_cast<int>(elementsOfSide_.size()); }
  /// Vertices of a simplex, ascending.
  const std::array<int, D + 1>& verticesOf(int e) const { return vertices_[e]; }
  /// Side opposite to each vertex.
  const std::array<int, D + 1>& sidesOfElement(int e) const { return sides_[e]; }
  /// Vertices of a side, ascending.
  const std::array<int, D>& verticesOfSide(int s) const { return verticesOfSide_[s]; }
  /// Simplices of a side; the second is -1 at the boundary, and where a simplex of another rank is not known.
  const std::array<int, 2>& elementsOfSide(int s) const { return elementsOfSide_[s]; }
  /// Conditions on a side, or null inside the bodies.
  const SideCondition<D>* boundaryOf(int s) const { return boundaryOfSide_[s] < 0 ? nullptr : &boundary_[boundaryOfSide_[s]]; }
  /// +1 or -1: the direction of a side's normal, defined by the order of its vertices, is or is not that out of a simplex.
  double sign(int e, int a) const { return signs_[e][a]; }
  /// Size of a side, and its unit normal in that direction. [length or area]
  double size(int s) const { return sizes_[s]; }
  const Eigen::Matrix<double, D, 1>& normal(int s) const { return normals_[s]; }
  Eigen::Matrix<double, D, 1> place(int v) const { return places_.col(v); }
  /// True if all simplices at a vertex are known: it belongs to an own simplex.
  bool isComplete(int v) const { return complete_[v] != 0; }
  /// Simplices at a vertex.
  Span<const int> star(int v) const { return {starElements_.data() + starBegin_[v], std::size_t(starBegin_[v + 1] - starBegin_[v])}; }
  /// Calls each(v, w, simplices, isOwn) for the edges from complete vertices v to higher vertices w, in ascending order, with the simplices
  /// at the edge; isOwn: one of them is of this rank.
  template <typename Each>
  void forEachEdge(const Each& each) const;
  /// True on exactly one of the ranks that know a vertex, or a side of an own simplex.
  bool counts(int v) const { return counts_[v] != 0; }
  bool countsSide(int s) const { return countsSide_[s] != 0; }

  /// Replaces values of sides (columns) that belong only to simplices of other ranks by the values there. Collective.
  void exchangeSides(Matrix& values) const;
  /// The same for values of vertices.
  void exchangeVertices(Matrix& values) const;

 private:
  void number();
  void findSides();
  void findStars();
  void findOwners();
  void exchange(Matrix& values, bool ofVertices) const;

  const Comm& comm_;
  BoundKind kind_;
  int own_ = 0;
  std::vector<BoundElement<D>> elements_;
  std::vector<int> rankOf_;  // rank of each simplex
  std::vector<SideCondition<D>> boundary_;
  std::map<int, std::vector<int>> sent_, received_;  // simplices, by rank
  int vertexCount_ = 0;
  Matrix places_;
  std::vector<std::array<int, D + 1>> vertices_, sides_;
  std::vector<std::array<double, D + 1>> signs_;
  std::vector<std::array<int, D>> verticesOfSide_;
  std::vector<std::array<int, 2>> elementsOfSide_;
  std::vector<int> boundaryOfSide_;
  std::vector<double> sizes_;
  std::vector<Eigen::Matrix<double, D, 1>> normals_;
  std::vector<int> starBegin_, starElements_;
  std::vector<char> complete_, counts_, countsSide_;
};

template <int D>
template <typename Each>
void StarMesh<D>::forEachEdge(const Each& each) const {
  std::vector<std::pair<int, int>> edges;  // higher vertex, simplex
  std::vector<int> simplices;
  for (int v = 0; v < vertices(); ++v) {
    if (!isComplete(v)) continue;
    edges.clear();
    for (const int e : star(v))
      for (const int w : verticesOf(e))
        if (w > v) edges.push_back({w, e});
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size();) {
      const int w = edges[i].first;
      simplices.clear();
      bool isOwn = false;
      for (; i < edges.size() && edges[i].first == w; ++i) {
        simplices.push_back(edges[i].second);
        isOwn = isOwn || edges[i].second < own();
      }
      each(v, w, simplices, isOwn);
    }
  }
}

}  // namespace suture
