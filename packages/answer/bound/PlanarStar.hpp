#pragma once
#include <suture/answer/bound/StarMesh.hpp>

#include <vector>

namespace suture {

/// Balances the moments of tractions in 2D, node by node, in closed form: around a vertex triangles and sides alternate, so that the forces
/// of the triangles determine all changes of moments up to one common value. Local.
class PlanarStar {
 public:
  /// \param moments  of the tractions on the sides with the functions of their nodes, changed by balance; 2 x nodes of a side, by columns
  PlanarStar(const StarMesh<2>& mesh, Matrix& moments) : mesh_(mesh), moments_(moments) {}

  /// The least change with which each triangle at a vertex is in balance. Returns the largest rest of force; -1, without any change, if the
  /// triangles form several fans or a side is held along a direction that is no axis.
  double balanceVertex(int v);
  /// The same for the node in the middle of a side.
  double balanceMiddle(int side);

 private:
  struct Triangle {
    int element, node;  // node: number of the vertex
  };
  struct Spoke {
    int side, node;  // node: number of the vertex on the side
    double sign;     // sign of the side for the triangle before it
  };
  bool walk(int v);
  double balanceComponent(int k);
  bool isUnknown(const Spoke& spoke, int k) const;

  const StarMesh<2>& mesh_;
  Matrix& moments_;
  std::vector<Triangle> triangles_;
  std::vector<Spoke> spokes_;  // before each triangle; of an open fan also behind the last one
  std::vector<double> changes_;
  bool closed_ = false;
};

}  // namespace suture
