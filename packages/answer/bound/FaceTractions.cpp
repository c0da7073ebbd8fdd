#include <Eigen/Geometry>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <suture/answer/bound/FaceTractions.hpp>
#include <suture/answer/bound/PressedSides.hpp>

#include <cmath>

namespace suture {

namespace {

// Singular value of the resultants of unit tractions, relative to the largest, that is zero.
constexpr double kNoResultant = 1e-9;

Eigen::Matrix3d crossWith(const Eigen::Vector3d& arm) {
  Eigen::Matrix3d m;
  m << 0, -arm[2], arm[1], arm[2], 0, -arm[0], -arm[1], arm[0], 0;
  return m;
}

}  // namespace

template <int K>
FaceTractions<K>::FaceTractions(const StarMesh<3>& mesh, int side) : basis(Basis::Zero()), possible(Wrenches::Identity()) {
  const auto& vertices = mesh.verticesOfSide(side);
  Eigen::Matrix<double, 3, nodes> arms;
  for (int i = 0; i < 3; ++i) arms.col(i) = mesh.place(vertices[i]);
  centre = arms.template leftCols<3>().rowwise().mean();
  arms.template leftCols<3>().colwise() -= centre;
  if constexpr (K == 2) {
    arms.col(3) = 0.5 * (arms.col(0) + arms.col(1));
    arms.col(4) = 0.5 * (arms.col(1) + arms.col(2));
    arms.col(5) = 0.5 * (arms.col(0) + arms.col(2));
  }
  area = mesh.size(side);
  size = std::sqrt(arms.template leftCols<3>().squaredNorm() / 3);
  const Eigen::Matrix<double, nodes, nodes> mass = sideMass(3, K);
  Eigen::Matrix<double, 6, count> resultants;
  for (int j = 0; j < nodes; ++j) {
    resultants.template block<3, 3>(0, 3 * j) = mass.col(j).sum() * Eigen::Matrix3d::Identity();
    resultants.template block<3, 3>(3, 3 * j) = crossWith(arms * mass.col(j) / size);
  }
  const SideCondition<3>* boundary = mesh.boundaryOf(side);
  const unsigned fixed = boundary ? boundary->known | boundary->kept : 0u;
  isFree = fixed != 7u;
  if (!isFree) return;
  if (fixed == 0u) {
    const Eigen::HouseholderQR<Eigen::Matrix<double, count, 6>> qr(resultants.transpose());
    basis = qr.householderQ() * Basis::Identity();
    const Eigen::Matrix<double, 6, 6> upper = qr.matrixQR().template topRows<6>().template triangularView<Eigen::Upper>();
    basis.template leftCols<6>() = upper.template triangularView<Eigen::Upper>()
                                       .transpose()
                                       .template solve<Eigen::OnTheRight>(Eigen::Matrix<double, count, 6>(basis.template leftCols<6>()))
                                       .eval();
    return;
  }
  isRestricted = true;
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> directions(3, 0);
  for (int k = 0; k < 3; ++k)
    if (!(fixed >> k & 1u)) {
      directions.conservativeResize(3, directions.cols() + 1);
      directions.col(directions.cols() - 1) = boundary->axes.row(k).transpose();
    }
  const int free = int(directions.cols());
  Matrix spread = Matrix::Zero(count, nodes * free);
  for (int j = 0; j < nodes; ++j) spread.block(3 * j, free * j, 3, free) = directions;
  const Eigen::JacobiSVD<Matrix> svd(resultants * spread, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vector values = svd.singularValues();
  const int rank = int((values.array() > kNoResultant * values[0]).count());
  const Matrix u = svd.matrixU().leftCols(rank), v = spread * svd.matrixV();
  possible = u * u.transpose();
  basis.template leftCols<6>() = v.leftCols(rank) * values.head(rank).cwiseInverse().asDiagonal() * u.transpose();
  basis.block(0, 6, count, nodes * free - rank) = v.rightCols(nodes * free - rank);
}

template struct FaceTractions<1>;
template struct FaceTractions<2>;

}  // namespace suture
