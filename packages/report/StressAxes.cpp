#include <suture/partition/TurnFromDrawn.hpp>
#include <suture/report/StressAxes.hpp>

#include <Teuchos_ParameterList.hpp>

namespace suture {

namespace {

bool areOfBody(const Run& run) { return run.scene.parameters->sublist("Output").get<std::string>("Stress Axes") == "Body"; }

}  // namespace

Matrix inStressAxes(const Run& run, const SubdomainMesh& mesh, const Matrix& stresses) {
  if (!areOfBody(run) || mesh.drawn.empty()) return stresses;
  const int d = mesh.dimension;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner(d, d) = turnFromDrawn(mesh);
  constexpr int kPlaces[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
  Matrix turned = stresses;
  for (Eigen::Index row = 0; row < stresses.rows(); ++row) {
    Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
    for (Eigen::Index k = 0; k < stresses.cols(); ++k)
      tensor(kPlaces[k][0], kPlaces[k][1]) = tensor(kPlaces[k][1], kPlaces[k][0]) = stresses(row, k);
    tensor = (turn.transpose() * tensor * turn).eval();
    for (Eigen::Index k = 0; k < stresses.cols(); ++k) turned(row, k) = tensor(kPlaces[k][0], kPlaces[k][1]);
  }
  return turned;
}

std::string stressAxesText(const Run& run) { return areOfBody(run) ? "along the axes of the drawn body" : "along the axes"; }

}  // namespace suture
