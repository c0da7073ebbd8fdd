#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/partition/TurnFromDrawn.hpp>

namespace suture {

Matrix turnFromDrawn(const SubdomainMesh& mesh) {
  const int d = mesh.dimension;
  const Matrix none = Matrix::Identity(d, d);
  if (mesh.drawn.empty()) return none;
  const Eigen::Map<const Matrix> now(mesh.coordinates.data(), d, mesh.nodes()), before(mesh.drawn.data(), d, mesh.nodes());
  const Matrix sums = (now.colwise() - now.rowwise().mean()) * (before.colwise() - before.rowwise().mean()).transpose();
  const SingularValues parts = singularValues(sums);
  Matrix turn = parts.u * parts.v.transpose();
  if (turn.determinant() < 0.0) turn -= 2.0 * parts.u.col(d - 1) * parts.v.col(d - 1).transpose();
  return (turn - none).norm() < 1e-14 ? none : turn;
}

}  // namespace suture
